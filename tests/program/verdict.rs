//! What the result is not is said in the end, with place, likely cause and what to try; good results are silent.

use std::fs;
use std::path::Path;

use crate::support::{program, scene};
use immerse::cli::{checks_of, verdict};
use immerse::evolve::{BendingError, FrameReport, Places, Unobserved};
use immerse::immersion::bending_angles;
use immerse::mesh::shapes;
use immerse::scene::ChecksSection;
use tempfile::TempDir;

fn run(folder: &Path, text: &str) -> (i32, String, String) {
    fs::write(folder.join("a.toml"), text).unwrap();
    program(folder, &["simulate", "a.toml", "--out", "out", "--restart"])
}

#[test]
fn a_good_result_is_silent() {
    let folder = TempDir::new().unwrap();
    let (code, _, err) = run(folder.path(), "[mesh]\nshape = 'sphere'\nsubdivisions = 6\n");
    assert_eq!((code, err.as_str()), (0, ""));
}

#[test]
fn rims_that_stay_are_told_with_their_places_in_the_last_line() {
    let folder = TempDir::new().unwrap();
    let text =
        "[mesh]\nshape = 'torus'\nmajor_radius = 1\nminor_radius = 0.4\ncolumns = 8\nrows = 6\n[spin]\nclass = '11'\n";
    let (code, out, err) = run(folder.path(), text);
    let last = err.lines().last().unwrap_or_default();
    assert_eq!(code, 0, "{err}");
    assert!(last.starts_with("warning: the surface is not what was asked for: it has "), "{out}{err}");
    for part in [" rims (edges that fold over: ", "a length error of ", "at edge ", "class is hard on this mesh"] {
        let coarse = part == "class is hard on this mesh" && last.contains("too coarse");
        assert!(last.contains(part) || coarse, "no `{part}` in: {last}");
    }
    assert!(err.lines().count() <= 2, "phases on the way say nothing: {err}");
}

fn good() -> FrameReport {
    FrameReport {
        frame: 1,
        spin_class: "01".into(),
        asked_class: "01".into(),
        converged: true,
        ..FrameReport::default()
    }
}

/// Every fault alone, and what the sentence has to contain.
#[test]
fn each_fault_is_told() {
    let none = ChecksSection::default();
    assert_eq!(verdict(&[good()], &none), None);
    assert_eq!(verdict(&[], &none), None);
    let places = Places { worst_edge: [3, 4], pinch_points: vec![7], rims: vec![[1, 2]], ..Places::default() };
    let angles = BendingError { rms_degrees: 12.0, max_degrees: 31.5, edge: [5, 6] };
    let faults = [
        (FrameReport { rims: 1, ..good() }, vec!["1 rim (edges that fold over: 1-2)"]),
        (FrameReport { rims: 9, ..good() }, vec!["9 rims (edges that fold over: 1-2, …)"]),
        (FrameReport { pinch_points: 1, spin_class: "—".into(), ..good() }, vec!["1 pinch point (vertices 7)"]),
        (FrameReport { l2_length_error: 0.13, ..good() }, vec!["a length error of 13", "at edge 3-4"]),
        (FrameReport { spin_class: "11".into(), ..good() }, vec!["class 11 where 01 was asked for"]),
        (
            FrameReport { bending_error: Some(angles), ..good() },
            vec!["12.0 degrees", "31.5", "5-6", "bending_stiffness"],
        ),
        (FrameReport { pin_distance: Some(0.1), ..good() }, vec!["a pinned vertex", "immerse check"]),
    ];
    for (report, parts) in faults {
        let report = FrameReport { places: Places { thinness: 0.8, ..places.clone() }, ..report };
        let text = verdict(std::slice::from_ref(&report), &none).unwrap_or_else(|| panic!("{report:?}"));
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}

#[test]
fn causes_are_told_apart() {
    let none = ChecksSection::default();
    let bad = |places: Places, restarts: usize| {
        let mut report = FrameReport { rims: 3, places, ..good() };
        report.cursor.restarts = restarts;
        verdict(&[report], &none).expect("a verdict")
    };
    let fine = Places { thinness: 0.8, sharpest_degrees: 10.0, ..Places::default() };
    let sliver = Places { thinness: 0.01, thinnest_face: 42, ..fine.clone() };
    assert!(bad(sliver, 0).contains("face 42 is 1.0 % as high as long"));
    assert!(bad(Places { sharpest_degrees: -140.0, sharpest_vertex: 9, ..fine.clone() }, 0).contains("vertex 9"));
    assert!(bad(fine.clone(), 8).contains("This class is hard on this mesh"));
    let running = FrameReport { rims: 3, converged: false, places: fine, ..good() };
    assert!(verdict(std::slice::from_ref(&running), &none).expect("a verdict").contains("max_steps"));
    assert_eq!(verdict(&[FrameReport { on_the_way: true, ..running }], &none), None);
}

/// What a scene allows under `[checks]` is no fault, and what it forbids is one.
#[test]
fn bounds_of_the_scene_count() {
    let report = FrameReport { l2_length_error: 0.013, rims: 2, ..good() };
    let checks = ChecksSection { max_l2_length_error: Some(0.015), max_rims: Some(2), ..ChecksSection::default() };
    assert_eq!(verdict(std::slice::from_ref(&report), &checks), None);
    let strict = ChecksSection { max_l2_length_error: Some(1e-4), ..ChecksSection::default() };
    let report = FrameReport { l2_length_error: 5e-4, ..good() };
    assert!(verdict(&[report], &strict).is_some());
}

/// Of a film the last frame counts; where each frame is of another class, all do.
#[test]
fn films_are_judged_by_where_they_lead() {
    let none = ChecksSection::default();
    let bad = FrameReport { frame: 1, rims: 4, ..good() };
    assert_eq!(verdict(&[bad.clone(), FrameReport { frame: 2, ..good() }], &none), None);
    let other = FrameReport { frame: 2, spin_class: "00".into(), asked_class: "00".into(), ..good() };
    let text = verdict(&[bad, other], &none).expect("a verdict");
    assert!(text.starts_with("1 of 2 frames are not what was asked for; frame 1 has 4 rims"), "{text}");
}

/// A sphere cannot have half its bending angles: the error is the other half.
#[test]
fn angles_that_are_not_reached_are_measured() {
    let ball = shapes::sphere(1.0, 6).expect("a sphere");
    let text = "[start]\nfrom = 'mesh'\n[bending]\nfrom = 'mesh'\namount = 0.5";
    let mut simulation = scene(text).simulation_of(ball.clone()).expect("a simulation");
    let report = simulation.relax(&mut Unobserved).expect("a frame").report.clone();
    let angles = bending_angles(&ball.mesh, ball.positions.as_deref().expect("positions"));
    let largest = angles.iter().map(|angle| 0.5 * angle.abs().to_degrees()).fold(0.0, f64::max);
    let error = report.bending_error.expect("targets");
    assert!((error.max_degrees / largest - 1.0).abs() < 0.05, "{error:?} {largest}");
    assert!(error.rms_degrees > 0.7 * largest && error.rms_degrees < error.max_degrees);
    let checks = |rms, max| ChecksSection {
        rms_bending_error: Some(rms),
        max_bending_error: Some(max),
        ..ChecksSection::default()
    };
    let holds = |checks: &ChecksSection| {
        checks_of(checks, std::slice::from_ref(&report)).iter().map(|c| c.holds).collect::<Vec<_>>()
    };
    assert_eq!(holds(&checks(error.rms_degrees, error.max_degrees)), [true, true]);
    assert_eq!(holds(&checks(0.9 * error.rms_degrees, 0.9 * error.max_degrees)), [false, false]);

    let all = "[start]\nfrom = 'mesh'\n[bending]\nfrom = 'mesh'";
    let reached = scene(all).simulation_of(ball.clone()).expect("a simulation").relax(&mut Unobserved);
    assert!(reached.expect("a frame").report.bending_error.expect("targets").max_degrees < 0.01);
    let without = scene("").simulation_of(ball).expect("a simulation").relax(&mut Unobserved);
    assert_eq!(without.expect("a frame").report.bending_error, None);
}
