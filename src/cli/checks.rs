//! Whether a film is what its scene says it must be.

use serde::Serialize;
use serde_json::Value as Json;

use crate::cache::FrameReport;
use crate::scene::ChecksSection;

/// One entry of `[checks]`, compared with the film.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Its key in the scene.
    pub name: &'static str,
    /// What the scene asks for.
    pub limit: Json,
    /// What was measured; null if there is no frame, or nothing of the kind in it.
    pub value: Json,
    /// Whether it holds.
    pub holds: bool,
}

/// Compares what a scene asks for with the reports of all frames, in order. Without a frame nothing holds.
pub fn checks_of(checks: &ChecksSection, film: &[FrameReport]) -> Vec<Check> {
    let last = film.last();
    let film_checks = &checks.film;
    let at_most = |x: &f64, max: &f64| x <= max;
    let no_more = |x: &usize, max: &usize| x <= max;
    let list = [
        check("max_l2_length_error", checks.max_l2_length_error, last.map(|r| r.l2_length_error), at_most),
        check("max_rims", checks.max_rims, last.map(|r| r.rims), no_more),
        check("max_pinch_points", checks.max_pinch_points, last.map(|r| r.pinch_points), no_more),
        check("class", checks.class.clone(), class_of_all(film, checks.class.as_deref()), |x, y| x == y),
        check("max_curvature_error", checks.max_curvature_error, last.and_then(|r| r.curvature_error), at_most),
        check("max_mean_distance", checks.max_mean_distance, last.and_then(|r| r.mean_distance), at_most),
        check("max_pin_distance", checks.max_pin_distance, last.and_then(|r| r.pin_distance), at_most),
        check(
            "film.max_l2_length_error",
            film_checks.max_l2_length_error,
            largest(film, |r| r.l2_length_error),
            at_most,
        ),
        check(
            "film.median_l2_length_error",
            film_checks.median_l2_length_error,
            median(film, |r| r.l2_length_error),
            at_most,
        ),
        check("film.max_rims", film_checks.max_rims, film.iter().map(|r| r.rims).max(), no_more),
        check("film.max_jump", film_checks.max_jump, jump(film), at_most),
    ];
    list.into_iter().flatten().collect()
}

fn check<T: Clone + Into<Json>>(
    name: &'static str,
    limit: Option<T>,
    value: Option<T>,
    holds: fn(&T, &T) -> bool,
) -> Option<Check> {
    let limit = limit?;
    let holds = value.as_ref().is_some_and(|value| holds(value, &limit));
    Some(Check { name, limit: limit.into(), value: value.map_or(Json::Null, Into::into), holds })
}

/// The class of the first frame that has another one than asked for, or of the last.
fn class_of_all(film: &[FrameReport], asked: Option<&str>) -> Option<String> {
    let other = film.iter().find(|report| Some(report.spin_class.as_str()) != asked);
    other.or(film.last()).map(|report| report.spin_class.clone())
}

/// The largest move of a vertex between frames, in units of the median over the film of each frame's largest move.
/// The first frame has none.
fn jump(film: &[FrameReport]) -> Option<f64> {
    let moving = film.get(1..)?;
    let median = median(moving, |report| report.max_move)?;
    let largest = largest(moving, |report| report.max_move)?;
    if largest == 0.0 { Some(0.0) } else { Some(largest / median) }
}

/// What is not a number is larger than all.
fn largest(film: &[FrameReport], value: fn(&FrameReport) -> f64) -> Option<f64> {
    film.iter().map(value).reduce(|a, b| if b <= a || a.is_nan() { a } else { b })
}

fn median(film: &[FrameReport], value: fn(&FrameReport) -> f64) -> Option<f64> {
    let mut values: Vec<f64> = film.iter().map(value).collect();
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
