//! What the page tells in words and numbers.

use serde_json::{Value as Json, json};

use super::measure::{BINS, BINS_A_DECADE, LEAST_BIN, Small, Subject};
use crate::digest::Key;
use crate::evolve::FrameReport;
use crate::film::disk::{FilmFolder, Manifest};
use crate::spin::Homology;

/// A number with six digits, which is what a curve is worth.
pub(super) fn six_digits(x: f64) -> Json {
    if x == 0.0 { json!(0) } else { format!("{x:.5e}").parse::<f64>().map_or(Json::Null, Json::from) }
}

pub(super) fn list(numbers: impl IntoIterator<Item = f64>) -> Json {
    numbers.into_iter().map(six_digits).collect()
}

/// The numbers of all frames, with the events before each where they are known.
pub(super) fn curves(frames: &[Small], events: Option<&[usize]>) -> Json {
    let column = |value: &dyn Fn(&Small) -> f64| list(frames.iter().map(value));
    let optional = |value: &dyn Fn(&FrameReport) -> Option<f64>| -> Json {
        if frames.iter().all(|small| value(&small.report).is_none()) {
            return Json::Null;
        }
        frames.iter().map(|small| value(&small.report).map_or(Json::Null, six_digits)).collect()
    };
    let count = |value: &dyn Fn(&FrameReport) -> usize| -> Json {
        frames.iter().map(|small| Json::from(value(&small.report))).collect()
    };
    json!({
        "frame": count(&|r| r.frame),
        "time": column(&|small| small.report.time),
        "mean": column(&|small| small.mean_error),
        "p95": column(&|small| small.report.p95_length_error),
        "max": column(&|small| small.report.max_length_error),
        "l2": column(&|small| small.report.l2_length_error),
        "rims": count(&|r| r.rims),
        "born": count(&|r| r.rims_born),
        "died": count(&|r| r.rims_died),
        "moved": count(&|r| r.rims_moved),
        "events": events,
        "pinchPoints": count(&|r| r.pinch_points),
        "bending": column(&|small| small.energy[0]),
        "rotation": column(&|small| small.energy[1]),
        "torsion": column(&|small| small.energy[2]),
        "steps": count(&|r| r.cursor.steps),
        "iterations": count(&|r| r.cursor.inner_iterations),
        "bend": column(&|small| small.bend),
        "bendError": optional(&|r| r.bending_error.map(|error| error.rms_degrees)),
        "bendErrorMax": optional(&|r| r.bending_error.map(|error| error.max_degrees)),
        "move": column(&|small| small.report.max_move),
        "asked": frames.iter().map(|small| small.report.asked_class.clone()).collect::<Vec<_>>(),
        "class": frames.iter().map(|small| small.report.spin_class.clone()).collect::<Vec<_>>(),
    })
}

/// How length errors are distributed in each frame.
pub(super) fn histogram() -> Json {
    json!({ "bins": BINS, "binsADecade": BINS_A_DECADE, "least": LEAST_BIN })
}

/// The generators in order, with their digits in the first class that was asked for, and in the last frame.
pub(super) fn generators(subject: &Subject, frames: &[Small]) -> Json {
    let homology = Homology::new(&subject.mesh, &subject.first);
    let digit = |class: &str, k: usize| class.chars().nth(k).filter(char::is_ascii_digit).map(String::from);
    let last = frames.last().map(|small| &small.report);
    let row = |(k, generator): (usize, &crate::spin::Generator)| {
        let of = |class: fn(&FrameReport) -> &str| last.and_then(|report| digit(class(report), k));
        json!({
            "length": six_digits(generator.length),
            "faces": generator.strip.exits().len(),
            "asked": of(|report| &report.asked_class),
            "found": of(|report| &report.spin_class),
        })
    };
    homology.generators().iter().enumerate().map(row).collect()
}

/// Frames that were to converge and ran into the limit of steps, with what is known of each.
pub(super) fn unconverged(frames: &[Small]) -> Json {
    let row = |small: &Small| {
        let report = &small.report;
        json!({
            "frame": report.frame,
            "error": six_digits(report.l2_length_error),
            "steps": report.cursor.steps,
            "max": six_digits(report.max_length_error),
            "rims": report.rims,
            "pinchPoints": report.pinch_points,
            "restarts": report.cursor.restarts,
        })
    };
    frames.iter().filter(|small| small.report.is_unconverged()).map(row).collect()
}

/// What the film is of, and what made it.
pub(super) fn origin(film: &FilmFolder, shows: Key, reporter: u32) -> Json {
    let Manifest { format, scene, program, mesh, mesh_sha256, frame_count, .. } = film.manifest();
    json!({
        "scene": scene,
        "program": program,
        "page": format!("immerse {}, page {reporter}", env!("CARGO_PKG_VERSION")),
        "format": format,
        "mesh": mesh,
        "meshKey": mesh_sha256,
        "filmKey": shows,
        "frames": frame_count,
    })
}
