//! Discrete conformal scaling: metrics of prescribed curvature, and the Ricci flow that leads to them (Eq. 22).

mod flips;
mod linear;
mod ricci;
mod target;
#[cfg(test)]
mod tests;
mod triangulation;
mod uniformize;

pub use ricci::RicciFlow;
pub use target::{BoundaryCondition, CurvatureTarget, GAUSS_BONNET_TOLERANCE, InteriorCurvature, Region};
pub use uniformize::{CURVATURE_TOLERANCE, Conformal, uniformize};
