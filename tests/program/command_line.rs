//! The program as a whole: exit codes, what goes where, and that nothing is written where it should not.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use glam::{DQuat, DVec3};
use immerse::algebra::Complex;
use immerse::cli::checks_of;
use immerse::digest::Key;
use immerse::evolve::Frame;
use immerse::evolve::FrameReport;
use immerse::film::{FilmFolder, FilmMesh, FilmSpec};
use immerse::mesh::Mesh;
use immerse::scene::{ChecksSection, FilmChecksSection};
use immerse::spin::SpinStructure;

fn immerse(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_immerse"));
    command.current_dir(folder).env_remove("NO_COLOR");
    command
}

fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let Output { status, stdout, stderr } = immerse(folder).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap(), text(stdout), text(stderr))
}

/// The film of a tetrahedron with two frames.
fn film(folder: &Path, checks: ChecksSection) -> FilmFolder {
    let mesh = Mesh::from_faces(4, &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]).unwrap();
    let film = FilmSpec {
        scene: "test".into(),
        sections: Default::default(),
        keys: [1, 2].map(|k| Key::of_bytes(&[k])).to_vec(),
        checks,
        text: String::new(),
    };
    let cache = FilmFolder::open_or_create(folder, &film, &FilmMesh::of(mesh.clone().into())).unwrap().0;
    for frame in [1, 2] {
        let report = FrameReport {
            frame,
            l2_length_error: 0.0123,
            max_length_error: 0.5,
            rims: 3 * frame,
            cursor: immerse::evolve::Cursor { phase: 5, steps: 40, settled: true, ..Default::default() },
            converged: true,
            ..Default::default()
        };
        cache
            .write_frame(&Frame {
                positions: vec![DVec3::ZERO; 4],
                face_frames: vec![DQuat::IDENTITY; 4],
                spin: SpinStructure::from_transports(&mesh, vec![Complex::ONE; 6]).unwrap(),
                edge_lengths: vec![1.0; 6],
                rims: Vec::new(),
                report,
            })
            .unwrap();
    }
    cache
}

/// Another mesh in place of the scene's; its path starts where it is typed, not at the scene.
#[test]
fn a_mesh_from_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("scenes")).unwrap();
    fs::write(folder.path().join("scenes/film.toml"), "[mesh]\nfile = 'missing.obj'\n").unwrap();
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    fs::write(folder.path().join("own.obj"), tetrahedron).unwrap();
    let (code, _, err) = run(folder.path(), &["check", "scenes/film.toml"]);
    assert!(code == 2 && err.contains("missing.obj"), "{err}");
    let (code, out, err) = run(folder.path(), &["check", "scenes/film.toml", "--mesh", "own.obj"]);
    assert!(code == 0 && out.contains("4 vertices, 6 edges, 4 faces"), "{out}{err}");
    let (code, _, err) = run(folder.path(), &["check", "scenes/film.toml", "--mesh", "other.obj"]);
    assert!(code == 2 && err.contains("other.obj"), "{err}");
}

#[test]
fn mistakes_in_a_scene_end_with_2_and_are_all_shown_with_a_caret() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("film.toml"), "[mesh]\nshape = \"spere\"\n[clock]\nframes = 0\n").unwrap();
    for command in ["check", "run", "simulate", "render"] {
        let (code, out, err) = run(folder.path(), &[command, "film.toml"]);
        assert_eq!((code, out.as_str()), (2, ""), "{command}: {err}");
        for part in ["film.toml:2:9", "did you mean `sphere`?", "film.toml:4:10", "^", "2 mistakes", "frames = 0"] {
            assert!(err.contains(part), "{command}: no {part} in\n{err}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn the_caret_stands_under_the_place_even_behind_the_end() {
    let folder = tempfile::tempdir().unwrap();
    for (text, picture) in [
        ("[clock]\nframes = 0\n", " 2 | frames = 0\n   :          ^\n"),
        ("[clock]\nframes = ", " 2 | frames =  \n   :          ^\n"),
        ("[clock\nframes = 1", " 1 | [clock\n   :       ^\n"),
        ("[look]\nfront = \"é\"", " 2 | front = \"é\" \n   :         ^^^\n"),
    ] {
        fs::write(folder.path().join("film.toml"), text).unwrap();
        let (code, _, err) = run(folder.path(), &["check", "film.toml"]);
        assert_eq!(code, 2);
        assert!(err.contains(picture), "{err}");
    }
}

/// As programs write them: lines that nobody can read are not drawn, wherever they stand, and what quotes them is cut.
#[test]
fn lines_without_end_are_told_and_not_shown() {
    let folder = tempfile::tempdir().unwrap();
    let many = "7, ".repeat(33_000);
    let long = "x + ".repeat(20_000);
    for (text, place) in [
        (format!("[look]\nhide_faces = [{many}-1]\n"), "2:99015"),
        (format!("[look]\nhide_faces = [{many}]\nfoo = 1\n"), "3:1"),
        (format!("[look]\nfoo = [\n{many}]\n"), "2:1"),
        (format!("[clock]\nframes = [\n{many}]\n"), "2:10"),
        (format!("[look]\nhide = \"\"\"\n{long}\"\"\"\n"), "2:8"),
        (format!("[look]\nhide_faces = [{many}= ]\n"), "2:99015"),
    ] {
        fs::write(folder.path().join("film.toml"), text).unwrap();
        let (code, _, err) = run(folder.path(), &["check", "film.toml"]);
        assert_eq!(code, 2, "{}", &err[..err.len().min(500)]);
        assert!(err.contains(&format!("film.toml:{place}")), "no {place} in {}", &err[..err.len().min(500)]);
        assert!(err.len() < 5000, "{} bytes", err.len());
    }
}

/// Of mistakes of many kinds as of those of one, so many are shown as anybody reads.
#[test]
fn of_thousands_of_mistakes_twenty_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[[phase]]\nwrong = 1\ndt = -1\nepsilon = 'x'\n".repeat(3333);
    fs::write(folder.path().join("film.toml"), text).unwrap();
    let begin = std::time::Instant::now();
    let (code, _, err) = run(folder.path(), &["check", "film.toml"]);
    assert_eq!(code, 2);
    assert_eq!(err.matches("error: ").count(), 20, "{err}");
    assert!(err.contains("and 9979 more\n") && err.contains("9999 mistakes"), "{err}");
    assert!(begin.elapsed().as_secs_f64() < 2.0, "{:?}", begin.elapsed());
}

#[test]
fn missing_files_and_folders_end_with_2() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, part) in [
        (["check", "none.toml"], "none.toml: there is no such file; check the path"),
        (["run", "none.toml"], "none.toml: there is no such file; check the path"),
        (["inspect", "none"], "none: there is no film here; simulate one first"),
        (["inspect", "."], ".: there is no film here; simulate one first"),
    ] {
        let (code, out, err) = run(folder.path(), &arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(part), "{err}");
    }
}

#[test]
fn wrong_arguments_end_with_2_and_help_with_0() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("film.toml"), "[clock]\nframes = 5").unwrap();
    for (arguments, part) in [
        (&["render", "film.toml", "--frames", "5-3"][..], "write the smaller frame first"),
        (&["render", "film.toml", "--frames", "1-6"], "frame 6 is asked for, but the film has 5"),
        (&["simulate", "film.toml", "--threads", "0"], "--threads"),
        (&["simulat", "film.toml"], "simulate"),
        (&["check", "film.toml", "--restart"], "--restart"),
        (&[], "Usage"),
    ] {
        let (code, out, err) = run(folder.path(), arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(part), "{err}");
    }
    let (code, out, err) = run(folder.path(), &["--help"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let help = out.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in
        ["Exit codes: 0 done, 1 failed while running", "2 the input is at fault, 75 another process", "130", "143"]
    {
        assert!(help.contains(part), "no `{part}` in {out}");
    }
    assert_eq!(run(folder.path(), &["--version"]).0, 0);
}

#[test]
fn a_new_scene_is_valid_and_never_replaces_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let (code, out, _) = run(folder.path(), &["new", "film"]);
    assert_eq!(code, 0);
    assert!(out.contains("immerse run film.toml"), "{out}");
    let (code, out, err) = run(folder.path(), &["check", "film.toml", "--threads", "2"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("film.toml: nothing is wrong"), "{out}");
    fs::write(folder.path().join("film.toml"), "mine").unwrap();
    let (code, _, err) = run(folder.path(), &["new", "film.toml"]);
    assert_eq!(code, 2);
    assert!(err.contains("film.toml: cannot be written"), "{err}");
    assert_eq!(fs::read_to_string(folder.path().join("film.toml")).unwrap(), "mine");
}

#[test]
fn what_is_generated_goes_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, part) in
        [(&["schema"][..], "\"flat_torus\""), (&["completions", "bash"], "_immerse"), (&["man"], ".TH immerse")]
    {
        let (code, out, err) = run(folder.path(), arguments);
        assert_eq!((code, err.as_str()), (0, ""));
        assert!(out.contains(part), "{out}");
    }
    let (_, schema, _) = run(folder.path(), &["schema"]);
    assert_eq!(serde_json::from_str::<serde_json::Value>(&schema).unwrap(), immerse::scene::Scene::schema());
}

#[test]
fn inspect_prints_one_object_or_tables() {
    let folder = tempfile::tempdir().unwrap();
    let checks = ChecksSection { max_l2_length_error: Some(0.02), max_rims: Some(5), ..Default::default() };
    film(folder.path(), checks);
    let (code, out, err) = run(folder.path(), &["inspect", ".", "--json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let object: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(
        object["mesh"],
        serde_json::json!({ "vertices": 4, "edges": 6, "faces": 4, "genus": 0, "boundaries": 0 })
    );
    assert_eq!((object["frames"].as_array().unwrap().len(), &object["frames"][1]["rims"]), (2, &6.into()));
    assert_eq!(
        object["checks"],
        serde_json::json!([
            { "name": "max_l2_length_error", "limit": 0.02, "value": 0.0123, "holds": true },
            { "name": "max_rims", "limit": 5, "value": 6, "holds": false },
        ])
    );

    let (code, out, _) = run(folder.path(), &["inspect", "."]);
    assert_eq!(code, 0);
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[0], "4 vertices, 6 edges, 4 faces, genus 0, 0 boundary loops");
    assert!(lines[2].starts_with("frame  time  L2 error"), "{out}");
    assert!(lines[4].starts_with("    2     0    1.23 %       50 %     6"), "{out}");
    assert_eq!(lines[7], "max_l2_length_error   0.02  0.0123  yes");
    assert_eq!(lines[8], "max_rims                 5       6  NO");
}

#[test]
fn inspect_names_damaged_frames_and_ends_with_1() {
    let folder = tempfile::tempdir().unwrap();
    film(folder.path(), ChecksSection::default());
    fs::write(folder.path().join("frames/000001.npz"), "?").unwrap();
    let (code, out, err) = run(folder.path(), &["inspect", ".", "--json"]);
    assert_eq!(code, 1);
    assert!(err.contains("000001.npz: it is damaged"), "{err}");
    let object: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(object["frames"][0]["frame"], 2);
}

#[test]
fn a_film_in_another_format_ends_with_2() {
    let folder = tempfile::tempdir().unwrap();
    film(folder.path(), ChecksSection::default());
    let manifest = folder.path().join("manifest.json");
    let later = fs::read_to_string(&manifest).unwrap().replace("\"format\": 2", "\"format\": 9");
    fs::write(&manifest, later).unwrap();
    let (code, _, err) = run(folder.path(), &["inspect", "."]);
    assert_eq!(code, 2);
    assert!(err.contains("it has format 9, this program reads format 2"), "{err}");
}

#[cfg(unix)]
#[test]
fn a_closed_or_full_output_is_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    film(folder.path(), ChecksSection::default());
    for arguments in [&["schema"][..], &["man"], &["completions", "zsh"], &["--help"], &["inspect", "."]] {
        let mut child =
            immerse(folder.path()).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), err.as_str()), (Some(0), ""), "{arguments:?}");
        if !cfg!(target_os = "linux") {
            continue;
        }
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = immerse(folder.path()).args(arguments).stdout(full).output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {err}");
        assert!(err.contains("standard output cannot be written"), "{err}");
    }
}

#[test]
fn checks_compare_the_last_frame_with_the_scene() {
    let checks = ChecksSection {
        max_l2_length_error: Some(0.01),
        max_rims: Some(0),
        max_pinch_points: Some(1),
        class: Some("01".into()),
        ..ChecksSection::default()
    };
    let good = FrameReport { l2_length_error: 0.01, pinch_points: 1, spin_class: "01".into(), ..Default::default() };
    let holds = |report: Option<&FrameReport>| {
        checks_of(&checks, report.map_or(&[], std::slice::from_ref)).iter().map(|c| c.holds).collect::<Vec<_>>()
    };
    assert_eq!(holds(Some(&good)), [true; 4]);
    let bad = FrameReport {
        l2_length_error: 0.0101,
        rims: 1,
        pinch_points: 2,
        spin_class: "10".into(),
        ..Default::default()
    };
    assert_eq!(holds(Some(&bad)), [false; 4]);
    assert_eq!(holds(Some(&FrameReport { l2_length_error: f64::NAN, ..good })), [false, true, true, true]);
    assert_eq!(holds(None), [false; 4]);
    assert_eq!(checks_of(&ChecksSection::default(), &[]), []);
}

/// Every check alone, on films that hold to it just so and films that do not.
#[test]
fn every_check_holds_up_to_its_bound() {
    let none = ChecksSection::default;
    let film = |film| ChecksSection { film, ..none() };
    let one = |change: fn(&mut FrameReport, f64)| {
        move |value| {
            let mut report = FrameReport::default();
            change(&mut report, value);
            report
        }
    };
    type Make = Box<dyn Fn(f64) -> FrameReport>;
    let of_last: [(ChecksSection, &str, Make); 4] = [
        (
            ChecksSection { max_l2_length_error: Some(0.5), ..none() },
            "max_l2_length_error",
            Box::new(one(|report, x| report.l2_length_error = x)),
        ),
        (
            ChecksSection { max_curvature_error: Some(0.5), ..none() },
            "max_curvature_error",
            Box::new(one(|report, x| report.curvature_error = Some(x))),
        ),
        (
            ChecksSection { max_mean_distance: Some(0.5), ..none() },
            "max_mean_distance",
            Box::new(one(|report, x| report.mean_distance = Some(x))),
        ),
        (
            ChecksSection { max_pin_distance: Some(0.5), ..none() },
            "max_pin_distance",
            Box::new(one(|report, x| report.pin_distance = Some(x))),
        ),
    ];
    let holds = |checks: &ChecksSection, name: &str, film: &[FrameReport]| {
        let found = checks_of(checks, film);
        assert_eq!((found.len(), found[0].name), (1, name));
        assert!(!film.is_empty() || found[0].value.is_null());
        found[0].holds
    };
    for (checks, name, report) in of_last {
        let [good, bad, nan] = [0.5, 0.5000001, f64::NAN].map(report);
        let film = |last: &FrameReport| [bad.clone(), last.clone()];
        assert!(holds(&checks, name, &film(&good)), "{name} is of the last frame");
        assert!(!holds(&checks, name, &film(&bad)) && !holds(&checks, name, &film(&nan)), "{name}");
        assert!(!holds(&checks, name, &[]), "{name} of nothing");
        // Nothing of the kind was measured.
        assert_eq!(holds(&checks, name, &[FrameReport::default()]), name == "max_l2_length_error");
    }

    let with_error = |errors: &[f64]| -> Vec<FrameReport> {
        errors.iter().map(|&x| FrameReport { l2_length_error: x, ..Default::default() }).collect()
    };
    let max = film(FilmChecksSection { max_l2_length_error: Some(0.5), ..Default::default() });
    let median = film(FilmChecksSection { median_l2_length_error: Some(0.5), ..Default::default() });
    for (errors, max_holds, median_holds) in [
        (&[0.5, 0.1, 0.2][..], true, true),
        (&[0.6, 0.1, 0.2], false, true),
        (&[0.6, 0.5, 0.2], false, true),
        (&[0.6, 0.7, 0.2], false, false),
        (&[f64::NAN, 0.1, 0.2], false, true),
        (&[0.1, f64::NAN, 0.2], false, true),
        (&[0.1, 0.2, f64::NAN], false, true),
        (&[f64::NAN, f64::NAN, 0.2], false, false),
        (&[], false, false),
    ] {
        let film = with_error(errors);
        assert_eq!(holds(&max, "film.max_l2_length_error", &film), max_holds, "{errors:?}");
        assert_eq!(holds(&median, "film.median_l2_length_error", &film), median_holds, "{errors:?}");
    }

    let rims = film(FilmChecksSection { max_rims: Some(2), ..Default::default() });
    for (counts, expected) in [(&[0, 2, 1][..], true), (&[3, 0, 0], false), (&[0, 3, 0], false), (&[], false)] {
        let film: Vec<_> = counts.iter().map(|&rims| FrameReport { rims, ..Default::default() }).collect();
        assert_eq!(holds(&rims, "film.max_rims", &film), expected, "{counts:?}");
    }

    // Largest over median of the moves; what the first frame says does not count.
    let jump = film(FilmChecksSection { max_jump: Some(4.0), ..Default::default() });
    for (moves, expected) in [
        (&[9.0, 1.0, 4.0, 1.0][..], true),
        (&[0.0, 1.0, 4.1, 1.0], false),
        (&[0.0, 0.0, 0.0], true),
        (&[0.0, 0.0, 0.0, 1.0], false),
        (&[0.0, f64::NAN, 1.0, 1.0], false),
        (&[0.0, 1.0, f64::NAN, 1.0], false),
        (&[0.0, 1.0, 1.0, f64::NAN], false),
        (&[0.0], false),
        (&[], false),
    ] {
        let film: Vec<_> = moves.iter().map(|&x| FrameReport { max_move: x, ..Default::default() }).collect();
        assert_eq!(holds(&jump, "film.max_jump", &film), expected, "{moves:?}");
    }

    let class = ChecksSection { class: Some("01".into()), ..none() };
    for (classes, expected) in [(&["01", "01"][..], true), (&["11", "01"], false), (&["01", "11"], false), (&[], false)]
    {
        let film: Vec<_> =
            classes.iter().map(|&c| FrameReport { spin_class: c.into(), ..Default::default() }).collect();
        assert_eq!(holds(&class, "class", &film), expected, "{classes:?}");
        if !expected && !film.is_empty() {
            assert_eq!(checks_of(&class, &film)[0].value, "11", "the one that is another is named");
        }
    }
}
