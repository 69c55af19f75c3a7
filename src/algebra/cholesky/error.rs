//! Matrices that cannot be factorized.

/// Why a matrix could not be factorized.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CholeskyError {
    /// A pivot was not positive, or memory ran out.
    #[error("the matrix of {size} unknowns cannot be factorized: {reason}")]
    Factorization {
        /// Number of unknowns.
        size: usize,
        /// What the factorization said.
        reason: String,
    },
}
