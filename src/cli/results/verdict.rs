//! The last line of a run: what the result is not, where, why that may be, and what to try.

use super::text_table::percent;
use crate::evolve::FrameReport;
use crate::scene::ChecksSection;
use crate::tuning::MAX_RESTARTS;

/// Length error that is said where the scene states no bound.
const LOUD_ERROR: f64 = 0.01;
/// The same for bending angles that are asked for, in degrees.
const LOUD_ANGLE: f64 = 5.0;
/// Distance of a pinned vertex from its place that is more than rounding.
const LOUD_PIN: f64 = 1e-6;
/// A face thinner than this is a sliver.
const SLIVER: f64 = 0.05;
/// A vertex with more curvature than this, in degrees, has few faces for much shape.
const SHARP: f64 = 90.0;

/// One sentence about the frame that a film leads to, or about each frame where every one is of another class; none
/// where all is well. What the scene bounds under `[checks]` is measured by that.
pub fn verdict(film: &[FrameReport], checks: &ChecksSection) -> Option<String> {
    let last = film.last().filter(|last| !last.on_the_way)?;
    let is_gallery = film.iter().any(|report| report.asked_class != last.asked_class);
    let results = if is_gallery { film } else { std::slice::from_ref(last) };
    let bad: Vec<(&FrameReport, Vec<String>)> = results
        .iter()
        .map(|report| (report, faults(report, checks)))
        .filter(|(_, faults)| !faults.is_empty())
        .collect();
    let (worst, faults) =
        bad.iter().max_by(|a, b| a.0.rims.cmp(&b.0.rims).then(a.0.l2_length_error.total_cmp(&b.0.l2_length_error)))?;
    let which = match (is_gallery, film.len()) {
        (true, all) => format!("{} of {all} frames are not what was asked for; frame {} has ", bad.len(), worst.frame),
        (false, 1) => "the surface is not what was asked for: it has ".to_owned(),
        (false, _) => "the last frame is not what was asked for: it has ".to_owned(),
    };
    Some(format!("{which}{}. {}", faults.join(", "), cause(worst)))
}

/// What is wrong with a frame, each with its place.
fn faults(report: &FrameReport, checks: &ChecksSection) -> Vec<String> {
    let mut faults = Vec::new();
    let places = &report.places;
    let at = |ends: &[usize; 2]| format!("{}-{}", ends[0], ends[1]);
    let list = |names: Vec<String>, all: usize| {
        let more = if all > names.len() { ", …" } else { "" };
        format!("{}{more}", names.join(", "))
    };
    let plural = |count: usize, one: &str| format!("{count} {one}{}", if count == 1 { "" } else { "s" });
    if report.rims > checks.max_rims.unwrap_or(0) {
        let edges = list(places.rims.iter().map(at).collect(), report.rims);
        faults.push(format!("{} (edges that fold over: {edges})", plural(report.rims, "rim")));
    }
    if report.pinch_points > checks.max_pinch_points.unwrap_or(0) {
        let vertices = list(places.pinch_points.iter().map(usize::to_string).collect(), report.pinch_points);
        faults.push(format!("{} (vertices {vertices})", plural(report.pinch_points, "pinch point")));
    }
    if report.l2_length_error > checks.max_l2_length_error.unwrap_or(LOUD_ERROR) {
        faults.push(format!(
            "a length error of {} (up to {}, at edge {})",
            percent(report.l2_length_error),
            percent(report.max_length_error),
            at(&places.worst_edge)
        ));
    }
    if report.pinch_points == 0 && !report.asked_class.is_empty() && report.spin_class != report.asked_class {
        faults.push(format!("class {} where {} was asked for", report.spin_class, report.asked_class));
    }
    if let Some(angles) = &report.bending_error
        && angles.rms_degrees > checks.rms_bending_error.unwrap_or(LOUD_ANGLE)
    {
        faults.push(format!(
            "bending angles {:.1} degrees from their targets (root mean square; up to {:.1}, at edge {})",
            angles.rms_degrees,
            angles.max_degrees,
            at(&angles.edge)
        ));
    }
    if let Some(distance) = report.pin_distance.filter(|far| *far > checks.max_pin_distance.unwrap_or(LOUD_PIN)) {
        faults.push(format!("a pinned vertex {distance:.3e} away from its place"));
    }
    faults
}

/// The likely cause, and what to try.
fn cause(report: &FrameReport) -> String {
    let places = &report.places;
    let is_only_angles = report.rims == 0 && report.pinch_points == 0 && report.l2_length_error <= LOUD_ERROR;
    if report.bending_error.is_some() && is_only_angles {
        return "Lengths come before angles, and every other bend resists: raise `bending_stiffness`, or ask for angles \
                that the lengths allow"
            .to_owned();
    }
    if report.pin_distance.is_some() {
        return "Pins may ask for what the lengths do not allow: `immerse check` compares them; pin fewer vertices, or \
                lead them elsewhere"
            .to_owned();
    }
    if places.thinness < SLIVER {
        return format!(
            "Slivers may be why: face {} is {:.1} % as high as long; use a mesh with better triangles there",
            places.thinnest_face,
            100.0 * places.thinness
        );
    }
    if places.sharpest_degrees.abs() > SHARP {
        return format!(
            "The mesh may be too coarse: vertex {} has a curvature of {:.0} degrees; refine it there",
            places.sharpest_vertex, places.sharpest_degrees
        );
    }
    if report.cursor.restarts >= MAX_RESTARTS {
        return format!(
            "This class is hard on this mesh: rims were left each of the {} times that frames were drawn; try a finer \
             mesh, another class or another seed under [start]",
            report.cursor.restarts + 1
        );
    }
    if report.is_unconverged() {
        return "Steps ran out before frames stood still: raise `max_steps` of the last phase".to_owned();
    }
    "The metric may need more folds than the mesh has room for: refine the mesh, or ask for a change that goes less far"
        .to_owned()
}
