//! The `[metric]` of a scene: edge lengths as a function of time.

use super::change::Change;
use super::lengths::Lengths;
use super::{Metric, MetricError};
use crate::mesh::{Mesh, Surface};
use crate::scene::{AtKey, Interpolation, MetricSection};
use crate::timeline::{Keyframes, Parameters};
use std::path::Path;
use std::sync::Arc;

/// Edge lengths at all times: keys and what is between them, and the changes made to that, one after another.
#[derive(Clone, Debug)]
pub struct MetricProgram {
    keys: Keyframes<Lengths>,
    interpolation: Interpolation,
    changes: Vec<Change>,
    /// The key of the scene that lengths come from.
    key: String,
}

/// The metric at a time.
#[derive(Clone, Debug)]
pub struct MetricAt {
    /// Its lengths, and what they determine.
    pub metric: Metric,
    /// With Ricci flow: how far any curvature is from its target, in radians.
    pub curvature_error: Option<f64>,
}

impl MetricProgram {
    /// Validates what the scene says of a surface; `folder` is where relative paths start.
    ///
    /// # Errors
    /// [`MetricError`] with the key of the scene that is at fault.
    pub fn from_scene(
        section: &MetricSection,
        folder: &Path,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<MetricProgram, AtKey<MetricError>> {
        let lengths = |source, key: &str| Lengths::from_scene(source, key, folder, surface, parameters);
        let (mut times, mut values) = (Vec::new(), Vec::new());
        for (k, key) in section.keys.iter().enumerate() {
            times.push(key.time);
            values.push(lengths(&key.lengths, &format!("metric.key[{k}]"))?);
        }
        let key = if times.is_empty() { "metric" } else { "metric.key" }.to_owned();
        if times.is_empty() {
            times.push(0.0);
            values.push(lengths(&section.lengths, "metric")?);
        }
        let keys = Keyframes::new(times, values, section.ease, section.extrapolation).map_err(AtKey::of(&*key))?;
        let change =
            |(k, change)| Change::from_scene(change, format!("metric.change[{k}]"), folder, surface, parameters);
        let changes = section.changes.iter().enumerate().map(change).collect::<Result<_, _>>()?;
        Ok(MetricProgram { keys, interpolation: section.interpolation, changes, key })
    }

    /// Whether the metric can depend on time.
    pub fn changes(&self) -> bool {
        self.keys.values().len() > 1
            || self.keys.values().iter().any(Lengths::changes)
            || self.changes.iter().any(Change::changes)
    }

    /// What is worth saying of the metrics found so far.
    pub fn notes(&self) -> Vec<String> {
        self.changes.iter().filter_map(Change::note).collect()
    }

    /// The metric at a time. Cheapest for increasing times; the same bits in any order.
    ///
    /// # Errors
    /// [`MetricError`] with the key of the scene that is at fault: lengths that are no metric at that time, with the
    /// face or edge, and what a flow refuses.
    pub fn at(&mut self, mesh: &Mesh, time: f64) -> Result<MetricAt, AtKey<MetricError>> {
        let mut metric = Metric::new(mesh, self.between_keys(time)).map_err(AtKey::of(&*self.key))?;
        let mut curvature_error = None;
        for change in &mut self.changes {
            let lengths;
            let apply = change.apply(mesh, metric.edge_lengths().to_vec(), time);
            (lengths, curvature_error) = apply.map_err(AtKey::of(&*change.key))?;
            metric = Metric::new(mesh, lengths).map_err(AtKey::of(&*change.key))?;
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
