//! What changes with time: keyframes, formulas and named parameters.

mod clock;
mod error;
mod formula;
mod keyframes;
mod operators;
mod parameters;
mod point_formula;

pub use clock::Clock;
pub use error::TimelineError;
pub use formula::{Formula, FormulaAt};
pub use keyframes::{Ease, Extrapolation, Keyframes, eased};
pub use parameters::{Number, Parameters};
pub use point_formula::{PointFormula, PointFormulaAt};
