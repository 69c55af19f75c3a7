//! From one frame to the next: the metric moves on, and the class does not (App. B.2).

use super::discretization::Discretization;
use super::{EvolveError, Observer, Settling, Simulation};
use crate::mesh::VertexId;
use crate::metric::MetricAt;
use crate::spin::{ChangeOfMetric, class_digits};

/// Steps on the way to the time of a frame; it has to settle only there.
const STEPS_ON_THE_WAY: usize = 3;

impl Simulation {
    /// Follows metric, bending and pins to a time, in parts none of which strains the surface much.
    pub(super) fn follow(
        &mut self,
        time: f64,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let phase = settling.phase(&self.phases);
        let there = self.metric_at(time)?;
        let parts = self.parts_to(time, &there, settling.max_strain)?;
        let from = self.time;
        let phases_done = self.phases.len();
        self.cursor = self.cursor.at_start_of(phases_done);
        for part in 1..parts {
            self.move_to(from + (time - from) * part as f64 / parts as f64)?;
            self.run_phase(&phase, STEPS_ON_THE_WAY, observer)?;
            self.cursor = self.cursor.at_start_of(phases_done);
        }
        self.take_on(time, there)?;
        self.run_phase(&phase, settling.max_steps, observer)?;
        self.cursor = self.cursor.at_start_of(phases_done);
        Ok(())
    }

    /// Once around a loop, so that its first frame is what the last one leads to.
    pub(super) fn run_a_lap(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let clock = self.clock;
        // The way to the end of the loop leads on, not back through it.
        for time in clock.times().skip(1).chain([clock.end()]) {
            self.follow(time, settling, observer)?;
        }
        self.move_to(clock.time(1))
    }

    /// How many parts the way to the metric of a time is to be cut into.
    fn parts_to(&self, time: f64, there: &MetricAt, max_strain: f64) -> Result<usize, EvolveError> {
        let there = &there.metric;
        let mean_length = self.metric.edge_lengths().iter().sum::<f64>() / self.mesh.edge_count() as f64;
        let shift = self.pins.at(time)?;
        let longest = shift.iter().zip(&self.places).map(|((_, a), (_, b))| a.distance(*b)).fold(0.0, f64::max);
        let parts = (strain(self.metric.edge_lengths(), there.edge_lengths()) / max_strain).max(longest / mean_length);
        Ok((parts.ceil() as usize).max(1))
    }

    /// Takes metric, bending and pins to a time, with spin structure and frames.
    pub(super) fn move_to(&mut self, time: f64) -> Result<(), EvolveError> {
        let there = self.metric_at(time)?;
        self.take_on(time, there)
    }

    /// As [`Simulation::move_to`], with the metric of that time.
    fn take_on(&mut self, time: f64, there: MetricAt) -> Result<(), EvolveError> {
        let MetricAt { metric, curvature_error } = there;
        self.curvature_error = curvature_error;
        self.time = time;
        let changed = metric.edge_lengths() != self.metric.edge_lengths();
        if changed {
            let change = ChangeOfMetric::new(&self.mesh, &self.spin, &self.metric, &metric);
            change.carry(&mut self.frames);
            self.spin = change.spin;
            self.metric = metric;
        }
        if changed || self.bending.as_ref().is_some_and(|bending| bending.changes()) || self.pins.changes() {
            self.discretize()?;
        }
        Ok(())
    }

    /// What follows from metric, spin structure, bending and pins at the present time.
    pub(super) fn discretize(&mut self) -> Result<(), EvolveError> {
        let angles = self.bending.as_ref().map(|bending| bending.at(self.time)).transpose()?;
        self.places = self.pins.at(self.time)?;
        let Simulation { mesh, metric, spin, homology, pins, .. } = self;
        (self.parts, ()) =
            Discretization::new(mesh, metric, spin, homology, angles.as_deref(), pins.vertices(), |_| ())
                .map_err(|error| EvolveError::Poisson { time: self.time, error })?;
        Ok(())
    }

    fn metric_at(&mut self, time: f64) -> Result<MetricAt, EvolveError> {
        self.program.at(&self.mesh, time).map_err(|error| EvolveError::Metric { time, error })
    }

    /// Theorem: the class of every generator and the figure-0 stars are what they were. Rounding could break it.
    pub(super) fn verify_class(&self) -> Result<(), EvolveError> {
        let stars = self.spin.figure_8_vertices(&self.mesh, &self.metric);
        let class = self.spin.class(&self.mesh, &self.metric, &self.homology);
        if let Some(vertex) = stars.first() {
            return Err(EvolveError::StarChanged {
                time: self.time,
                vertex: self.mesh.file_vertex(VertexId::new(*vertex)),
            });
        }
        if class != self.class {
            let [before, after] = [&self.class, &class].map(|class| class_digits(class));
            return Err(EvolveError::ClassChanged { time: self.time, before, after });
        }
        Ok(())
    }

    /// Whether the scene gives a metric, bending angles and places for pins at the times of all frames, found without
    /// simulating.
    ///
    /// # Errors
    /// [`EvolveError::Metric`], [`EvolveError::Pin`], [`EvolveError::Bending`] at the first time at which it does not.
    pub fn check_all_times(&mut self) -> Result<(), EvolveError> {
        let clock = self.clock;
        for time in clock.times() {
            if self.program.changes() {
                self.metric_at(time)?;
            }
            self.pins.at(time)?;
            self.bending.as_ref().map(|bending| bending.at(time)).transpose()?;
        }
        Ok(())
    }
}

/// The largest change of an edge's length between two lists of them, as a share of it.
pub(super) fn strain(before: &[f64], after: &[f64]) -> f64 {
    before.iter().zip(after).map(|(a, b)| libm::log(b / a).abs()).fold(0.0, f64::max)
}
