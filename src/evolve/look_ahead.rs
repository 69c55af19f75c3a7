//! What is asked for at the times of all frames, found without simulating: faults that a film would end with half way.

use super::course::Course;
use super::error::EvolveError;
use super::follow::Station;
use super::pace::Pace;
use crate::mesh::{Component, VertexId};
use crate::metric::Metric;
use crate::timeline::Clock;
use crate::tuning::LOOK_AHEAD;
use glam::DVec3;
use std::sync::Arc;

/// The numbers of the frames that are looked at, of a film of so many on a surface with so many faces: all of them, or
/// as many as are seen in a moment, evenly, with the first and the last.
pub(super) fn frames_to_look_at(frames: usize, faces: usize) -> impl Iterator<Item = usize> {
    let stride = frames.div_ceil((LOOK_AHEAD / faces.max(1)).max(1)).max(1);
    (1..frames).step_by(stride).chain([frames])
}

/// What was asked of a component at the frame before.
struct Last {
    frame: usize,
    metric: Arc<Metric>,
    pins: Vec<(VertexId, DVec3)>,
}

/// Whether there is a metric, and angles and places for pins, at the times of all frames, and a way from one to the next
/// that a film can go.
///
/// # Errors
/// [`EvolveError`] at the first time at which there is not.
pub(super) fn look_ahead(
    course: &mut Course,
    clock: &Clock,
    pace: Pace,
    components: &[&Component],
    faces: usize,
) -> Result<(), EvolveError> {
    let frames = if course.changes() { clock.frames() } else { 1 };
    let mut last: Vec<Option<Last>> = components.iter().map(|_| None).collect();
    for frame in frames_to_look_at(frames, faces) {
        let time = clock.time(frame);
        course.check(time)?;
        let Pace::Settle(settling) = pace else { continue };
        for (component, last) in components.iter().zip(&mut last) {
            let (metric, pins) = (course.metric_of(component, time)?, course.pins_of(component, time)?);
            if let Some(last) = last.as_ref().filter(|last| last.frame + 1 == frame) {
                let here = Station { metric: &last.metric, pins: &last.pins };
                here.parts_to(&Station { metric: &metric, pins: &pins }, &component.mesh, time, &settling)?;
            }
            *last = Some(Last { frame, metric, pins });
        }
    }
    Ok(())
}
