//! Edge lengths and what they determine. Positions appear only as a source of lengths.

mod change;
mod conformal;
mod error;
mod intrinsic;
mod lengths;
mod program;
mod ricci_change;

pub use conformal::{
    BoundaryCondition, CURVATURE_TOLERANCE, Conformal, CurvatureTarget, GAUSS_BONNET_TOLERANCE, InteriorCurvature,
    Region, RicciFlow, uniformize,
};
pub use error::MetricError;
pub use intrinsic::{Metric, TRIANGLE_MARGIN, lengths_of_positions};
pub use program::{MetricAt, MetricProgram};
