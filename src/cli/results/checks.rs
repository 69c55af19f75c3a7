//! Whether a film is what its scene says it must be.

use serde::Serialize;
use serde_json::Value as Json;

use crate::evolve::FrameReport;
use crate::film::{Certificate, EventKind, FilmError};
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
    /// Why it does not, where the value alone does not say so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
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
        check("class", checks.class.clone(), class_of_all(film, checks.class.as_deref()), |x, y| x == y)
            .map(|check| Check { reason: without_class(film, checks.class.as_deref()), ..check }),
        check("max_curvature_error", checks.max_curvature_error, last.and_then(|r| r.curvature_error), at_most),
        check("max_mean_distance", checks.max_mean_distance, last.and_then(|r| r.mean_distance), at_most),
        check("max_pin_distance", checks.max_pin_distance, last.and_then(|r| r.pin_distance), at_most),
        check(
            "rms_bending_error",
            checks.rms_bending_error,
            last.and_then(|r| r.bending_error).map(|e| e.rms_degrees),
            at_most,
        ),
        check(
            "max_bending_error",
            checks.max_bending_error,
            last.and_then(|r| r.bending_error).map(|e| e.max_degrees),
            at_most,
        ),
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
        check("film.max_unconverged", film_checks.max_unconverged, unconverged(film), no_more),
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
    Some(Check { name, limit: limit.into(), value: value.map_or(Json::Null, Into::into), holds, reason: None })
}

/// Compares what a scene asks for with what happens between its frames: a certificate, or why there is none.
pub fn check_of_homotopy(checks: &ChecksSection, found: &Result<Certificate, FilmError>) -> Option<Check> {
    let asked = checks.film.regular_homotopy.filter(|asked| *asked)?;
    let name = "film.regular_homotopy";
    let check = |value: Json, holds, reason| Check { name, limit: asked.into(), value, holds, reason };
    Some(match found {
        Ok(certificate) => {
            let holds = certificate.is_regular_homotopy;
            check(holds.into(), holds, (!holds).then(|| why_no_homotopy(certificate)))
        }
        Err(error) => check(Json::Null, false, Some(error.to_string())),
    })
}

fn why_no_homotopy(certificate: &Certificate) -> String {
    let remedy = "`immerse certify` lists all; make the film of more frames, or of a finer mesh there";
    match (certificate.events.first(), certificate.pinch_points) {
        (Some(first), _) => {
            let what = match first.kind {
                EventKind::Fold => "the hinge",
                EventKind::Face => "the face",
            };
            let ([from, to], count) = (first.frames, certificate.events.len());
            let events = if count == 1 { "event" } else { "events" };
            let vertices = &first.vertices;
            format!(
                "{count} {events}, the first at {what} with vertices {vertices:?} between frames {from} and {to}; {remedy}"
            )
        }
        (None, pinched) => format!("the first frame has {pinched} pinch points, where it is no immersion"),
    }
}

/// The class of the first frame that has another one than asked for, or of the last.
fn class_of_all(film: &[FrameReport], asked: Option<&str>) -> Option<String> {
    of_another_class(film, asked).or(film.last()).map(|report| report.spin_class.clone())
}

fn of_another_class<'a>(film: &'a [FrameReport], asked: Option<&str>) -> Option<&'a FrameReport> {
    film.iter().find(|report| Some(report.spin_class.as_str()) != asked)
}

/// Says so if that frame has no class at all.
fn without_class(film: &[FrameReport], asked: Option<&str>) -> Option<String> {
    let FrameReport { frame, pinch_points, .. } =
        of_another_class(film, asked).filter(|report| report.has_no_class())?;
    let points = if *pinch_points == 1 { "point" } else { "points" };
    Some(format!(
        "frame {frame} has {pinch_points} pinch {points}, where it is no immersion: a surface that is pinched is in no class"
    ))
}

/// The number of frames that ran into the limit of steps; none of no film.
fn unconverged(film: &[FrameReport]) -> Option<usize> {
    (!film.is_empty()).then(|| film.iter().filter(|report| report.is_unconverged()).count())
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

/// One line about the frames of a film that ran into the limit of steps before they settled, if any did: which, and
/// what to try.
pub fn step_limit_line(film: &[FrameReport]) -> Option<String> {
    let unconverged: Vec<&FrameReport> = film.iter().filter(|report| report.is_unconverged()).collect();
    let (first, last) = (unconverged.first()?.frame, unconverged.last()?.frame);
    let (count, all) = (unconverged.len(), film.len());
    let worst = unconverged.iter().map(|report| report.l2_length_error).fold(0.0, f64::max);
    let error = super::text_table::percent(worst);
    if all == 1 {
        return Some(format!(
            "the frame ran into the step limit before it settled; its length error is {error}; raise `max_steps` of the \
             last [[phase]], or its `tolerance`"
        ));
    }
    // A first frame goes through the phases, those that follow have a limit of their own.
    let limit = match (first, last) {
        (1, 1) => "`max_steps` of the last [[phase]]",
        (1, _) => "`max_steps` of the last [[phase]] and under [clock]",
        _ => "`max_steps` under [clock]",
    };
    let frames = ranges(&unconverged.iter().map(|report| report.frame).collect::<Vec<_>>());
    Some(format!(
        "{count} of {all} frames ran into the step limit before they settled ({frames}); their length error is up to \
         {error}; raise {limit}, raise `tolerance` there, or make the film of more frames"
    ))
}

/// Frame numbers in order as in 1-20,30.
pub(in crate::cli) fn ranges(frames: &[usize]) -> String {
    let stretches = frames.chunk_by(|a, b| a + 1 == *b);
    let in_words = |stretch: &[usize]| match stretch {
        [first, .., last] => format!("{first}-{last}"),
        one => one.iter().map(usize::to_string).collect(),
    };
    let mut texts: Vec<String> = stretches.clone().take(SHOWN_RANGES).map(in_words).collect();
    let more = stretches.count().saturating_sub(SHOWN_RANGES);
    if more > 0 {
        texts.push(format!("and {more} more stretches"));
    }
    texts.join(",")
}

/// Stretches of frames that are listed.
const SHOWN_RANGES: usize = 12;
