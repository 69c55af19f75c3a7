//! The JSON schema says what the reader accepts.

use immerse::scene::Scene;
use serde_json::Value;

#[test]
fn every_section_is_in_the_schema_with_its_bounds_and_defaults() {
    let schema = Scene::schema();
    let at = |pointer: &str| schema.pointer(pointer).unwrap_or_else(|| panic!("no {pointer}")).clone();
    let sections: Vec<String> = at("/properties").as_object().unwrap().keys().cloned().collect();
    let mut expected =
        ["mesh", "parameters", "metric", "spin", "start", "phase", "bending", "pin", "clock", "camera", "light"]
            .to_vec();
    expected.extend(["look", "output", "checks", "extends", "polish"]);
    expected.sort();
    assert_eq!(sections, expected);
    assert_eq!(at("/properties/clock/properties/frames/default"), 1);
    assert_eq!(at("/properties/clock/properties/frames/maximum"), 999_999.0);
    assert_eq!(at("/properties/phase/items/properties/dt/exclusiveMinimum"), 0.0);
    assert_eq!(at("/properties/phase/items/properties/epsilon/minItems"), 4);
    assert_eq!(at("/properties/output/properties/samples/default"), 8);
    assert_eq!(at("/properties/light/items/required/0"), "direction");
    assert_eq!(at("/properties/parameters/additionalProperties/anyOf/2/required/0"), "times");
    assert_eq!(at("/additionalProperties"), false);
}

#[test]
fn parameters_of_a_shape_stand_beside_its_name_and_the_tree_of_solids_refers_to_itself() {
    let schema = Scene::schema();
    let rules = schema.pointer("/properties/mesh/allOf").and_then(Value::as_array).unwrap();
    assert_eq!(rules.len(), 12);
    let implicit = rules.iter().find(|rule| rule.pointer("/if/properties/shape/const").unwrap() == "implicit").unwrap();
    let items = implicit.pointer("/then/properties/parts/items").unwrap();
    assert_eq!(items["$anchor"], "parts");
    assert_eq!(items.pointer("/properties/group/items/$ref").unwrap(), "#parts");
    assert_eq!(items.pointer("/properties/sphere/required/0").unwrap(), "radius");
}

/// The page for people, which the program writes, is the one that is read.
#[test]
fn the_reference_lists_every_key_as_it_is_declared() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/reference.md");
    let there = std::fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    let wanted = Scene::reference();
    let first = there.lines().zip(wanted.lines()).find(|(there, wanted)| there != wanted);
    assert!(
        there == wanted,
        "docs/reference.md is not what the scene declares, first here: {first:?}; write it anew with\n\n    \
         cargo run --release --locked -- schema --markdown > docs/reference.md\n"
    );
    // Keys of tables within tables, of variants and of keyframes.
    for key in ["`interpolation`", "`log_scale`", "`free_area`", "`radii`", "`extrapolation`", "`crease_angle`"] {
        assert!(wanted.contains(&format!("| {key} |")), "{key} is missing");
    }
}
