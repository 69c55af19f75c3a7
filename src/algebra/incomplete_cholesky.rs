//! Incomplete Cholesky factorization of block matrices.

use super::block_sparse::StripBlocks;
use super::strips::Strip;
use super::{Block, BlockMatrix, BlockPattern};
use glam::{DMat4, DVec4};
use rayon::prelude::*;

/// Block incomplete Cholesky factorization without fill, `A ≈ C (1 + L) (1 + Lᵀ) Cᵀ` with a block diagonal C, exact
/// on the pattern of a graph without cycles whose order of elimination needs no fill.
#[derive(Clone, Debug, Default)]
pub struct IncompleteCholesky<B: Block> {
    pub(super) strips: Vec<StripFactor<B>>,
}

/// The part of the factorization that belongs to the rows of a strip.
#[derive(Clone, Debug, Default)]
pub(super) struct StripFactor<B: Block> {
    /// C⁻¹, lower triangular blocks.
    pub inverse_root: Vec<B>,
    /// L, as the blocks of the matrix are stored.
    pub inner: Vec<B>,
    pub seams: Vec<B>,
    /// Whether the pivot was not positive definite and is the diagonal block itself.
    pub replaced: Vec<bool>,
}

impl<B: Block> IncompleteCholesky<B> {
    /// Factorizes; the result does not depend on the number of threads.
    pub fn factorize(&mut self, pattern: &BlockPattern, matrix: &BlockMatrix<B>) {
        self.strips.resize_with(pattern.strips.len(), StripFactor::default);
        let (even, odd) = self.strips.split_at_mut(pattern.even);
        let (even_strips, odd_strips) = pattern.strips.split_at(pattern.even);
        let (even_blocks, odd_blocks) = matrix.strips.split_at(pattern.even);
        even.par_iter_mut()
            .zip(even_strips)
            .zip(even_blocks)
            .for_each(|((factor, strip), blocks)| factor.factorize(strip, blocks, &[]));
        odd.par_iter_mut()
            .zip(odd_strips)
            .zip(odd_blocks)
            .for_each(|((factor, strip), blocks)| factor.factorize(strip, blocks, even));
    }

    /// Pivots that were not positive definite and were replaced by the diagonal block.
    pub fn replaced_pivots(&self) -> usize {
        self.strips.iter().flat_map(|strip| &strip.replaced).filter(|replaced| **replaced).count()
    }
}

impl<B: Block> StripFactor<B> {
    fn factorize(&mut self, strip: &Strip, blocks: &StripBlocks<B>, even: &[StripFactor<B>]) {
        let Self { inverse_root, inner, seams, replaced } = self;
        inverse_root.clear();
        inner.clear();
        seams.clear();
        replaced.clear();
        let mut seam = 0;
        for row in 0..strip.rows.len() {
            let mut pivot = blocks.diagonal[row];
            let (first_inner, first_seam) = (inner.len(), seams.len());
            let mut eliminate = |block: B, root: &B| {
                let scaled = block * root.transposed();
                pivot -= scaled * scaled.transposed();
                scaled
            };
            for link in strip.couplings(row) {
                inner.push(eliminate(blocks.inner[link], &inverse_root[strip.columns[link] as usize]));
            }
            while let Some(at) = strip.seams.get(seam).filter(|at| at.row as usize == row) {
                let there = &even[at.strip as usize].inverse_root[at.column as usize];
                seams.push(eliminate(blocks.seams[seam], there));
                seam += 1;
            }
            let diagonal = blocks.diagonal[row].exact();
            let root = inverse_root_of(pivot.exact(), &diagonal, B::LEAST_PIVOT);
            replaced.push(root.is_none());
            let root = root.or_else(|| inverse_root_of(diagonal, &diagonal, B::LEAST_PIVOT)).unwrap_or(DMat4::IDENTITY);
            let root = B::round(root);
            inner[first_inner..].iter_mut().chain(&mut seams[first_seam..]).for_each(|block| *block = root * *block);
            inverse_root.push(root);
        }
    }
}

/// C⁻¹ of `C Cᵀ = m`, if all pivots stay above rounding relative to the block they came from.
fn inverse_root_of(m: DMat4, scale: &DMat4, least: f64) -> Option<DMat4> {
    let floor = least * scale.x_axis.x.max(scale.y_axis.y).max(scale.z_axis.z).max(scale.w_axis.w);
    let mut rest = m;
    // Gauss–Jordan: the rows of the inverse of the root come out one by one.
    let mut inverse = DMat4::IDENTITY;
    for k in 0..4 {
        let column = rest.col(k);
        let pivot = column[k];
        if pivot.is_nan() || pivot <= floor {
            return None;
        }
        let reciprocal = 1.0 / pivot;
        let row = inverse.row(k);
        let mut below = column * reciprocal;
        (0..=k).for_each(|above| below[above] = 0.0);
        // rest −= below columnᵀ, inverse −= below rowᵀ, and the row itself is scaled in the end.
        rest -= outer(below, column);
        inverse -= outer(below, row);
        let scaled = row * reciprocal.sqrt();
        for column in 0..4 {
            inverse.col_mut(column)[k] = scaled[column];
        }
    }
    Some(inverse)
}

fn outer(a: DVec4, b: DVec4) -> DMat4 {
    DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
}
