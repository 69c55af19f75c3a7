//! Quaternions, 4×4-block sparse matrices and linear solvers.

pub mod quaternion;

mod complex;

pub use complex::Complex;
