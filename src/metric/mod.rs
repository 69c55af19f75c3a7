//! Edge lengths and what they determine. Positions appear only as a source of lengths.

mod conformal;
mod error;
mod from_scene;
mod intrinsic;

pub use conformal::{
    BoundaryCondition, CURVATURE_TOLERANCE, Conformal, CurvatureTarget, GAUSS_BONNET_TOLERANCE, InteriorCurvature,
    Region, RicciFlow, uniformize,
};
pub use error::MetricError;
pub use from_scene::from_scene;
pub use intrinsic::{Metric, TRIANGLE_MARGIN, lengths_of_positions};
