//! Quaternions, 4×4-block sparse matrices and linear solvers.

pub mod quaternion;

mod block_sparse;
mod cholesky;
mod complex;
mod conjugate_gradient;
mod inner_product;

pub use block_sparse::{BlockMatrix, BlockPattern, IncompleteCholesky};
pub use cholesky::{CholeskyError, SparseCholesky};
pub use complex::Complex;
pub use conjugate_gradient::{ConjugateGradient, SolveReport};
pub use inner_product::inner_product;
