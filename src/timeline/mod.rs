//! What changes with time: keyframes, formulas and named parameters.

mod clock;
mod error;
mod expression;
mod formula;
mod keyframes;
mod operators;
mod point_formula;

pub use clock::Clock;
pub use error::TimelineError;
pub use formula::{Formula, FormulaAt, LONGEST_FORMULA, MOST_PARAMETERS, Number, Parameters};
pub use keyframes::{Ease, Extrapolation, Keyframes, eased};
pub use point_formula::{PointFormula, PointFormulaAt};
