//! How far the lengths of a realized surface are from those asked for.

use super::TASK;
use crate::algebra::inner_product;
use crate::mesh::{EdgeId, Mesh};
use crate::metric::Metric;
use glam::DVec3;
use rayon::prelude::*;

/// Relative length error over all edges, `|f_e|/ℓ_e − 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthError {
    /// Root of the mean square.
    pub l2: f64,
    /// Largest absolute value.
    pub max: f64,
    /// Median of absolute values.
    pub median: f64,
    /// 95th percentile of absolute values.
    pub p95: f64,
}

/// Relative length errors of all edges, |E|, signed.
pub fn length_errors(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> Vec<f64> {
    (0..mesh.edge_count())
        .into_par_iter()
        .with_min_len(TASK)
        .map(|e| {
            let e = EdgeId::new(e);
            let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
            (b - a).length() / metric.length(e) - 1.0
        })
        .collect()
}

/// Statistics of [`length_errors`].
pub fn length_error(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> LengthError {
    let errors = length_errors(mesh, metric, positions);
    let l2 = root_mean_square(&errors);
    let mut sizes: Vec<f64> = errors.into_iter().map(f64::abs).collect();
    sizes.par_sort_unstable_by(f64::total_cmp);
    let quantile = |q: f64| sizes[((sizes.len() - 1) as f64 * q).round() as usize];
    LengthError { l2, max: quantile(1.0), median: quantile(0.5), p95: quantile(0.95) }
}

/// Root mean square of [`length_errors`], without the sorting that the other statistics take.
pub fn l2_length_error(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> f64 {
    root_mean_square(&length_errors(mesh, metric, positions))
}

fn root_mean_square(values: &[f64]) -> f64 {
    (inner_product(values, values, |a, b| a * b) / values.len() as f64).sqrt()
}
