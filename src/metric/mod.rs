//! Edge lengths and what they determine. Positions appear only as a source of lengths.

mod conformal;
mod conformal_flips;
mod conformal_linear;
mod conformal_target;
#[cfg(test)]
mod conformal_tests;
mod conformal_triangulation;
mod error;
mod from_scene;
mod intrinsic;
mod ricci;

pub use conformal::{CURVATURE_TOLERANCE, Conformal, uniformize};
pub use conformal_target::{BoundaryCondition, CurvatureTarget, GAUSS_BONNET_TOLERANCE, InteriorCurvature};
pub use error::MetricError;
pub use from_scene::from_scene;
pub use intrinsic::{Metric, TRIANGLE_MARGIN, lengths_of_positions};
pub use ricci::RicciFlow;
