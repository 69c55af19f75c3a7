//! Films of all classes, what has no class, and whether a film can get from its start to its target.

use crate::support::{program, scene};
use immerse::cli::checks_of;
use immerse::evolve::{FrameReport, NO_CLASS, Unobserved};
use immerse::immersion::pinch_points;
use immerse::scene::{ChecksSection, ClockSection, clock_of};
use immerse::spin::Homology;
use std::path::Path;
use tempfile::TempDir;

/// A folder with these files.
fn folder_with(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    folder
}

/// What the program says on standard output where it succeeds.
fn answer(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, err) = program(folder, arguments);
    assert_eq!(code, 0, "{err}");
    out
}

const TORUS: &str = "[mesh]\nshape = 'flat_torus'\ncolumns = 10\nrows = 8\n";
const BRIEF: &str = "[[phase]]\nmin_steps = 1\nmax_steps = 2\n";

#[test]
fn there_is_a_frame_for_each_class_unless_the_clock_says_else() {
    for (mesh, classes) in [
        ("shape = 'flat_torus'\ncolumns = 8\nrows = 6", 4),
        ("shape = 'sphere'\nsubdivisions = 3", 1),
        ("shape = 'cylinder'\ncolumns = 8\nrows = 3", 2),
        ("shape = 'polyhedron'\nname = 'genus_two_saddle'", 16),
    ] {
        let text = format!("[mesh]\n{mesh}\n[spin]\nclass = 'all'\n");
        let scene = scene(&text);
        let surface = scene.surface().unwrap();
        assert_eq!(clock_of(&scene, &surface.mesh).unwrap().frames, classes, "{mesh}");
    }
    // An explicit number counts, without [clock] as with one.
    for (clock, frames) in
        [("", 4), ("[clock]\nend = 2\n", 4), ("[clock]\nframes = 1\n", 1), ("[clock]\nframes = 3\n", 3)]
    {
        let scene = scene(&format!("{TORUS}[spin]\nclass = 'all'\n{clock}"));
        let surface = scene.surface().unwrap();
        assert_eq!(clock_of(&scene, &surface.mesh).unwrap().frames, frames, "{clock}");
    }
    let other = scene(&format!("{TORUS}[spin]\nclass = '01'\n"));
    assert!(!other.clock.a_frame_for_each_class && other.clock.frames == 1);
}

#[test]
fn the_program_makes_a_picture_of_each_class() {
    let text = format!("{TORUS}{BRIEF}[spin]\nclass = 'all'\n[output]\nsize = [80, 60]\nsamples = 1\n");
    let folder = folder_with(&[("all.toml", &text)]);
    answer(folder.path(), &["run", "all.toml", "--out", "film", "-q"]);
    for number in 1..=4 {
        assert!(folder.path().join(format!("film/{number:06}.png")).is_file(), "picture {number}");
    }
    assert!(!folder.path().join("film/000005.png").exists());
    let check = answer(folder.path(), &["check", "all.toml"]);
    assert!(check.contains("4 frames"), "{check}");
}

#[test]
fn the_number_of_generators_agrees_with_the_mesh() {
    for (genus, boundaries) in [(0, 0), (0, 1), (0, 3), (1, 0), (2, 0), (1, 2)] {
        let (mesh, positions) = crate::support::surface(genus, boundaries);
        let lengths = immerse::metric::lengths_of_positions(&mesh, &positions);
        let metric = immerse::metric::Metric::new(&mesh, lengths).unwrap();
        assert_eq!(mesh.betti(), Homology::new(&mesh, &metric).betti(), "genus {genus}, {boundaries} boundaries");
    }
}

/// More classes than file names have digits, than bits, and than numbers.
#[test]
fn too_many_classes_are_refused_in_a_sentence() {
    for genus in [10, 33, 40] {
        let (positions, faces) = crate::support::block_with_holes(genus);
        let mut obj: String = positions.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
        faces.iter().for_each(|[a, b, c]| obj.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1)));
        let all = "[mesh]\nfile = 'block.obj'\n[spin]\nclass = 'all'\n";
        let few = format!("{all}{BRIEF}[clock]\nframes = 2\n[output]\nsize = [16, 12]\nsamples = 1\n");
        let folder = folder_with(&[("block.obj", &obj), ("all.toml", all), ("few.toml", &few)]);
        let (code, _, err) = program(folder.path(), &["check", "all.toml"]);
        assert_eq!(code, 2, "{err}");
        assert!(err.contains(&format!("2 to the power of {}", 2 * genus)) && err.contains("`frames`"), "{err}");
        answer(folder.path(), &["simulate", "few.toml", "--out", "film", "-q"]);
    }
}

#[test]
fn a_pinched_surface_has_no_class() {
    // Two steps from random frames leave pinch points.
    let scene =
        scene("[mesh]\nshape = 'flat_torus'\ncolumns = 16\nrows = 14\n[[phase]]\nmin_steps = 1\nmax_steps = 1\n");
    let mut simulation = scene.simulation().unwrap();
    let frame = simulation.advance(1, &mut Unobserved).unwrap();
    assert!(frame.report.pinch_points > 0 && !pinch_points(simulation.mesh(), &frame.positions).is_empty());
    assert_eq!(frame.report.spin_class, "—");
    assert_eq!(NO_CLASS, "—");
    let good = FrameReport { frame: 1, spin_class: "00".into(), ..FrameReport::default() };
    let film = [good.clone(), FrameReport { frame: 2, pinch_points: 3, ..frame.report.clone() }, good];
    let checks = ChecksSection { class: Some("00".into()), ..ChecksSection::default() };
    let found = &checks_of(&checks, &film)[0];
    assert!(!found.holds && found.value == "—");
    let reason = found.reason.as_deref().unwrap();
    assert!(reason.contains("frame 2") && reason.contains("3 pinch points") && reason.contains("no class"), "{reason}");
    // A class that is another one needs no sentence.
    let other = [FrameReport { spin_class: "01".into(), ..FrameReport::default() }];
    assert!(!checks_of(&checks, &other)[0].holds && checks_of(&checks, &other)[0].reason.is_none());
}

#[test]
fn the_program_shows_that_there_is_no_class() {
    let text = "[mesh]\nshape = 'flat_torus'\ncolumns = 16\nrows = 14\n[[phase]]\nmin_steps = 1\nmax_steps = 1\n\
                [clock]\nframes = 2\nsteps_per_frame = 1\n[output]\nsize = [64, 48]\nsamples = 1\n[checks]\nclass = '00'\n[[look.text]]\ntext = 'class {class}'\n";
    let folder = folder_with(&[("pinched.toml", text)]);
    let (code, out, err) = program(folder.path(), &["run", "pinched.toml", "--out", "film", "-q"]);
    assert_eq!(code, 1, "{err}");
    assert!(out.contains("class —"), "{out}");
    assert!(err.contains("pinch") && err.contains("no class"), "{err}");
    let report: serde_json::Value =
        serde_json::from_str(&answer(folder.path(), &["inspect", "film", "--json"])).unwrap();
    assert_eq!(report["frames"][0]["spin_class"], "—");
    assert!(report["checks"][0]["reason"].as_str().unwrap().contains("no class"), "{report}");
    assert!(answer(folder.path(), &["inspect", "film"]).contains('—'));
}

#[test]
fn check_says_whether_start_and_target_are_in_one_class() {
    let torus = "[mesh]\nshape = 'torus'\ncolumns = 16\nrows = 12\n";
    let check = |text: &str| answer(folder_with(&[("scene.toml", text)]).path(), &["check", "scene.toml"]);
    let sphere = check("[mesh]\nshape = 'sphere'\nsubdivisions = 4\n[start]\nfrom = 'mirror'\n");
    assert!(sphere.contains("start and target are in one class"), "{sphere}");
    let same = check(&format!("{torus}[start]\nfrom = 'mesh'\n"));
    assert!(same.contains("start and target are in one class"), "{same}");
    let mirror = check(&format!("{torus}[start]\nfrom = 'mirror'\n"));
    assert!(mirror.contains("start and target are in one class"), "q is that of the mirror image, too: {mirror}");
    let scene = scene(&format!("{torus}[start]\nfrom = 'mesh'\n"));
    let simulation = scene.simulation().unwrap();
    let own = simulation.class_of_start().unwrap().unwrap();
    for digits in ["00", "01", "10", "11"] {
        let text = check(&format!("{torus}[start]\nfrom = 'mesh'\n[spin]\nclass = '{digits}'\n"));
        let is_own = own.to_string() == digits;
        assert_eq!(text.contains("start and target are in one class"), is_own, "{digits}: {text}");
        assert_eq!(text.contains("not in one class"), !is_own, "{digits}: {text}");
    }
    // Random frames start from no shape.
    assert!(!check(torus).contains("start and target"));
    assert!(ClockSection::default().frames == 1);
}
