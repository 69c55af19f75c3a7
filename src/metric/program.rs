//! Edge lengths as a function of time.

use super::change::Change;
use super::lengths::Lengths;
use super::{Metric, MetricError};
use crate::advice::Advice;
use crate::mesh::Mesh;
use crate::timeline::Keyframes;

/// Edge lengths at all times: keys and what is between them, and the changes made to that, one after another.
#[derive(Clone, Debug)]
pub struct MetricProgram {
    keys: Keyframes<Lengths>,
    interpolation: Interpolation,
    changes: Vec<Change>,
}

/// What is linear between two keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Lengths.
    Lengths,
    /// Squared lengths, that is the metric tensor of each triangle.
    #[default]
    Squared,
    /// Logarithms of lengths.
    Logarithms,
}

/// The metric at a time.
#[derive(Clone, Debug)]
pub struct MetricAt {
    /// Its lengths, and what they determine.
    pub metric: Metric,
    /// With Ricci flow: how far any curvature is from its target, in radians.
    pub curvature_error: Option<f64>,
}

/// The part of a [`MetricProgram`] that is at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MetricPart {
    /// The lengths that it begins with.
    Lengths,
    /// The change of this number, from 0.
    Change(usize),
}

/// Why there is no metric at a time.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at time {time}: {error}")]
pub struct NoMetric {
    /// When.
    pub time: f64,
    /// Which part says so.
    pub part: MetricPart,
    /// Why.
    pub error: MetricError,
}

impl Advice for NoMetric {
    fn remedy(&self) -> String {
        self.error.remedy()
    }
}

impl MetricProgram {
    /// Lengths at several times, and what is linear between them.
    pub fn new(keys: Keyframes<Lengths>, interpolation: Interpolation) -> MetricProgram {
        MetricProgram { keys, interpolation, changes: Vec::new() }
    }

    /// The same lengths at all times, or those that change by themselves.
    pub fn of(lengths: Lengths) -> MetricProgram {
        MetricProgram::new(Keyframes::constant(lengths), Interpolation::default())
    }

    /// With a change made to all that came before.
    pub fn changed_by(mut self, change: Change) -> MetricProgram {
        self.changes.push(change);
        self
    }

    /// Whether the metric can depend on time.
    pub fn changes(&self) -> bool {
        self.keys.values().len() > 1
            || self.keys.values().iter().any(Lengths::changes)
            || self.changes.iter().any(Change::changes)
    }

    /// What is worth saying of the metrics found so far, with the number of the change that it is about.
    pub fn notes(&self) -> Vec<(usize, &'static str)> {
        let notes = self.changes.iter().map(Change::note).enumerate();
        notes.filter_map(|(number, note)| Some((number, note?))).collect()
    }

    /// The metric at a time. Cheapest for increasing times; the same bits in any order.
    ///
    /// # Errors
    /// [`NoMetric`]: lengths that are no metric at that time, with the face or edge, and what a flow refuses.
    pub fn at(&mut self, mesh: &Mesh, time: f64) -> Result<MetricAt, NoMetric> {
        let fault = |part| move |error| NoMetric { time, part, error };
        let mut metric = Metric::new(mesh, self.between_keys(time)).map_err(fault(MetricPart::Lengths))?;
        let mut curvature_error = None;
        for (number, change) in self.changes.iter_mut().enumerate() {
            let fault = fault(MetricPart::Change(number));
            let lengths;
            (lengths, curvature_error) = change.apply(mesh, metric.edge_lengths().to_vec(), time).map_err(&fault)?;
            metric = Metric::new(mesh, lengths).map_err(&fault)?;
        }
        Ok(MetricAt { metric, curvature_error })
    }

    fn between_keys(&self, time: f64) -> Vec<f64> {
        let (before, after, part) = self.keys.around(time);
        if part == 0.0 {
            return before.at(time);
        }
        if part == 1.0 {
            return after.at(time);
        }
        let mix = |a: f64, b: f64| a + (b - a) * part;
        let between = |(a, b): (f64, f64)| match self.interpolation {
            Interpolation::Lengths => mix(a, b),
            // Extrapolated squares may be negative, which is no length either.
            Interpolation::Squared => mix(a * a, b * b).sqrt(),
            Interpolation::Logarithms => libm::exp(mix(libm::log(a), libm::log(b))),
        };
        before.at(time).into_iter().zip(after.at(time)).map(between).collect()
    }
}
