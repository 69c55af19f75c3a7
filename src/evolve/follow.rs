//! From one frame to the next: the metric moves on, and the class does not (App. B.2).

use super::course::Course;
use super::error::EvolveError;
use super::pace::Settling;
use super::progress::Observer;
use super::relax::Relaxation;
use super::state::State;
use crate::mesh::VertexId;
use crate::metric::{Metric, largest_strain};
use crate::timeline::Clock;
use glam::DVec3;

impl Relaxation {
    /// Follows metric, bending and pins to a time, in parts none of which strains the component much.
    pub(super) fn follow(
        &mut self,
        course: &mut Course,
        time: f64,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let there = course.metric_of(self.state().component(), time)?;
        let parts = parts_to(self.state(), course, time, &there, settling.max_strain())?;
        let from = self.state().time();
        for part in 1..parts {
            self.state_mut().move_to(course, from + (time - from) * part as f64 / parts as f64)?;
            self.pass(settling, observer)?;
        }
        self.state_mut().take_on(course, time, there)?;
        self.settle(settling, observer)
    }

    /// Once around a loop, so that its first frame is what the last one leads to.
    pub(super) fn run_a_lap(
        &mut self,
        course: &mut Course,
        clock: &Clock,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        // The way to the end of the loop leads on, not back through it.
        for time in clock.times().skip(1).chain([clock.end()]) {
            self.follow(course, time, settling, observer)?;
        }
        self.state_mut().move_to(course, clock.time(1))
    }
}

/// How many parts the way to the metric of a time is to be cut into.
fn parts_to(state: &State, course: &Course, time: f64, there: &Metric, max_strain: f64) -> Result<usize, EvolveError> {
    let lengths = [state.metric().edge_lengths(), there.edge_lengths()];
    Ok(parts_between(lengths, [state.pins(), &course.pins_of(state.component(), time)?], max_strain))
}

/// As many parts as keep strains below the largest one, and pins from moving by more than the mean length of an edge.
pub(super) fn parts_between(lengths: [&[f64]; 2], pins: [&[(VertexId, DVec3)]; 2], max_strain: f64) -> usize {
    let [here, there] = lengths;
    let mean_length = here.iter().sum::<f64>() / here.len() as f64;
    let longest = pins[1].iter().zip(pins[0]).map(|((_, a), (_, b))| a.distance(*b)).fold(0.0, f64::max);
    let parts = (largest_strain(here, there) / max_strain).max(longest / mean_length);
    (parts.ceil() as usize).max(1)
}
