//! Sparse Cholesky factorization, over faer, kept for many right-hand sides.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{LltRef, SymbolicCholesky, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, Mat, Par, Side};
use glam::DVec3;

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

/// `L Lᵀ` of a symmetric positive definite sparse matrix. Deterministic: everything runs on the calling thread.
#[derive(Debug)]
pub struct SparseCholesky {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
}

impl SparseCholesky {
    /// Factorizes the matrix whose lower triangle (diagonal included) is the sum of `(row, column, value)`.
    ///
    /// # Errors
    /// [`CholeskyError`] if the matrix is not positive definite.
    pub fn new(size: usize, lower: &[(usize, usize, f64)]) -> Result<SparseCholesky, CholeskyError> {
        let fail = |reason: String| CholeskyError::Factorization { size, reason };
        let triplets: Vec<_> = lower.iter().map(|&(row, col, val)| Triplet { row, col, val }).collect();
        let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(size, size, &triplets)
            .map_err(|error| fail(format!("{error:?}")))?;
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, Default::default(), Default::default())
                .map_err(|error| fail(format!("{error:?}")))?;
        let mut values = vec![0.0; symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix.as_ref(),
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            )
            .map_err(|error| fail(format!("{error:?}")))?;
        Ok(SparseCholesky { symbolic, values })
    }

    /// Solves for one 3-vector per unknown, in place.
    pub fn solve(&self, x: &mut [DVec3]) {
        let mut rhs = Mat::from_fn(x.len(), 3, |row, column| x[row][column]);
        // faer's parallel triangular solve is slower than its sequential one on these matrices.
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(3, Par::Seq);
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            rhs.as_mut(),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
        for (row, x) in x.iter_mut().enumerate() {
            *x = DVec3::new(rhs[(row, 0)], rhs[(row, 1)], rhs[(row, 2)]);
        }
    }
}
