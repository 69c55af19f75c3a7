//! Sparse Cholesky factorization of 3×3 blocks, whose order of elimination is kept while numbers change.

use super::error::CholeskyError;
use super::panels::{Panels, Vectors};
use super::supernodes::Supernodes;
use glam::{DMat3, DVec3};

/// `L Lᵀ` of a symmetric positive definite matrix that has a 3×3 block for every row and every coupled pair of rows.
/// Which rows are coupled is known once and for all; the numbers are given again and again. The bits are the
/// same on every processor and any number of threads.
#[derive(Debug)]
pub struct BlockCholesky {
    supernodes: Supernodes,
    panels: Panels,
    /// Per row: where its block is.
    diagonal: Vec<BlockPlace>,
    /// Per pair: where its block is.
    pairs: Vec<BlockPlace>,
}

/// Where a block is among the panels.
#[derive(Clone, Copy, Debug)]
struct BlockPlace {
    /// Of its first number.
    begin: usize,
    /// From one of its columns to the next.
    stride: usize,
    /// Whether the order of elimination has moved it above the diagonal, so that its transpose stands there.
    is_transposed: bool,
}

impl BlockCholesky {
    /// From the number of rows, and the pairs of different rows that are coupled, each once.
    ///
    /// # Errors
    /// [`CholeskyError`] if the columns cannot be ordered.
    pub fn new(rows: usize, pairs: &[(usize, usize)]) -> Result<BlockCholesky, CholeskyError> {
        let fail = |reason: String| CholeskyError::Factorization { size: 3 * rows, reason };
        let lower = pairs.iter().map(|&(a, b)| (a.max(b), a.min(b)));
        let blocks = Supernodes::new(rows, lower.chain((0..rows).map(|row| (row, row)))).map_err(fail)?;
        let supernodes = blocks.in_blocks_of(3);
        let place_of = |a: usize, b: usize| {
            let [row, column] = [a, b].map(|unknown| 3 * blocks.row_of_unknown[unknown] as usize);
            let (low, high) = (row.min(column), row.max(column));
            let begin = supernodes.place(high, low).ok_or_else(|| fail("a pair has no place in the factor".into()))?;
            let stride = supernodes.height(supernodes.of_row[low] as usize);
            Ok(BlockPlace { begin, stride, is_transposed: row < column })
        };
        let diagonal = (0..rows).map(|row| place_of(row, row)).collect::<Result<_, _>>()?;
        let pairs = pairs.iter().map(|&(a, b)| place_of(a, b)).collect::<Result<_, _>>()?;
        let panels = Panels::zeros(&supernodes, 1);
        Ok(BlockCholesky { supernodes, panels, diagonal, pairs })
    }

    /// Factorizes the matrix with these blocks, one per row and one per pair `(a, b)`, which stands in row a and column b.
    ///
    /// # Errors
    /// [`CholeskyError`] if the matrix is not positive definite; then there is nothing to solve with.
    pub fn factorize(&mut self, diagonal: &[DMat3], pairs: &[DMat3]) -> Result<(), CholeskyError> {
        self.panels.clear();
        let numbers = self.panels.real();
        let places = self.diagonal.iter().zip(diagonal).chain(self.pairs.iter().zip(pairs));
        for (place, block) in places {
            let block = if place.is_transposed { block.transpose() } else { *block };
            for (k, column) in block.to_cols_array_2d().into_iter().enumerate() {
                numbers[place.begin + k * place.stride..][..3].copy_from_slice(&column);
            }
        }
        let size = 3 * self.diagonal.len();
        let fail = |row| CholeskyError::Factorization { size, reason: format!("pivot {row} is not positive") };
        self.panels.factorize(&self.supernodes).map_err(fail)
    }

    /// Solves for one 3-vector per row, in place.
    pub fn solve(&self, x: &mut [DVec3]) {
        let mut vectors: Vectors = vec![[0.0; 4]; 3 * x.len()];
        let rows = || self.supernodes.row_of_unknown.iter().step_by(3).map(|row| *row as usize);
        for (x, row) in x.iter().zip(rows()) {
            x.to_array().into_iter().enumerate().for_each(|(k, x)| vectors[row + k][0] = x);
        }
        self.panels.solve(&self.supernodes, &mut vectors);
        for (x, row) in x.iter_mut().zip(rows()) {
            *x = DVec3::new(vectors[row][0], vectors[row + 1][0], vectors[row + 2][0]);
        }
    }
}
