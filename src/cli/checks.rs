//! Whether a film is what its scene says it must be.

use serde::Serialize;
use serde_json::Value as Json;

use crate::cache::FrameReport;
use crate::scene::ChecksSection;

/// One entry of `[checks]`, compared with the last frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Its key in the scene.
    pub name: &'static str,
    /// What the scene asks for.
    pub limit: Json,
    /// What was measured; null if there is no frame.
    pub value: Json,
    /// Whether it holds.
    pub holds: bool,
}

/// Compares what a scene asks for with the report of the last frame. Without a frame nothing holds.
pub fn checks_of(checks: &ChecksSection, last: Option<&FrameReport>) -> Vec<Check> {
    let mut list = Vec::new();
    if let Some(limit) = checks.max_l2_length_error {
        list.push(check("max_l2_length_error", limit, last.map(|report| report.l2_length_error), |x, max| x <= max));
    }
    if let Some(limit) = checks.max_rims {
        list.push(check("max_rims", limit, last.map(|report| report.rims), |x, max| x <= max));
    }
    if let Some(limit) = checks.max_pinch_points {
        list.push(check("max_pinch_points", limit, last.map(|report| report.pinch_points), |x, max| x <= max));
    }
    if let Some(limit) = &checks.class {
        list.push(check("class", limit.clone(), last.map(|report| report.spin_class.clone()), |x, y| x == y));
    }
    list
}

fn check<T: Clone + Into<Json>>(name: &'static str, limit: T, value: Option<T>, holds: fn(&T, &T) -> bool) -> Check {
    let holds = value.as_ref().is_some_and(|value| holds(value, &limit));
    Check { name, limit: limit.into(), value: value.map_or(Json::Null, Into::into), holds }
}
