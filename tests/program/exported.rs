//! Films as other programs read them. `tests/clients/run` opens them in those programs.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

use crate::support::program;
use immerse::film::FilmFolder;
use immerse::immersion::bending_angles;
use immerse::mesh::EdgeId;
use immerse::scene::Scene;
use tempfile::TempDir;

const SCENE: &str = "[mesh]\nshape = 'cylinder'\ncolumns = 6\nrows = 3\n[metric]\nformula = 'length * (1 + 0.1 * t * z)'\n\
                     [clock]\nframes = 4\n[output]\nsize = [48, 36]\nsamples = 1\n";

const FORMATS: &str = "usd,vtk,gltf,pc2,ply,obj,fold,npz";

/// A film in the folder `out`.
fn film() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("film.toml"), SCENE).unwrap();
    assert_eq!(program(folder.path(), &["simulate", "film.toml", "--out", "out"]).0, 0);
    folder
}

fn export(folder: &Path, more: &[&str]) -> String {
    let (code, out, err) = program(folder, &[&["export", "out"], more].concat());
    assert_eq!(code, 0, "{err}");
    out
}

fn files(folder: &Path) -> BTreeMap<String, (Vec<u8>, SystemTime)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    entries
        .map(|path| (name(&path), (fs::read(&path).unwrap(), fs::metadata(&path).unwrap().modified().unwrap())))
        .collect()
}

#[test]
fn all_formats_are_written_and_kept() {
    let film = film();
    let out = export(film.path(), &["--format", FORMATS]);
    for line in ["1 usd file written", "5 vtk files written", "2 pc2 files written", "4 ply files written"] {
        assert!(out.contains(line), "{out}");
    }
    let to = film.path().join("out/export");
    let mut before = files(&to);
    let mut wanted: Vec<String> = ["usda", "glb", "pc2", "obj", "fold", "pvd"].map(|e| format!("film.{e}")).to_vec();
    wanted.extend(["vtu", "ply", "obj", "npz"].iter().flat_map(|e| (1..=4).map(move |k| format!("film.{k:06}.{e}"))));
    wanted.sort();
    assert_eq!(before.keys().cloned().collect::<Vec<_>>(), wanted);
    let out = export(film.path(), &["--format", FORMATS]);
    assert!(
        out.contains("0 usd files written, 1 were there") && out.contains("0 ply files written, 4 were there"),
        "{out}"
    );
    assert_eq!(files(&to), before, "files that were there are touched");
    // What is damaged is made again, and nothing else.
    for name in ["film.usda", "film.000002.ply", "film.pvd", "film.obj"] {
        let mut bytes = before[name].0.clone();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(to.join(name), bytes).unwrap();
        export(film.path(), &["--format", FORMATS]);
        let after = files(&to);
        for (other, (bytes, time)) in &before {
            assert!(after[other].0 == *bytes, "{other} after damage to {name}");
            // The point cache and its object are one export.
            let is_made_again = other == name || (name == "film.obj" && other == "film.pc2");
            assert_eq!(after[other].1 != *time, is_made_again, "{other} after damage to {name}");
        }
        before = after;
    }
    assert!(export(film.path(), &["--format", "obj", "--restart"]).contains("4 obj files written"));
}

#[test]
fn exports_are_the_same_bytes_for_any_number_of_threads() {
    let film = film();
    let of = |threads: &str| {
        let to = film.path().join(threads);
        export(film.path(), &["--format", FORMATS, "--to", threads, "--threads", threads]);
        files(&to).into_iter().map(|(name, (bytes, _))| (name, bytes)).collect::<BTreeMap<_, _>>()
    };
    let one = of("1");
    assert!(one == of("2") && one == of("5"));
}

#[test]
fn frames_are_chosen_and_those_of_a_longer_film_go() {
    let film = film();
    export(film.path(), &["--format", "obj,pc2,vtk", "--frames", "2-4:2"]);
    let to = film.path().join("out/export");
    let names = || files(&to).into_keys().filter(|name| name.ends_with("obj")).collect::<Vec<_>>();
    assert_eq!(names(), ["film.000002.obj", "film.000004.obj", "film.obj"]);
    let cache = fs::read(to.join("film.pc2")).unwrap();
    assert_eq!((&cache[..12], cache[28]), (&b"POINTCACHE2\0"[..], 2));
    let pvd = fs::read_to_string(to.join("film.pvd")).unwrap();
    assert!(pvd.contains("film.000004.vtu") && !pvd.contains("film.000003.vtu"), "{pvd}");

    fs::write(to.join("film.000009.obj"), "mine").unwrap();
    fs::write(film.path().join("film.toml"), SCENE.replace("frames = 4", "frames = 2")).unwrap();
    assert_eq!(program(film.path(), &["simulate", "film.toml", "--out", "out"]).0, 0);
    let (_, _, err) = program(film.path(), &["export", "out", "--format", "obj"]);
    assert!(err.contains("removed what is not of this film (1 files): film.000004.obj"), "{err}");
    assert_eq!(names(), ["film.000001.obj", "film.000002.obj", "film.000009.obj", "film.obj"]);
}

#[test]
fn a_scene_exports_what_it_names() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("film.toml"), format!("{}export = ['fold', 'npz']\n", SCENE)).unwrap();
    let (code, out, err) = program(folder.path(), &["run", "film.toml", "--out", "out"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("1 fold file written") && out.contains("4 npz files written"), "{out}");
    // What is exported can be read again, with the same lengths.
    let again = "[mesh]\nfile = 'out/export/film.fold'\n[output]\nsize = [48, 36]\nsamples = 1\n";
    fs::write(folder.path().join("again.toml"), again).unwrap();
    let (code, out, err) = program(folder.path(), &["check", "again.toml"]);
    assert_eq!(code, 0, "{out}{err}");
    let fold = fs::read_to_string(folder.path().join("out/export/film.fold")).unwrap();
    let fold: serde_json::Value = serde_json::from_str(&fold).unwrap();
    assert_eq!(fold["file_frames"].as_array().unwrap().len(), 3);
    assert_eq!(fold["edges_length"].as_array().unwrap().len(), fold["edges_vertices"].as_array().unwrap().len());
}

/// A film that was exported as FOLD asks for the lengths and angles of its frames again.
#[test]
fn a_film_as_keyframes_asks_for_the_same() {
    let folder = film();
    let at = folder.path();
    export(at, &["--format", "fold"]);
    let again = "[mesh]\nfile = 'out/export/film.fold'\n[metric]\nfiles = 'out/export/film.fold'\n\
                 [bending]\nfiles = 'out/export/film.fold'\n[clock]\nframes = 4\nsteps_per_frame = 1\n";
    fs::write(at.join("again.toml"), again).unwrap();
    let (code, _, err) = program(at, &["simulate", "again.toml", "--out", "again"]);
    assert_eq!(code, 0, "{err}");
    let [first, second] = ["out", "again"].map(|name| FilmFolder::open(&at.join(name)).unwrap());
    assert_eq!(first.mesh().unwrap().mesh.triangles(), second.mesh().unwrap().mesh.triangles());
    let mut before: Option<Vec<f64>> = None;
    for frame in 1..=4 {
        let [wanted, found] = [&first, &second].map(|film| film.read_frame(frame).unwrap().edge_lengths);
        let off = wanted.iter().zip(&found).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14 && before.as_ref() != Some(&wanted), "frame {frame} is off by {off:e}");
        before = Some(wanted);
    }
    let scene = Scene::read(&at.join("again.toml")).unwrap();
    let surface = scene.surface().unwrap();
    let bending = scene.program(&surface).unwrap().bending.unwrap();
    for frame in 1..=4 {
        let positions = first.read_frame(frame).unwrap().positions;
        let angles = bending_angles(&surface.mesh, &positions);
        let asked = bending.at((frame - 1) as f64 / 3.0).unwrap();
        let inside = surface.mesh.edges().filter(|e| !surface.mesh.is_boundary_edge(*e)).map(EdgeId::index);
        let off = inside.map(|e| (angles[e] - asked[e]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "frame {frame}: an angle is off by {off:e}");
    }
    // Another mesh is told, with the frame.
    let other = again.replacen("file = 'out/export/film.fold'", "shape = 'cylinder'\ncolumns = 8\nrows = 3", 1);
    fs::write(at.join("other.toml"), other).unwrap();
    let (code, _, err) = program(at, &["check", "other.toml"]);
    assert!(code == 2 && err.contains("film.fold") && err.contains("its faces are not those of the mesh"), "{err}");
}

#[test]
fn what_cannot_be_is_refused_with_a_sentence() {
    let film = film();
    let refused = |arguments: &[&str]| {
        let (code, _, err) = program(film.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}: {err}");
        err
    };
    assert!(refused(&["export", "nowhere", "--format", "usd"]).contains("nowhere"));
    assert!(refused(&["export", "out", "--format", "fbx"]).contains("usd, vtk, gltf, pc2, ply, obj, fold, npz"));
    assert!(refused(&["export", "out"]).contains("--format"));
    assert!(refused(&["export", "out", "--format", "usd", "--frames", "3-9"]).contains("the film has 4"));
    fs::remove_file(film.path().join("out/frames/000003.json")).unwrap();
    assert!(refused(&["export", "out", "--format", "obj"]).contains("frame 3 has not been computed"));
    export(film.path(), &["--format", "obj", "--frames", "1-2"]);
    let (_, _, err) = program(film.path(), &["run", "film.toml", "--out", "out"]);
    assert!(!err.contains("error"), "{err}");
    // The folder of the film itself is as good as any other.
    export(film.path(), &["--format", "obj", "--to", "out"]);
    assert!(film.path().join("out/film.000001.obj").is_file());
}

#[test]
fn a_film_without_its_scene_is_seen_as_usual() {
    let film = film();
    for scene in [None, Some("[camera]\nlense = 3\n"), Some("\u{0}")] {
        let kept = film.path().join("out/.immerse/scene.toml");
        match scene {
            None => fs::remove_file(kept).unwrap(),
            Some(text) => fs::write(kept, text).unwrap(),
        }
        let (code, _, err) = program(film.path(), &["export", "out", "--format", "usd", "--restart"]);
        assert_eq!(code, 0, "{err}");
        assert!(err.contains("camera, lights and colours are the usual ones"), "{err}");
    }
}

#[cfg(unix)]
#[test]
fn nothing_is_written_where_a_link_leads() {
    let film = film();
    let elsewhere = film.path().join("elsewhere");
    fs::create_dir(&elsewhere).unwrap();
    std::os::unix::fs::symlink(&elsewhere, film.path().join("out/export")).unwrap();
    let (code, _, err) = program(film.path(), &["export", "out", "--format", "obj"]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("leads out of the folder") && fs::read_dir(elsewhere).unwrap().next().is_none(), "{err}");
}
