//! Symmetric sparse matrices of 4×4 blocks on a graph of small degree (the faces of a mesh).

use super::strips::Pair;
use super::{Block, BlockPattern};
use glam::DVec4;
use rayon::prelude::*;

/// Rows whose pairs are loaded at a time.
const RUN: usize = 32;

/// A symmetric block matrix, stored by the strips of its pattern.
#[derive(Clone, Debug, Default)]
pub struct BlockMatrix<B: Block> {
    pub(super) strips: Vec<StripBlocks<B>>,
}

/// The blocks of a strip: (row, row), and (row, earlier row) in the order of the pattern.
#[derive(Clone, Debug, Default)]
pub(super) struct StripBlocks<B: Block> {
    pub diagonal: Vec<B>,
    pub inner: Vec<B>,
    pub seams: Vec<B>,
}

/// What a pair of coupled rows adds to a matrix.
#[derive(Clone, Copy, Debug)]
pub struct PairBlocks<B> {
    /// To the diagonal block of the first row.
    pub first: B,
    /// To the diagonal block of the second row.
    pub second: B,
    /// The block (first, second); (second, first) is its transpose.
    pub across: B,
}

impl<B: Block> BlockMatrix<B> {
    /// The sum of a diagonal block per row and of what every pair of the pattern adds. At the same time a vector is
    /// gathered, which has one part per row and one at either end of every pair.
    ///
    /// What a pair needs is loaded first, for many pairs at a time: pairs come in the order of elimination, so it is
    /// scattered over memory, and loads wait for memory side by side only if little is done between them.
    pub fn assemble<Data>(
        &mut self,
        pattern: &BlockPattern,
        vector: &mut BlockVector,
        row: impl Fn(usize) -> (B, DVec4) + Sync,
        load: impl Fn(usize) -> Data + Sync,
        pair: impl Fn(&Data) -> (PairBlocks<B>, [DVec4; 2]) + Sync,
    ) {
        self.strips.resize_with(pattern.strips.len(), StripBlocks::default);
        vector.strips.resize_with(pattern.strips.len(), Vec::new);
        let strips = self.strips.par_iter_mut().zip(&mut vector.strips).zip(&pattern.strips);
        strips.for_each(|((blocks, vector), strip)| {
            let StripBlocks { diagonal, inner, seams } = blocks;
            diagonal.clear();
            inner.clear();
            seams.clear();
            vector.clear();
            for here in &strip.rows {
                let (block, part) = row(*here as usize);
                diagonal.push(block);
                vector.push(part);
            }
            // The later row first.
            let ends = |data: &Data, of: Pair| {
                let (blocks, [first, second]) = pair(data);
                if of.first_is_later {
                    ([blocks.first, blocks.second], blocks.across, [first, second])
                } else {
                    ([blocks.second, blocks.first], blocks.across.transposed(), [second, first])
                }
            };
            let mut loaded = Vec::new();
            for start in (0..strip.rows.len()).step_by(RUN) {
                let end = (start + RUN).min(strip.rows.len());
                let first = strip.starts[start] as usize;
                let run = &strip.pairs[first..strip.starts[end] as usize];
                loaded.clear();
                loaded.extend(run.iter().map(|pair| load(pair.index as usize)));
                for row in start..end {
                    for link in strip.couplings(row) {
                        let column = strip.columns[link] as usize;
                        let (at, across, parts) = ends(&loaded[link - first], strip.pairs[link]);
                        diagonal[row] += at[0];
                        diagonal[column] += at[1];
                        vector[row] += parts[0];
                        vector[column] += parts[1];
                        inner.push(across);
                    }
                }
            }
            // Pairs at a seam are made twice, once for each side.
            for seam in &strip.seams {
                let (at, across, parts) = ends(&load(seam.pair.index as usize), seam.pair);
                diagonal[seam.row as usize] += at[0];
                vector[seam.row as usize] += parts[0];
                seams.push(across);
            }
            for &(row, odd, _, number) in &strip.mirrored {
                let pair = pattern.strips[odd as usize].seams[number as usize].pair;
                let (at, _, parts) = ends(&load(pair.index as usize), pair);
                diagonal[row as usize] += at[1];
                vector[row as usize] += parts[1];
            }
        });
    }

    /// Replaces every block, those of the diagonal and the others.
    pub fn transform(&mut self, diagonal: impl Fn(B) -> B + Sync, across: impl Fn(B) -> B + Sync) {
        self.strips.par_iter_mut().for_each(|blocks| {
            blocks.diagonal.iter_mut().for_each(|block| *block = diagonal(*block));
            blocks.inner.iter_mut().chain(&mut blocks.seams).for_each(|block| *block = across(*block));
        });
    }

    /// About the length of the error that rounding makes in `A x`.
    pub fn rounding_error(&self, x: &BlockVector) -> f64 {
        let of_row = |(block, x): (&B, &DVec4)| {
            let block = block.exact();
            let largest = block.x_axis.x.max(block.y_axis.y).max(block.z_axis.z).max(block.w_axis.w);
            largest * largest * x.length_squared()
        };
        let strips = self.strips.iter().zip(&x.strips);
        let squared: f64 = strips.flat_map(|(blocks, x)| blocks.diagonal.iter().zip(x).map(of_row)).sum();
        2.0 * B::EPSILON * squared.sqrt()
    }

    /// `b − A x` into `out`.
    pub fn residual(&self, pattern: &BlockPattern, b: &BlockVector, x: &BlockVector, out: &mut BlockVector) {
        out.strips.resize_with(pattern.strips.len(), Vec::new);
        out.strips.par_iter_mut().enumerate().for_each(|(k, out)| {
            let (strip, blocks, x_here) = (&pattern.strips[k], &self.strips[k], &x.strips[k]);
            let vector = |x: DVec4| B::round_vector(x);
            out.clear();
            for ((b, x), block) in b.strips[k].iter().zip(x_here).zip(&blocks.diagonal) {
                out.push(*b - B::exact_vector(block.times(vector(*x))));
            }
            for row in 0..out.len() {
                let x = vector(x_here[row]);
                let mut sum = B::Vector::default();
                for link in strip.couplings(row) {
                    let (column, block) = (strip.columns[link] as usize, &blocks.inner[link]);
                    sum += block.times(vector(x_here[column]));
                    out[column] -= B::exact_vector(block.transpose_times(x));
                }
                out[row] -= B::exact_vector(sum);
            }
            for (seam, block) in strip.seams.iter().zip(&blocks.seams) {
                let x = vector(x.strips[seam.strip as usize][seam.column as usize]);
                out[seam.row as usize] -= B::exact_vector(block.times(x));
            }
            for &(row, odd, there, number) in &strip.mirrored {
                let block = &self.strips[odd as usize].seams[number as usize];
                let x = vector(x.strips[odd as usize][there as usize]);
                out[row as usize] -= B::exact_vector(block.transpose_times(x));
            }
        });
    }
}

/// A vector of four numbers per row, by the strips of a pattern.
#[derive(Clone, Debug, Default)]
pub struct BlockVector {
    pub(super) strips: Vec<Vec<DVec4>>,
}

impl BlockVector {
    /// From its value at each row.
    pub fn set(&mut self, pattern: &BlockPattern, value: impl Fn(usize) -> DVec4 + Sync) {
        self.strips.resize_with(pattern.strips.len(), Vec::new);
        self.strips.par_iter_mut().zip(&pattern.strips).for_each(|(values, strip)| {
            values.clear();
            values.extend(strip.rows.iter().map(|row| value(*row as usize)));
        });
    }

    /// From another vector.
    pub(super) fn copy_from(&mut self, other: &BlockVector) {
        self.strips.resize_with(other.strips.len(), Vec::new);
        self.strips.par_iter_mut().zip(&other.strips).for_each(|(values, other)| values.clone_from(other));
    }

    /// The value at a row.
    #[inline]
    pub fn at(&self, pattern: &BlockPattern, row: usize) -> DVec4 {
        let (strip, place) = pattern.places[row];
        self.strips[strip as usize][place as usize]
    }

    /// Euclidean length, summed strip by strip.
    pub fn length(&self) -> f64 {
        let of_strip = |values: &Vec<DVec4>| values.iter().map(|v| v.length_squared()).sum::<f64>();
        let mut sums = Vec::with_capacity(self.strips.len());
        self.strips.par_iter().map(of_strip).collect_into_vec(&mut sums);
        sums.iter().sum::<f64>().sqrt()
    }
}
