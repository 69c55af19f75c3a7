//! Sparse Cholesky factorization: an order of elimination, and dense panels of columns that are eliminated together.

mod block_cholesky;
mod dense;
mod elimination;
mod error;
mod factorize;
mod panels;
mod products;
mod sparse;
mod supernodes;

pub use block_cholesky::BlockCholesky;
pub use error::CholeskyError;
pub use sparse::{Entry, SparseCholesky};
