//! Levi-Civita and spin connection, spin structure, homology generators, class queries.

mod change_of_metric;
mod class;
mod error;
mod generators;
mod strip;
mod structure;

pub use change_of_metric::ChangeOfMetric;
pub use class::Class;
pub use error::SpinError;
pub use generators::{Generator, Homology, VertexTree};
pub use strip::Strip;
pub use structure::{SpinStructure, class_digits};
