//! Files of other kinds where a scene or a film belongs: one sentence. Files full of mistakes: twenty of a kind.

use std::fs;
use std::path::Path;
use std::time::Instant;

use crate::support::program;
use immerse::scene::Scene;
use tempfile::TempDir;

/// A mesh of some hundred thousand lines.
fn long_obj() -> String {
    let mut text = String::new();
    (0..100_000).for_each(|k| text.push_str(&format!("v {}.5 {} 0.25\n", k, k % 7)));
    (1..99_000).for_each(|k| text.push_str(&format!("f {} {} {}\n", k, k + 1, k + 2)));
    text
}

/// One sentence on standard error, nothing on standard output, exit code 2, at once.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str], parts: &[&str]) {
    let start = Instant::now();
    let (code, out, err) = program(folder, arguments);
    assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
    assert_eq!(err.lines().count(), 1, "{arguments:?}: {err}");
    parts.iter().for_each(|part| assert!(err.contains(part), "{arguments:?}: {part}: {err}"));
    assert!(start.elapsed().as_secs_f64() < 3.0, "{arguments:?} takes {:?}", start.elapsed());
}

#[test]
fn a_mesh_where_a_scene_belongs() {
    let folder = TempDir::new().unwrap();
    let obj = long_obj();
    for name in ["x.obj", "X.OBJ", "x.ply", "x.off", "x.stl"] {
        fs::write(folder.path().join(name), &obj).unwrap();
        for command in ["check", "run", "simulate", "render", "gallery"] {
            refused(folder.path(), &[command, name], &["it is a mesh, not a scene", name, "--mesh"]);
        }
    }
}

/// By content where the ending does not tell.
#[test]
fn a_mesh_by_another_name() {
    let folder = TempDir::new().unwrap();
    let mut stl = vec![b' '; 80];
    stl.extend(2_u32.to_le_bytes());
    stl.extend([1; 100]);
    let solid = "solid a\n facet normal 0 0 1\n outer loop\n";
    for (name, bytes, part) in [
        ("a.toml", long_obj().into_bytes(), "it is a mesh"),
        ("b", b"# made by hand\n\no thing\nv 0 0 0\nv 1 0 0\n".to_vec(), "it is a mesh"),
        ("c.txt", b"OFF\n3 1 0\n0 0 0\n".to_vec(), "it is a mesh"),
        ("c2.txt", b"COFF\n3 1 0\n".to_vec(), "it is a mesh"),
        ("d.dat", b"ply\nformat ascii 1.0\n".to_vec(), "it is a mesh"),
        ("e.dat", b"ply\nformat binary_little_endian 1.0\n\0\0\xff".to_vec(), "it is a mesh"),
        ("f.dat", solid.as_bytes().to_vec(), "it is a mesh"),
        ("g.dat", stl, "it is a mesh"),
        ("h.toml", b"\x89PNG\r\n\x1a\n\0\0".to_vec(), "it is a picture"),
        ("i", b"PK\x03\x04\0\0".to_vec(), "it is an archive"),
        ("j.bin", vec![7, 0, 1, 2, 255], "it is binary"),
        ("k.txt", b"{\n  \"mesh\": 1\n}\n".to_vec(), "it is JSON"),
        ("l.txt", b"<svg xmlns='x'>\n</svg>".to_vec(), "it is XML"),
        ("m.txt", b"0,1,0.5\n1,2,0.7\n".to_vec(), "it is a table"),
        // UTF-16 is read, and so it is told what is in it.
        ("n.toml", "\u{feff}v 0 0 0\nv 1 0 0\n".encode_utf16().flat_map(u16::to_le_bytes).collect(), "it is a mesh"),
        ("o.png", b"anything".to_vec(), "it is a picture"),
        ("p.csv", b"0,1,2\n".to_vec(), "it is a table"),
        ("q.json", b"{}".to_vec(), "it is JSON"),
        ("r.glb", b"glTF".to_vec(), "it is a model"),
        ("s.npz", b"PK".to_vec(), "arrays"),
    ] {
        fs::write(folder.path().join(name), bytes).unwrap();
        refused(folder.path(), &["check", name], &[part, name, "; "]);
    }
    refused(folder.path(), &["check", "absent.obj"], &["there is no such file"]);
    // A scene is one whatever its ending is.
    for (name, text) in [
        ("scene", "# a ball\n\n[mesh]\nshape = 'sphere'\nsubdivisions = 2\n"),
        ("s.txt", "mesh = { shape = 'sphere', subdivisions = 2 }\n"),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
        let (code, _, err) = program(folder.path(), &["check", name]);
        assert_eq!((code, err.as_str()), (0, ""), "{name}");
    }
}

#[test]
fn folders_and_files_in_place_of_each_other() {
    let folder = TempDir::new().unwrap();
    let scene = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[output]\nsize = [16, 12]\nsamples = 1\n";
    fs::write(folder.path().join("ball.toml"), scene).unwrap();
    let (code, _, err) = program(folder.path(), &["run", "ball.toml"]);
    assert_eq!(code, 0, "{err}");
    refused(folder.path(), &["check", "."], &["it is a folder", "ball.toml"]);
    refused(folder.path(), &["run", "renders"], &["it is a folder", "immerse new"]);
    refused(
        folder.path(),
        &["render", "renders/ball"],
        &["it is the folder of a film", "immerse inspect renders/ball"],
    );
    refused(folder.path(), &["inspect", "ball.toml"], &["it is a file", "renders/ball"]);
    refused(folder.path(), &["inspect", "renders/ball/000001.png"], &["it is a file", "which is renders/ball"]);
    refused(folder.path(), &["inspect", "renders/ball/frames/000001.npz"], &["it is a file", "which is renders/ball"]);
    refused(folder.path(), &["inspect", "renders"], &["there is no film here"]);
    refused(folder.path(), &["inspect", "absent"], &["there is no film here"]);
    refused(folder.path(), &["simulate", "ball.toml", "--out", "ball.toml"], &["it is a file"]);
    refused(folder.path(), &["simulate", "ball.toml", "--out", "ball.toml", "--restart"], &["it is a file"]);
}

/// Seconds. It takes two where nothing else runs; what is quadratic would take ten minutes.
const LINEAR: f64 = 30.0;

/// Every kind is listed twenty times, in the order of the file, and the rest counted, in linear time.
#[test]
fn a_hundred_thousand_mistakes() {
    let count = 100_000;
    let lines = |line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    for (what, text, kinds) in [
        ("unknown keys", "[clock]\n".to_owned() + &lines(&|k| format!("frmes{k} = {k}\n")), 1),
        ("unknown tables", lines(&|k| format!("[tabel{k}]\nx = 1\n")), 1),
        ("unknown keys of phases", lines(&|_| "[[phase]]\nmaxsteps = 1\n".into()), 1),
        ("wrong values", lines(&|k| format!("[[phase]]\ndt = -{}\n", k + 1)), 1),
        ("wrong names", lines(&|k| format!("[[phase]]\nmethod = 'm{k}'\n")), 1),
        ("two kinds", lines(&|k| format!("[[phase]]\ndt = 'x'\nfoo{k} = 1\n")), 2),
        ("broken lines", lines(&|k| format!("this is line {k}\n")), 1),
        ("one line", format!("clock = {{ {} }}", lines(&|k| format!("k{k} = 1, ")).trim_end_matches(", ")), 1),
    ] {
        let start = Instant::now();
        let errors = Scene::parse(&text, "many", "".as_ref()).expect_err(what);
        let shown = errors.to_string();
        let seconds = start.elapsed().as_secs_f64();
        let mistakes = errors.mistakes();
        assert_eq!(mistakes.len(), 20 * kinds, "{what}");
        assert!(mistakes.is_sorted_by_key(|mistake| (mistake.line, mistake.column)), "{what}");
        let more: usize = mistakes.iter().map(|mistake| mistake.more).sum();
        assert!(more + 20 * kinds >= count * kinds, "{what}: {more} more");
        assert!(shown.contains(&format!("and {} more", mistakes.last().unwrap().more)), "{what}: {shown}");
        assert!(seconds < LINEAR, "{what}: {seconds} s");
    }
    // The program shows no more than that, with the line of each.
    let folder = TempDir::new().unwrap();
    let text = "[clock]\n".to_owned() + &lines(&|k| format!("frmes{k} = {k}\n"));
    fs::write(folder.path().join("many.toml"), &text).unwrap();
    fs::write(folder.path().join("line.toml"), format!("clock = {{ {} x = 1 }}", lines(&|k| format!("k{k} = 1, "))))
        .unwrap();
    for name in ["many.toml", "line.toml"] {
        let start = Instant::now();
        let (code, _, err) = program(folder.path(), &["check", name]);
        assert_eq!(code, 2);
        assert!(err.contains("and 99") && err.contains("more like the last one"), "{err}");
        assert!(err.len() < 30_000, "{} bytes", err.len());
        assert!(err.lines().last().unwrap().ends_with("mistakes"), "{err}");
        assert!(start.elapsed().as_secs_f64() < LINEAR, "{name}: {:?}", start.elapsed());
    }
}

/// Backslashes of Windows: in double quotes they are escapes, which is an error in TOML or, worse, is none.
#[test]
fn paths_of_windows_want_single_quotes() {
    let wrong = |text: &str| Scene::parse(text, "test", "".as_ref()).expect_err(text).to_string();
    for (section, key, path) in [
        ("mesh", "file", r"C:\meshes\x.obj"),
        ("mesh", "file", r"C:\new\x.obj"),
        ("mesh", "file", r"C:\new\big\torus.obj"),
        ("mesh", "file", r"C:\Users\me\torus.obj"),
        ("mesh", "file", r"..\users\torus.obj"),
        ("mesh", "file", r"C:\data\torus.obj"),
        ("metric", "csv", r"C:\temp\lengths.csv"),
        ("metric", "csv", r"\\server\share\lengths.csv"),
        ("metric", "file", r"C:\temp\x.obj"),
        ("start", "file", r"C:\new\x.obj"),
        ("start", "file", r"C:\new\torus.obj"),
        ("bending", "file", r"C:\recent\new.obj"),
        ("look", "matcap", r"C:\temp\new.png"),
    ] {
        let message = wrong(&format!("[{section}]\n{key} = \"{path}\"\n"));
        assert_eq!(message.lines().count(), 1, "one mistake: {message}");
        assert!(message.contains("single quotes") && message.contains(&format!("'{path}'")), "{path}: {message}");
        let text = format!("[{section}]\n{key} = '{path}'\n");
        if let Err(errors) = Scene::parse(&text, "test", "".as_ref()) {
            assert!(!errors.to_string().contains("quotes"), "{errors}");
        }
    }
    // What has two backslashes or slashes is a path; a label may have lines.
    for text in [
        r#"mesh = { file = "C:\\new\\x.obj" }"#,
        r#"mesh = { file = "C:/new/x.obj" }"#,
        "[mesh]\nshape = 'sphere'\n[[look.text]]\ntext = \"two\\nlines\"\n",
    ] {
        assert!(Scene::parse(text, "test", "".as_ref()).is_ok(), "{text}");
    }
}
