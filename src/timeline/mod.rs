//! What changes with time: keyframes, formulas and named parameters.

mod clock;
mod error;
mod formula;
mod keyframes;
mod parameters;
mod point_formula;

pub use crate::scene::{Ease, Extrapolation};
pub use clock::Clock;
pub use error::TimelineError;
pub use formula::{Formula, FormulaAt};
pub use keyframes::{Keyframes, eased};
pub use parameters::{Number, Parameters};
pub use point_formula::{PointFormula, PointFormulaAt};
