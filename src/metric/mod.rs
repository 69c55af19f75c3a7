//! Edge lengths and what they determine. Positions appear only as a source of lengths.

mod change;
mod conformal;
mod error;
mod intrinsic;
mod lengths;
mod program;
mod ricci_change;
mod shortest_paths;
mod triangle;

pub use change::Change;
pub use conformal::{
    BoundaryCondition, CURVATURE_TOLERANCE, Conformal, CurvatureTarget, GAUSS_BONNET_TOLERANCE, InteriorCurvature,
    Region, RicciFlow, uniformize,
};
pub use error::MetricError;
pub use intrinsic::{Metric, largest_strain, lengths_of_positions};
pub use lengths::Lengths;
pub use program::{Interpolation, MetricAt, MetricPart, MetricProgram, NoMetric};
pub use ricci_change::RicciTarget;
pub use shortest_paths::shortest_paths;
pub use triangle::TRIANGLE_MARGIN;
