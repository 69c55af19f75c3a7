//! The curves of a film: every number of the reports, and a figure with one point a frame.

use crate::support::program;
use immerse::cli::{curves_csv, curves_svg};
use immerse::evolve::FrameReport;
use std::fs;

/// Reports whose errors fall by a decade a frame.
fn reports(count: usize) -> Vec<FrameReport> {
    let report = |k: usize| FrameReport {
        frame: k + 1,
        time: k as f64 / 24.0,
        l2_length_error: 0.1f64.powi(k as i32 + 1),
        max_length_error: 0.1f64.powi(k as i32),
        rims: 30 - 10 * k.min(3),
        pinch_points: 4 * (k % 2),
        spin_class: "01".to_owned(),
        converged: k + 1 == count,
        ..FrameReport::default()
    };
    (0..count).map(report).collect()
}

/// Columns by name.
fn column<'a>(table: &'a str, name: &str) -> Vec<&'a str> {
    let mut lines = table.lines();
    let at = lines.next().expect("a header").split(',').position(|title| title == name).expect("the column");
    lines.map(|line| line.split(',').nth(at).expect("a value")).collect()
}

/// The points of the curves in the order in which they are drawn.
fn polylines(figure: &str) -> Vec<Vec<(i32, i32)>> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        (x.parse().expect("x"), y.parse().expect("y"))
    };
    figure
        .lines()
        .filter(|line| line.starts_with("<polyline") && line.contains("stroke-width=\"6\""))
        .map(|line| {
            let points = line.split("points=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("points");
            points.split_whitespace().map(point).collect()
        })
        .collect()
}

#[test]
fn the_table_holds_every_number_exactly() {
    let reports = reports(5);
    let table = curves_csv(&reports, None).expect("a table");
    assert_eq!(table.lines().count(), 6);
    assert!(table.starts_with("frame,time,l2_length_error,max_length_error,"), "{table}");
    let widths: Vec<usize> = table.lines().map(|line| line.split(',').count()).collect();
    assert!(widths.iter().all(|width| *width == widths[0]), "{table}");
    let numbers = |name| column(&table, name).iter().map(|x| x.parse::<f64>().expect("a number")).collect::<Vec<_>>();
    assert_eq!(numbers("l2_length_error"), reports.iter().map(|r| r.l2_length_error).collect::<Vec<_>>());
    assert_eq!(numbers("time"), reports.iter().map(|r| r.time).collect::<Vec<_>>());
    assert_eq!(column(&table, "rims"), ["30", "20", "10", "0", "0"]);
    assert_eq!(column(&table, "converged"), ["0", "0", "0", "0", "1"]);
    assert_eq!(column(&table, "steps"), ["0"; 5]);
    // With what a certificate knows, in a column of its own.
    let with_events = curves_csv(&reports, Some(&[0, 0, 7, 0, 2])).expect("a table");
    assert_eq!(column(&with_events, "events"), ["0", "0", "7", "0", "2"]);
    assert!(!table.contains("spin_class"), "{table}");
}

/// On a logarithmic axis errors that fall by a decade a frame lie on a line; the counts are drawn to scale.
#[test]
fn the_figure_is_to_scale() {
    let figure = curves_svg(&reports(5), None).expect("a figure");
    let curves = polylines(&figure);
    assert_eq!(curves.iter().map(Vec::len).collect::<Vec<_>>(), [5; 4], "max, L2, rims, pinch points");
    for curve in &curves[..2] {
        for pair in curve.windows(3) {
            assert!((pair[2].1 - 2 * pair[1].1 + pair[0].1).abs() <= 2 && pair[1].1 > pair[0].1, "{curve:?}");
        }
    }
    // The L2 error of a frame is the largest error of the next one.
    assert!(curves[0][1..].iter().zip(&curves[1]).all(|(a, b)| (a.1 - b.1).abs() <= 1), "{curves:?}");
    let rims: Vec<i32> = curves[2].iter().map(|(_, y)| curves[2][4].1 - y).collect();
    assert!((rims[0] - 3 * rims[2]).abs() <= 3 && rims[3] == 0 && rims[0] > 200, "{rims:?}");
    for label in ["relative length error", "rims", "pinch points", "frame", "L2", "max", "100 %", "0.001 %"] {
        assert!(figure.lines().any(|line| line == label), "{label} is not written");
    }
}

#[test]
fn events_have_a_panel_of_their_own() {
    let figure = curves_svg(&reports(5), Some(&[0, 0, 8, 0, 2])).expect("a figure");
    let curves = polylines(&figure);
    assert_eq!(curves.len(), 5);
    let events: Vec<i32> = curves[4].iter().map(|(_, y)| curves[4][0].1 - y).collect();
    assert!(events[1] == 0 && (events[2] - 4 * events[4]).abs() <= 3 && events[2] > 200, "{events:?}");
    assert!(figure.lines().any(|line| line == "folds and faces that vanish since the frame before"));
}

/// Without errors, without change, and with more frames than labels.
#[test]
fn films_of_any_kind_have_a_figure() {
    let still = vec![FrameReport { frame: 1, ..FrameReport::default() }; 3];
    assert_eq!(polylines(&curves_svg(&still, None).expect("a figure")).len(), 4);
    assert!(curves_svg(&[], None).is_ok() && curves_svg(&reports(1), None).is_ok());
    let long: Vec<FrameReport> =
        (1..=2000).map(|frame| FrameReport { frame, rims: frame, ..still[0].clone() }).collect();
    let figure = curves_svg(&long, None).expect("a figure");
    assert!(figure.lines().filter(|line| line.starts_with("<text")).count() < 50);
}

#[test]
fn films_get_their_curves_and_single_frames_do_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let scene = |frames: usize| {
        format!(
            "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n[clock]\nframes = {frames}\n[output]\nsize = [16, 16]\nsamples = 1\n"
        )
    };
    fs::write(at.join("film.toml"), scene(3)).expect("a scene");
    fs::write(at.join("still.toml"), scene(1)).expect("a scene");
    for command in ["simulate", "run"] {
        let (code, _, err) = program(at, &[command, "film.toml", "--out", command]);
        assert_eq!(code, 0, "{err}");
        let table = fs::read_to_string(at.join(command).join("curves.csv")).expect("a table");
        assert_eq!(column(&table, "frame"), ["1", "2", "3"]);
        assert_eq!(column(&table, "steps"), ["0", "2", "4"]);
        assert!(at.join(command).join("curves.svg").exists());
    }
    let (code, _, err) = program(at, &["run", "still.toml", "--out", "still"]);
    assert_eq!(code, 0, "{err}");
    assert!(!at.join("still/curves.csv").exists());
    let (code, _, err) = program(at, &["inspect", "still", "--curves"]);
    assert_eq!(code, 0, "{err}");
    assert!(at.join("still/curves.csv").exists() && at.join("still/curves.svg").exists());
}
