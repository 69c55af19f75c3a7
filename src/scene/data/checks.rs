//! `[checks]`: what a film must satisfy.

use serde::{Deserialize, Serialize};

/// `[checks]`: of the last frame, and of all of them.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ChecksSection {
    /// Bound on the L2 relative length error.
    pub max_l2_length_error: Option<f64>,
    /// Bound on the number of rims.
    pub max_rims: Option<usize>,
    /// Bound on the number of pinch points.
    pub max_pinch_points: Option<usize>,
    /// The class that every frame must have.
    pub class: Option<String>,
    /// Bound on how far a conformal change of metric is from its target, in radians of curvature.
    pub max_curvature_error: Option<f64>,
    /// Bound on the mean distance to the mesh's own positions, relative to their diameter.
    pub max_mean_distance: Option<f64>,
    /// Bound on the distance of pinned vertices from where they belong.
    pub max_pin_distance: Option<f64>,
    /// Bound on the root mean square distance of bending angles from their targets, in degrees.
    pub rms_bending_error: Option<f64>,
    /// Bound on the largest such distance, in degrees.
    pub max_bending_error: Option<f64>,
    /// Bounds on all frames.
    pub film: FilmChecksSection,
}

/// `[checks.film]`: bounds on all frames.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct FilmChecksSection {
    /// Of the L2 relative length error on every frame.
    pub max_l2_length_error: Option<f64>,
    /// Of the L2 relative length error on the median frame.
    pub median_l2_length_error: Option<f64>,
    /// Of the number of rims on every frame.
    pub max_rims: Option<usize>,
    /// Of the number of frames that ran into the limit of steps before they settled.
    pub max_unconverged: Option<usize>,
    /// Of the largest move of a vertex from any frame to the next, in units of the median over the film of each
    /// frame's largest move.
    pub max_jump: Option<f64>,
    /// Whether it must be a regular homotopy from each frame to the next.
    pub regular_homotopy: Option<bool>,
}
