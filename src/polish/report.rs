//! What polish did to a surface.

use crate::algebra::inner_product;
use crate::immersion::{bending_angles, length_error};
use crate::mesh::Mesh;
use crate::metric::Metric;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// What polish did to a surface, and why it ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PolishReport {
    /// L2 length error of the surface that frames integrate to.
    pub l2_length_error_before: f64,
    /// Largest length error of that surface.
    pub max_length_error_before: f64,
    /// L2 length error of the polished surface.
    pub l2_length_error: f64,
    /// Mean absolute bending angle before, in degrees.
    pub mean_bending_before: f64,
    /// Mean absolute bending angle after, in degrees.
    pub mean_bending: f64,
    /// Newton steps that were taken.
    pub steps: usize,
    /// Why it ended.
    pub ending: Ending,
}

impl PolishReport {
    /// Of a surface that is left as it is.
    pub fn unchanged(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> PolishReport {
        let error = length_error(mesh, metric, positions);
        let bending = mean_bending(mesh, positions).to_degrees();
        PolishReport {
            l2_length_error_before: error.l2,
            max_length_error_before: error.max,
            l2_length_error: error.l2,
            mean_bending_before: bending,
            mean_bending: bending,
            steps: 0,
            ending: Ending::Unchanged,
        }
    }
}

/// The mean absolute bending angle over inner edges, in radians.
pub fn mean_bending(mesh: &Mesh, positions: &[DVec3]) -> f64 {
    let angles = bending_angles(mesh, positions);
    let hinges = mesh.edges().filter(|e| !mesh.is_boundary_edge(*e)).count().max(1);
    inner_product(&angles, &angles, |a, _| a.abs()) / hinges as f64
}

/// Why polish ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// All edges have their lengths up to rounding.
    Isometric,
    /// No step makes the lengths better: this is the best fit nearby.
    BestFit,
    /// A better fit would bend the surface by more than it may.
    BendingLimit,
    /// It was to take no more steps.
    StepLimit,
    /// The surface was left as it was: it is pinched, or polish would have changed its class or made it worse.
    Unchanged,
}
