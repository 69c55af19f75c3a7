//! From an almost immersion to an isometric one: vertices move until edges have their lengths.
//!
//! Frames leave a surface with length errors of some tenths of a percent, because a frame per face is less than what three
//! coordinates per vertex can do. Polish minimizes over positions what a thin shell costs,
//!
//! Σ (|f_e|/ℓ_e − 1)² / 2 + κ Σ w_e (α_e − α̊_e)² / 2 + κ Σ w_e b(α_e)
//!
//! with the strain of all edges, bending angles α away from those at rest, and a barrier b that no hinge passes, at 180° either
//! way. Newton steps are taken while κ fades: a stiff shell is smooth and stretched, and as it gets softer it follows the
//! lengths with as little bending as they ask for. Faces cannot collapse and hinges cannot fold over, because steps that come
//! near to either are shortened. So the surface moves by a regular homotopy, and its class stays. Where this ends short of the
//! lengths, patches that hold the error may be searched for better fits.

mod apply;
mod barrier;
mod descent;
mod energy;
mod hinge;
mod local_search;
mod newton;
mod pass;
mod report;
mod settings;
#[cfg(test)]
mod tests;

pub use pass::{Exchange, Motion, NoSymmetry, Pass, PassError};
pub use report::{Ending, PolishReport, mean_bending};
pub use settings::{Polish, PolishStep, Polished, Watch};
