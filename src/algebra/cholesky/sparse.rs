//! Sparse Cholesky factorization, kept for many right-hand sides.
//!
//! Sums are formed in an order that the code says, product and sum are rounded one after the other, and so the bits are
//! those of any processor: wide registers (`pulp` asks for them) only do several rows at a time.

use super::error::CholeskyError;
use super::panels::{Panels, Vectors};
use super::supernodes::Supernodes;
use crate::algebra::Complex;
use glam::{DQuat, DVec3};
use std::marker::PhantomData;

/// What a matrix consists of: real or complex numbers, as planes of real ones.
pub trait Entry: Copy {
    /// 1 for real numbers, 2 for complex ones.
    const PLANES: usize;
    /// The real and the imaginary part.
    fn parts(self) -> [f64; 2];
}

impl Entry for f64 {
    const PLANES: usize = 1;
    fn parts(self) -> [f64; 2] {
        [self, 0.0]
    }
}

impl Entry for Complex {
    const PLANES: usize = 2;
    fn parts(self) -> [f64; 2] {
        [self.re, self.im]
    }
}

/// `L L*` of a positive definite sparse matrix, symmetric or Hermitian. The bits are the same on
/// every processor and any number of threads.
#[derive(Debug)]
pub struct SparseCholesky<T: Entry = f64> {
    supernodes: Supernodes,
    panels: Panels,
    entries: PhantomData<T>,
}

impl<T: Entry> SparseCholesky<T> {
    /// Factorizes the matrix whose lower triangle (diagonal included) is the sum of `(row, column, value)`.
    ///
    /// # Errors
    /// [`CholeskyError`] if the matrix is not positive definite.
    pub fn new(size: usize, lower: &[(usize, usize, T)]) -> Result<SparseCholesky<T>, CholeskyError> {
        let fail = |reason: String| CholeskyError::Factorization { size, reason };
        let supernodes = Supernodes::new(size, lower.iter().map(|&(row, column, _)| (row, column))).map_err(fail)?;
        let mut panels = Panels::zeros(&supernodes, T::PLANES);
        for &(row, column, value) in lower {
            let [row, column] = [row, column].map(|unknown| supernodes.row_of_unknown[unknown] as usize);
            let [re, im] = value.parts();
            // What the order of elimination moves above the diagonal stands below it as its conjugate.
            let im = if row < column { -im } else { im };
            if let Some(place) = supernodes.place(row.max(column), row.min(column)) {
                panels.add(place, [re, im]);
            }
        }
        panels.factorize(&supernodes).map_err(|row| fail(format!("pivot {row} is not positive")))?;
        Ok(SparseCholesky { supernodes, panels, entries: PhantomData })
    }

    fn solve_vectors<V: Copy>(&self, x: &mut [V], read: fn(V) -> [f64; 4], write: fn([f64; 4]) -> V) {
        let mut vectors: Vectors = vec![[0.0; 4]; x.len()];
        for (x, &row) in x.iter().zip(&self.supernodes.row_of_unknown) {
            vectors[row as usize] = read(*x);
        }
        self.panels.solve(&self.supernodes, &mut vectors);
        for (x, &row) in x.iter_mut().zip(&self.supernodes.row_of_unknown) {
            *x = write(vectors[row as usize]);
        }
    }
}

impl SparseCholesky<f64> {
    /// Solves for one 3-vector per unknown, in place.
    pub fn solve(&self, x: &mut [DVec3]) {
        self.solve_vectors(x, |v| [v.x, v.y, v.z, 0.0], |[x, y, z, _]| DVec3::new(x, y, z));
    }
}

impl SparseCholesky<Complex> {
    /// Solves for one quaternion a + b j per unknown, in place: complex matrices act from the left, on a and b alike.
    pub fn solve(&self, x: &mut [DQuat]) {
        self.solve_vectors(x, |q| [q.w, q.x, q.y, q.z], |[w, x, y, z]| DQuat::from_xyzw(x, y, z, w));
    }
}
