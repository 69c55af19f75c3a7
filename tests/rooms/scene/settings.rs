//! Keys that are set beside a scene: types, places, and what the whole says.

use std::fs;
use std::path::Path;

use immerse::scene::*;
use tempfile::TempDir;

const SCENE: &str = "[mesh]\nshape = 'flat_torus'\n[[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\nlength = 2\n";

fn read(settings: &[&str]) -> Result<Scene, SceneErrors> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("film.toml");
    fs::write(&path, SCENE).unwrap();
    let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
    Scene::read_with(&path, &settings)
}

#[track_caller]
fn set(settings: &[&str]) -> Scene {
    read(settings).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn values_have_the_type_that_the_key_takes() {
    let class = |text: &str| set(&[&format!("spin.class={text}")]).spin;
    for text in ["01", "10", "0", "\"01\"", "'10'"] {
        assert_eq!(class(text), SpinSection::Digits(text.trim_matches(['"', '\'']).into()));
    }
    assert_eq!(class(" all "), SpinSection::All);
    let scene = set(&["start.random=7", "look.background=#0080ff", "mesh.a=[1, 0.5]", "output.format=['png', 'exr']"]);
    assert_eq!((scene.start.from, scene.look.background), (StartFrom::Random(7), Some([0, 128, 255])));
    assert!(scene.output.png && scene.output.exr);
    let scene = set(&[
        "metric.key.1.length=2.5",
        "mesh.a=[1, 0.5]",
        "mesh.a.1=0.25",
        "parameters.n=2*t",
        " spin = {class = '11'} ",
    ]);
    assert_eq!(scene.metric.keys[1].lengths, LengthSource::Uniform(2.5));
    assert_eq!(scene.parameters, [("n".to_owned(), NumberSection::Formula("2*t".into()))]);
    assert_eq!(scene.spin, SpinSection::Digits("11".into()));
    assert_eq!(set(&["parameters.n=2"]).parameters[0].1, NumberSection::Constant(2.0));
    assert_eq!(set(&["mesh.file=a=b.obj"]).mesh, MeshSection::File("a=b.obj".into()));
    assert_eq!(set(&["parameters.\"x=y\"=2"]).parameters[0].0, "x=y");
}

/// Exactly one mistake, at this column of what was typed.
#[track_caller]
fn refused(setting: &str, column: usize, reason: &str, remedy: &str) {
    let errors = read(&[setting]).unwrap_err();
    let [mistake] = errors.mistakes() else { panic!("{errors}") };
    assert!(mistake.reason.contains(reason), "{mistake}");
    assert!(mistake.remedy.contains(remedy), "{mistake}");
    assert_eq!((&*mistake.path, mistake.line), (Path::new("command line"), 1));
    assert_eq!((mistake.column, &*mistake.text), (column + "--set ".len(), &*format!("--set {setting}")), "{mistake}");
}

#[test]
fn mistakes_are_shown_in_what_was_typed() {
    refused("start.random=-1", 14, "`random` is -1, it must be an integer at least 0", "random = 7");
    refused("start.random=x", 14, "`random` is the string \"x\"", "random = 7");
    refused("start.random='7'", 14, "`random` is the string \"7\"", "remove the quotes around 7");
    refused("start.random=", 14, "`random` is the string \"\"", "random = 7");
    refused("spin.class=21", 12, "`class` is the string \"21\"", "class = \"01\"");
    refused("spin.clas=01", 6, "there is no `clas` in [spin]", "write `class`");
    refused("spn.class=01", 1, "there is no `spn` in a scene", "did you mean `spin`?");
    refused("mesh.shape=spere", 12, "there is no shape `spere`", "did you mean `sphere`?");
    refused("mesh.a=[1, 0, 0]", 8, "`a` has 3 entries, it must have 2", "a = [3.0");
    refused("spin=01", 6, "`spin` is the string \"01\", it must be a table", "[spin]");
    refused("start.random", 1, "`start.random` is no key and value", "--set start.random=7");
    refused("=7", 1, "`=7` is no key and value", "--set start.random=7");
    refused("a b=7", 1, "is no key and value", "--set start.random=7");
    refused("extends=a.toml", 1, "`extends` cannot be set", "into a scene file");
    refused("mesh.shape.x=1", 12, "`mesh.shape` is no table, and has no `x`", "set the key itself");
    refused("pin.0.vertices=[1]", 1, "there is no list `pin`", "into the scene file");
    refused("metric.key.length=1", 12, "`metric.key` is a list", "metric.key.0");
    refused("metric.key.2.length=1", 12, "`metric.key` has no entry 2: there are 2", "name one that is there");
    refused("metric.key.1.lengt=1", 14, "there is no `lengt` in [[key]]", "did you mean `length`?");
    refused(&format!("{}=1", vec!["a"; 60_000].join(".")), 1, "is no key and value", "--set start.random=7");
}

#[test]
fn all_mistakes_are_told_at_once() {
    let errors = read(&["clock.frames=0", "start.random=1", "start.random=2", "start.from=mesh"]).unwrap_err();
    let reasons: Vec<&str> = errors.mistakes().iter().map(|mistake| mistake.reason.as_str()).collect();
    assert_eq!(reasons.len(), 3, "{errors}");
    assert!(reasons[0].starts_with("`frames` is 0") && reasons[1] == "`start.random` is set twice", "{errors}");
    assert!(reasons[2].contains("both `random` and `from`, which exclude each other"), "{errors}");
}

/// All that a scene says.
fn said(scene: &Scene) -> String {
    format!("{:?}", Scene { source: Source::default(), ..scene.clone() })
}

#[test]
fn the_text_of_a_scene_says_all_that_it_was_put_together_of() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut count = 0;
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let plain = Scene::read(&path).unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(plain.source.text(), fs::read_to_string(&path).unwrap());
        let set = Scene::read_with(&path, &["checks.max_rims=12345".to_owned()]).unwrap();
        assert_eq!(set.checks.max_rims, Some(12345));
        let text = set.source.text();
        assert!(text.starts_with(&format!("# Put together of {name}.toml, --set checks.max_rims=12345.\n")), "{text}");
        let again = Scene::parse(text, &name, &folder).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
        assert_eq!(said(&again), said(&set), "{text}");
        count += 1;
    }
    assert!(count > 10);
    let odd = set(&["parameters.x=\"a\\nb\\\"\\\\\"", "parameters.\"é =\"=1_000.5e0", "mesh.columns=0x1F"]);
    let again = Scene::parse(odd.source.text(), "film", &odd.folder).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(said(&again), said(&odd));
}
