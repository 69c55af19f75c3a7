//! Sparse Cholesky factorization, over faer, kept for many right-hand sides.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{LltRef, SymbolicCholesky, factorize_symbolic_cholesky};
use faer::sparse::{SparseColMat, Triplet};
use faer::traits::ComplexField;
use faer::{Conj, Mat, Par, Side, c64};
use glam::{DQuat, DVec3};

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

/// `L L*` of a positive definite sparse matrix, symmetric or Hermitian. Deterministic: everything runs on the calling
/// thread.
#[derive(Debug)]
pub struct SparseCholesky<T = f64> {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<T>,
}

impl<T: ComplexField> SparseCholesky<T> {
    /// Factorizes the matrix whose lower triangle (diagonal included) is the sum of `(row, column, value)`.
    ///
    /// # Errors
    /// [`CholeskyError`] if the matrix is not positive definite.
    pub fn new(size: usize, lower: &[(usize, usize, T)]) -> Result<SparseCholesky<T>, CholeskyError> {
        let fail = |reason: String| CholeskyError::Factorization { size, reason };
        let triplets: Vec<_> =
            lower.iter().map(|(row, col, val)| Triplet { row: *row, col: *col, val: val.clone() }).collect();
        let matrix = SparseColMat::<usize, T>::try_new_from_triplets(size, size, &triplets)
            .map_err(|error| fail(format!("{error:?}")))?;
        let symbolic =
            factorize_symbolic_cholesky(matrix.symbolic(), Side::Lower, Default::default(), Default::default())
                .map_err(|error| fail(format!("{error:?}")))?;
        let mut values = vec![T::zero_impl(); symbolic.len_val()];
        let scratch = symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, Default::default());
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

    fn solve_columns(&self, columns: &mut Mat<T>) {
        // faer's parallel triangular solve is slower than its sequential one on these matrices.
        let scratch = self.symbolic.solve_in_place_scratch::<T>(columns.ncols(), Par::Seq);
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            columns.as_mut(),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }
}

impl SparseCholesky<f64> {
    /// Solves for one 3-vector per unknown, in place.
    pub fn solve(&self, x: &mut [DVec3]) {
        let columns = |first: usize, count: usize| {
            let mut columns = Mat::from_fn(x.len(), count, |row, column| x[row][first + column]);
            self.solve_columns(&mut columns);
            columns
        };
        // On two processors.
        let (xy, z) = rayon::join(|| columns(0, 2), || columns(2, 1));
        for (row, x) in x.iter_mut().enumerate() {
            *x = DVec3::new(xy[(row, 0)], xy[(row, 1)], z[(row, 0)]);
        }
    }
}

impl SparseCholesky<c64> {
    /// Solves for one quaternion a + b j per unknown, in place: complex matrices act from the left, on a and b alike.
    pub fn solve(&self, x: &mut [DQuat]) {
        let column = |part: fn(&DQuat) -> c64| {
            let mut column = Mat::from_fn(x.len(), 1, |row, _| part(&x[row]));
            self.solve_columns(&mut column);
            column
        };
        // One processor each.
        let (a, b) = rayon::join(|| column(|q| c64::new(q.w, q.x)), || column(|q| c64::new(q.y, q.z)));
        for (row, x) in x.iter_mut().enumerate() {
            let (a, b) = (a[(row, 0)], b[(row, 0)]);
            *x = DQuat::from_xyzw(a.im, b.re, b.im, a.re);
        }
    }
}
