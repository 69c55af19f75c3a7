//! `immerse certify`: films and files made elsewhere, planted faults, and a second opinion in Python.
//!
//! 10⁵ random intervals take some minutes: `python3 tests/certify/agree.py target/release/immerse 100000`.

use super::numpy::{has_numpy, run_python};
use super::support::program;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// OBJ files of frames of a mesh, whose faces count from 1.
fn write_film(folder: &Path, faces: &str, frames: &[&[[f64; 3]]]) {
    fs::create_dir_all(folder).expect("a folder");
    for (k, frame) in frames.iter().enumerate() {
        let vertices: String = frame.iter().map(|[x, y, z]| format!("v {x:?} {y:?} {z:?}\n")).collect();
        fs::write(folder.join(format!("{k:03}.obj")), vertices + faces).expect("a file");
    }
}

const HINGE: &str = "f 1 2 3\nf 2 1 4\n";

/// A hinge along x, seen along its edge.
fn open_to([cy, cz]: [f64; 2], [dy, dz]: [f64; 2]) -> [[f64; 3]; 4] {
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, cy, cz], [0.5, dy, dz]]
}

/// A star of four faces, a pocket whose sides are at its second and fourth spoke. The first goes by the third: past the second spoke
/// at height 0, which makes the star a figure 8, and past the fourth at height −1/40, which makes it a figure 0 again.
fn pocket(height: f64) -> [[f64; 3]; 5] {
    [[0.0, 0.0, 0.0], [0.1, 1.0, height], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.25]]
}

/// Films with what must be found in them: kinds, and between which frames.
fn plant(folder: &Path) -> Vec<(&'static str, Vec<(&'static str, u64)>)> {
    let fan = "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\n";
    write_film(&folder.join("star"), fan, &[&pocket(0.5), &pocket(0.25), &pocket(-0.0125)]);
    write_film(&folder.join("through"), fan, &[&pocket(0.5), &pocket(-0.5)]);
    let face = |x: f64, y: f64, z: f64| [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [x, y, z]];
    write_film(&folder.join("face"), "f 1 2 3\n", &[&face(0.2, 0.5, 2.0), &face(0.7, -1.0, -4.0)]);
    // Folds and opens again between its two frames.
    let [from, to] = [open_to([1.0, 0.0], [2.0, 0.25]), open_to([1.0, 1.0], [1.0, 1.125])];
    write_film(&folder.join("twice"), HINGE, &[&from, &to]);
    // Folds on the second frame exactly.
    let frames = [0.5, 0.0, -0.5].map(|z| open_to([1.0, 0.0], [1.0, z]));
    write_film(&folder.join("on"), HINGE, &[&frames[0], &frames[1], &frames[2]]);
    let frames = [0.5, 0.0, -0.5].map(|z| open_to([1.0, 0.0], [-1.0, z]));
    write_film(&folder.join("flat"), HINGE, &[&frames[0], &frames[1], &frames[2]]);
    vec![
        ("star", vec![("fold", 2)]),
        ("through", vec![("fold", 1); 2]),
        ("face", vec![("face", 1)]),
        ("twice", vec![("fold", 1); 2]),
        ("on", vec![("fold", 1)]),
        ("flat", vec![]),
    ]
}

fn certificate(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("certificate.json")).expect("a certificate")).expect("JSON")
}

#[test]
fn planted_faults_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, wanted) in plant(folder.path()) {
        let (code, out, err) = program(folder.path(), &["certify", name]);
        assert_eq!(code, i32::from(!wanted.is_empty()), "{name}: {out}{err}");
        let certificate = certificate(&folder.path().join(name));
        let events = certificate["events"].as_array().expect("a list");
        let found: Vec<_> =
            events.iter().map(|e| (e["kind"].as_str().unwrap(), e["frames"][0].as_u64().unwrap())).collect();
        assert_eq!(found, wanted, "{name}");
        assert_eq!(certificate["is_regular_homotopy"], wanted.is_empty(), "{name}");
        let says = if wanted.is_empty() { "regular homotopy: no hinge folds" } else { "not a regular homotopy: " };
        assert!(out.contains(says), "{name}: {out}");
        assert_eq!(
            err.contains("this is no regular homotopy; certificate.json lists why"),
            !wanted.is_empty(),
            "{err}"
        );
        let (_, json, _) = program(folder.path(), &["certify", name, "--json"]);
        assert_eq!(serde_json::from_str::<Value>(&json).expect("JSON"), certificate);
    }
}

/// Nothing folds, but the film begins with a star that is a figure 8.
#[test]
fn a_film_that_begins_with_a_pinch_point_is_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let fan = "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\n";
    write_film(&folder.path().join("pinched"), fan, &[&pocket(-0.0125), &pocket(-0.02)]);
    let (code, out, _) = program(folder.path(), &["certify", "pinched"]);
    assert!(code == 1 && out.contains("the first frame has 1 pinch point, where it is no immersion"), "{code} {out}");
    let certificate = certificate(&folder.path().join("pinched"));
    assert_eq!((&certificate["pinch_points"], &certificate["is_regular_homotopy"]), (&1.into(), &false.into()));
}

#[test]
fn what_is_no_film_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    let hinge = open_to([1.0, 0.0], [-1.0, 0.5]);
    write_film(&here.join("one"), HINGE, &[&hinge]);
    write_film(&here.join("none"), HINGE, &[]);
    write_film(&here.join("other"), HINGE, &[&hinge, &hinge]);
    write_film(&here.join("other/b"), "f 1 2 4\nf 2 1 3\n", &[&hinge]);
    fs::rename(here.join("other/b/000.obj"), here.join("other/002.obj")).expect("a file");
    for (name, says) in [
        ("one", "there is no film here, and only one OBJ file; name the folder of a film"),
        ("none", "there is no film here, and no OBJ file; name the folder of a film"),
        ("other", "002.obj: face 0 has vertices"),
        ("nowhere", "there is no film here"),
        ("one/000.obj", "it is a file, and a film is a folder"),
    ] {
        let (code, out, err) = program(here, &["certify", name]);
        assert!(code == 2 && err.contains(says) && out.is_empty(), "{name}: {code} {out}{err}");
        assert!(!here.join(name).join("certificate.json").exists());
    }
}

/// A film of a sphere that grows is a regular homotopy, which its scene asks for; and so says its export. A certificate is kept as long
/// as frames are the same.
#[test]
fn a_scene_asks_for_a_regular_homotopy() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    let scene = "mesh = { shape = 'sphere', subdivisions = 2 }\nmetric.formula = 'length * (1 + t)'\nclock = { frames = 3, end = 0.5 }\n\
                 start.from = 'mesh'\n[checks.film]\nregular_homotopy = true\n";
    fs::write(here.join("grow.toml"), scene).expect("a file");
    let (code, out, err) = program(here, &["simulate", "grow.toml"]);
    assert_eq!(code, 0, "{out}{err}");
    let film = here.join("renders/grow");
    let of_film = certificate(&film);
    assert_eq!(
        (&of_film["is_regular_homotopy"], of_film["frames"].as_array().map(Vec::len)),
        (&Value::Bool(true), Some(3))
    );
    let (code, out, err) = program(here, &["inspect", "renders/grow"]);
    assert!(code == 0 && out.contains("film.regular_homotopy"), "{out}{err}");
    let (code, _, err) = program(here, &["export", "renders/grow", "--format", "obj"]);
    assert_eq!(code, 0, "{err}");
    let (code, out, err) = program(here, &["certify", "renders/grow/export"]);
    assert!(code == 0 && out.contains("regular homotopy"), "{out}{err}");
    let of_export = certificate(&film.join("export"));
    let positions = |certificate: &Value| {
        let frames = certificate["frames"].as_array().expect("frames").iter();
        frames.map(|frame| frame["positions_sha256"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(positions(&of_film), positions(&of_export), "the same numbers, from other files");
    assert_eq!(of_film["triangles_sha256"], of_export["triangles_sha256"]);
    // Another film: its certificate is another one, too.
    let (code, out, err) = program(here, &["simulate", "grow.toml", "--set", "clock.end=0.25"]);
    assert_eq!(code, 0, "{out}{err}");
    assert_ne!(certificate(&film), of_film);
    assert_eq!(certificate(&film)["is_regular_homotopy"], true);
}

/// Python, which shares nothing with the program but the definitions, finds the same events in planted films and in random intervals.
#[test]
fn a_second_opinion_agrees() {
    if !has_numpy("no second opinion on certificates") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let planted: Vec<String> = plant(folder.path()).iter().map(|(name, _)| format!("'{name}'")).collect();
    let script = format!(
        "import sys; sys.path.insert(0, {:?}); sys.dont_write_bytecode = True\nimport agree\n\
         for name in [{}]: agree.main('immerse', name)\nagree.main('immerse', '200')",
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/certify"),
        planted.join(", ")
    );
    let out = run_python(folder.path(), &script);
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines.len(), planted.len() + 1, "{out}");
    assert!(lines[planted.len()].starts_with("200 intervals,") && lines[planted.len()].contains("fold: "), "{out}");
}
