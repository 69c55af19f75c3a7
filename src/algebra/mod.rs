//! Quaternions, 4×4-block sparse matrices and linear solvers; boxes that overlap.

pub mod quaternion;

mod block;
mod block_sparse;
mod cholesky;
mod complex;
mod conjugate_gradient;
mod incomplete_cholesky;
mod inner_product;
mod overlaps;
mod principal_axes;
mod strips;

pub use block::Block;
pub use block_sparse::{BlockMatrix, BlockVector, PairBlocks};
pub use cholesky::{BlockCholesky, CholeskyError, Entry, SparseCholesky};
pub use complex::Complex;
pub use conjugate_gradient::{ConjugateGradient, SolveReport};
pub use incomplete_cholesky::IncompleteCholesky;
pub use inner_product::inner_product;
pub use overlaps::{Box3, box_of, common, overlaps, share_a_vertex};
pub use principal_axes::{principal_axes, upright_sign};
pub use strips::BlockPattern;
