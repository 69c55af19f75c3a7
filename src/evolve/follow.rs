//! From one frame to the next: the metric moves on, and the class does not (App. B.2).

use super::course::Course;
use super::error::{EvolveError, FarMove};
use super::pace::Settling;
use super::progress::Observer;
use super::relax::Relaxation;
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::{Metric, largest_strain};
use crate::timeline::Clock;
use crate::tuning::{HALVINGS_OF_A_PART, MOST_PARTS_OF_A_FRAME};
use glam::DVec3;
use std::sync::Arc;

impl Relaxation {
    /// Follows metric, bending and pins to a time, in parts none of which strains the component much. Where a step
    /// fails, though there is a metric, it goes back and takes the way in parts of half the length, a few times. If that
    /// does not help it is where it was before. All parts are halved so often to begin with.
    pub(super) fn follow(
        &mut self,
        course: &mut Course,
        time: f64,
        settling: &Settling,
        halvings: usize,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let there = course.metric_of(self.state().component(), time)?;
        let pins = course.pins_of(self.state().component(), time)?;
        let state = self.state();
        let here = Station { metric: state.metric(), pins: state.pins() };
        let parts = here.parts_to(&Station { metric: &there, pins: &pins }, state.mesh(), time, settling)? << halvings;
        let before = self.mark();
        let first = match self.go(course, time, &there, parts, settling, observer) {
            Err(error) if error.is_of_step() => error,
            outcome => return outcome,
        };
        for halvings in 1..=HALVINGS_OF_A_PART {
            self.go_back(course, &before)?;
            match self.go(course, time, &there, parts << halvings, settling, observer) {
                Err(EvolveError::Stopped { steps }) => return Err(EvolveError::Stopped { steps }),
                Err(_) => {}
                Ok(()) => return Ok(()),
            }
        }
        self.go_back(course, &before)?;
        Err(first)
    }

    /// As [`Relaxation::follow`], in so many parts.
    fn go(
        &mut self,
        course: &mut Course,
        time: f64,
        there: &Arc<Metric>,
        parts: usize,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let from = self.state().time();
        for part in 1..parts {
            self.state_mut().move_to(course, from + (time - from) * part as f64 / parts as f64)?;
            self.pass(settling, observer)?;
        }
        self.state_mut().take_on(course, time, there.clone())?;
        self.settle(settling, observer)?;
        self.state().verify_class()
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
            self.follow(course, time, settling, 0, observer)?;
        }
        self.state_mut().move_to(course, clock.time(1))
    }
}

/// What is asked of a component at a time.
pub(super) struct Station<'a> {
    pub metric: &'a Metric,
    /// Pinned vertices and their places.
    pub pins: &'a [(VertexId, DVec3)],
}

impl Station<'_> {
    /// How many parts the way to another one, at a time, is to be cut into.
    ///
    /// # Errors
    /// [`EvolveError::TooFar`] if it would take more than a film can wait for.
    pub fn parts_to(&self, there: &Station, mesh: &Mesh, time: f64, settling: &Settling) -> Result<usize, EvolveError> {
        let (lengths, next) = (self.metric.edge_lengths(), there.metric.edge_lengths());
        let mean_length = self.metric.mean_edge_length();
        let moves = self.pins.iter().zip(there.pins).map(|((v, a), (_, b))| (*v, a.distance(*b)));
        let (pin, longest) = moves.fold((VertexId::new(0), 0.0), |most, one| if one.1 > most.1 { one } else { most });
        let strain = largest_strain(lengths, next);
        let of_strain = strain / settling.max_strain();
        let parts = of_strain.max(longest / mean_length).ceil();
        if parts <= MOST_PARTS_OF_A_FRAME as f64 {
            return Ok((parts as usize).max(1));
        }
        let what = if of_strain >= parts - 1.0 {
            let strains = |e: &EdgeId| libm::log(next[e.index()] / lengths[e.index()]).abs() == strain;
            let edge = mesh.edges().find(strains).unwrap_or(EdgeId::new(0));
            FarMove::Edge { ends: mesh.file_ends(edge), factor: next[edge.index()] / lengths[edge.index()] }
        } else {
            FarMove::Pin { vertex: mesh.file_vertex(pin), distance: longest, mean_length }
        };
        Err(EvolveError::TooFar { time, parts, most: MOST_PARTS_OF_A_FRAME, what })
    }
}
