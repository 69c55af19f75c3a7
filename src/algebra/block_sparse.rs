//! Symmetric sparse matrices of 4×4 blocks on a graph of small degree (the faces of a mesh).

use glam::{DMat4, DVec4};
use rayon::prelude::*;

/// Rows that one task takes.
const CHUNK: usize = 4096;

/// The graph: which block rows are coupled by which edge. Shared by all matrices on one mesh.
#[derive(Clone, Debug)]
pub struct BlockPattern {
    /// Per row: up to three (column, index of the off-diagonal block, whether to transpose it).
    rows: Vec<Vec3Links>,
}

type Vec3Links = [Option<Link>; 3];

#[derive(Clone, Copy, Debug)]
struct Link {
    column: u32,
    block: u32,
    transposed: bool,
}

impl BlockPattern {
    /// From pairs (row, column) of the off-diagonal blocks; every row may occur in at most three pairs.
    pub fn new(rows: usize, pairs: impl Iterator<Item = (usize, usize)>) -> BlockPattern {
        let mut pattern = vec![[None; 3]; rows];
        let mut add = |row: usize, column: usize, block: usize, transposed: bool| {
            let free = pattern[row].iter_mut().find(|slot| slot.is_none());
            debug_assert!(free.is_some(), "a row has more than three neighbours");
            if let Some(slot) = free {
                *slot = Some(Link { column: column as u32, block: block as u32, transposed });
            }
        };
        for (block, (row, column)) in pairs.enumerate() {
            add(row, column, block, false);
            add(column, row, block, true);
        }
        BlockPattern { rows: pattern }
    }
}

/// A symmetric block matrix: `diagonal[i]`, and `off_diagonal[b]` at the b-th pair of its pattern.
#[derive(Clone, Debug, Default)]
pub struct BlockMatrix {
    /// Diagonal blocks, symmetric.
    pub diagonal: Vec<DMat4>,
    /// Off-diagonal blocks (row, column) in the order of the pattern's pairs; (column, row) is the transpose.
    pub off_diagonal: Vec<DMat4>,
}

impl BlockMatrix {
    /// `A x` into `out`.
    pub fn multiply(&self, pattern: &BlockPattern, x: &[DVec4], out: &mut [DVec4]) {
        out.par_chunks_mut(CHUNK).enumerate().for_each(|(c, out)| {
            for (k, out) in out.iter_mut().enumerate() {
                let row = c * CHUNK + k;
                *out = self.diagonal[row] * x[row] + self.coupled(pattern, row, x, |_| true);
            }
        });
    }

    #[inline]
    fn coupled(&self, pattern: &BlockPattern, row: usize, x: &[DVec4], take: impl Fn(usize) -> bool) -> DVec4 {
        let mut sum = DVec4::ZERO;
        for link in pattern.rows[row].iter().flatten() {
            let column = link.column as usize;
            if take(column) {
                let block = &self.off_diagonal[link.block as usize];
                sum += if link.transposed { transpose_times(block, x[column]) } else { *block * x[column] };
            }
        }
        sum
    }
}

#[inline]
fn transpose_times(m: &DMat4, v: DVec4) -> DVec4 {
    DVec4::new(m.x_axis.dot(v), m.y_axis.dot(v), m.z_axis.dot(v), m.w_axis.dot(v))
}

/// Block incomplete Cholesky factorization without fill, `(D + L) D⁻¹ (D + Lᵀ)`, exact on the pattern of
/// a graph without triangles.
#[derive(Clone, Debug, Default)]
pub struct IncompleteCholesky {
    inverse_pivots: Vec<DMat4>,
    /// Pivots that were not positive definite and were replaced by the diagonal block.
    pub replaced_pivots: usize,
}

impl IncompleteCholesky {
    /// Factorizes in row order; the result does not depend on the number of threads.
    pub fn factorize(&mut self, pattern: &BlockPattern, matrix: &BlockMatrix) {
        self.inverse_pivots.clear();
        self.replaced_pivots = 0;
        for (row, links) in pattern.rows.iter().enumerate() {
            let mut pivot = matrix.diagonal[row];
            for link in links.iter().flatten().filter(|link| (link.column as usize) < row) {
                let block = matrix.off_diagonal[link.block as usize];
                let here = if link.transposed { block.transpose() } else { block };
                pivot -= here * self.inverse_pivots[link.column as usize] * here.transpose();
            }
            if !is_positive_definite(&pivot, &matrix.diagonal[row]) {
                self.replaced_pivots += 1;
                pivot = matrix.diagonal[row];
            }
            self.inverse_pivots.push(pivot.inverse());
        }
    }

    /// Solves with the factorization.
    pub fn solve(&self, pattern: &BlockPattern, matrix: &BlockMatrix, r: &[DVec4], z: &mut [DVec4]) {
        for row in 0..r.len() {
            let rest = r[row] - matrix.coupled(pattern, row, z, |column| column < row);
            z[row] = self.inverse_pivots[row] * rest;
        }
        for row in (0..r.len()).rev() {
            let correction = matrix.coupled(pattern, row, z, |column| column > row);
            z[row] -= self.inverse_pivots[row] * correction;
        }
    }
}

/// Whether Cholesky's pivots stay above rounding relative to the block they came from.
fn is_positive_definite(m: &DMat4, scale: &DMat4) -> bool {
    let floor = 1e-12 * scale.x_axis.x.max(scale.y_axis.y).max(scale.z_axis.z).max(scale.w_axis.w);
    let mut rest = *m;
    (0..4).all(|k| {
        let column = rest.col(k);
        let pivot = column[k];
        rest -= DMat4::from_cols(column * column.x, column * column.y, column * column.z, column * column.w)
            * (1.0 / pivot);
        pivot > floor
    })
}
