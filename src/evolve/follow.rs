//! From one frame to the next: the metric moves on, and the class does not (App. B.2).

use super::course::Course;
use super::discretization::Discretization;
use super::relaxation::Relaxation;
use super::{EvolveError, Observer, Settling};
use crate::mesh::VertexId;
use crate::metric::Metric;
use crate::spin::{ChangeOfMetric, class_digits};
use crate::timeline::Clock;
use std::sync::Arc;

/// Steps on the way to the time of a frame; it has to settle only there.
const STEPS_ON_THE_WAY: usize = 3;

impl Relaxation {
    /// Follows metric, bending and pins to a time, in parts none of which strains the component much.
    pub(super) fn follow(
        &mut self,
        course: &mut Course,
        time: f64,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let there = course.metric_of(&self.component, time)?;
        let parts = self.parts_to(course, time, &there, settling.max_strain)?;
        let from = self.time;
        let phases_done = self.phases.len();
        self.cursor = self.cursor.at_start_of(phases_done);
        for part in 1..parts {
            self.move_to(course, from + (time - from) * part as f64 / parts as f64)?;
            self.run_phase(&self.following_phase(settling), STEPS_ON_THE_WAY, observer)?;
            self.cursor = self.cursor.at_start_of(phases_done);
        }
        self.take_on(course, time, there)?;
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
        self.move_to(course, clock.time(1))
    }

    /// How many parts the way to the metric of a time is to be cut into.
    fn parts_to(&self, course: &Course, time: f64, there: &Metric, max_strain: f64) -> Result<usize, EvolveError> {
        let mean_length = self.metric.edge_lengths().iter().sum::<f64>() / self.component.mesh.edge_count() as f64;
        let shift = course.pins_of(&self.component, time)?;
        let longest = shift.iter().zip(&self.places).map(|((_, a), (_, b))| a.distance(*b)).fold(0.0, f64::max);
        let parts = (strain(self.metric.edge_lengths(), there.edge_lengths()) / max_strain).max(longest / mean_length);
        Ok((parts.ceil() as usize).max(1))
    }

    /// Takes metric, bending and pins to a time, with spin structure and frames.
    pub(super) fn move_to(&mut self, course: &mut Course, time: f64) -> Result<(), EvolveError> {
        let there = course.metric_of(&self.component, time)?;
        self.take_on(course, time, there)
    }

    /// As [`Relaxation::move_to`], with the metric of that time.
    fn take_on(&mut self, course: &Course, time: f64, metric: Arc<Metric>) -> Result<(), EvolveError> {
        self.time = time;
        let changed = metric.edge_lengths() != self.metric.edge_lengths();
        if changed {
            let change = ChangeOfMetric::new(&self.component.mesh, &self.spin, &self.metric, &metric);
            change.carry(&mut self.face_frames);
            self.spin = change.spin;
            self.metric = metric;
        }
        if changed || course.changes_besides_metric() {
            self.discretize(course)?;
        }
        Ok(())
    }

    /// What follows from metric, spin structure, bending and pins at the present time.
    pub(super) fn discretize(&mut self, course: &Course) -> Result<(), EvolveError> {
        self.angles = course.angles_of(&self.component, self.time)?;
        self.places = course.pins_of(&self.component, self.time)?;
        let Relaxation { component, metric, spin, homology, angles, places, .. } = self;
        let pinned: Vec<VertexId> = places.iter().map(|(v, _)| *v).collect();
        (self.parts, ()) =
            Discretization::new(&component.mesh, metric, spin, homology, angles.as_deref(), &pinned, |_| ())
                .map_err(|error| EvolveError::Poisson { time: self.time, error })?;
        Ok(())
    }

    /// Theorem: the class of every generator and the figure-0 stars are what they were. Rounding could break it.
    pub(super) fn verify_class(&self) -> Result<(), EvolveError> {
        let Relaxation { component, metric, homology, spin, .. } = self;
        let stars = spin.figure_8_vertices(&component.mesh, metric);
        let class = spin.class(&component.mesh, metric, homology);
        if let Some(vertex) = stars.first() {
            let vertex = component.mesh.file_vertex(VertexId::new(*vertex));
            return Err(EvolveError::StarChanged { time: self.time, vertex });
        }
        if class != self.class {
            let [before, after] = [&self.class, &class].map(|class| class_digits(class));
            return Err(EvolveError::ClassChanged { time: self.time, before, after });
        }
        Ok(())
    }
}

/// The largest change of an edge's length between two lists of them, as a share of it.
pub(super) fn strain(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| libm::log(b / a).abs()).fold(0.0, f64::max)
}
