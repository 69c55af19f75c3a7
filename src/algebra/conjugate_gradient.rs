//! Preconditioned conjugate gradients on block matrices.

use super::block_sparse::BlockVector;
use super::incomplete_cholesky::StripFactor;
use super::strips::Strip;
use super::{Block, BlockMatrix, BlockPattern, IncompleteCholesky};
use rayon::prelude::*;

/// What a solve took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveReport {
    /// Pairs of triangular sweeps, each of which is a matrix product as well.
    pub iterations: usize,
    /// |b − A x| / |b|, recomputed from the result.
    pub residual: f64,
    /// Whether the tolerance was met.
    pub converged: bool,
    /// Pivots of the preconditioner that were not positive definite.
    pub replaced_pivots: usize,
}

impl SolveReport {
    /// Of a direct solve.
    pub const DIRECT: SolveReport = SolveReport { iterations: 0, residual: 0.0, converged: true, replaced_pivots: 0 };
}

/// Conjugate gradients with Eisenstat's trick; keeps its vectors between solves.
///
/// With the factorization `C (1 + L)(1 + Lᵀ) Cᵀ` of A it iterates on `(1 + L)⁻¹ C⁻¹ A C⁻ᵀ (1 + Lᵀ)⁻¹`. Since
/// C⁻¹ A C⁻ᵀ = (1 + L) + (1 + Lᵀ) + E with a block diagonal E that is known from L, `E_ii = Σ L_ik L_ikᵀ − 1` (or
/// just −1 where a pivot was replaced), a product is one sweep with each triangle, and L is all that it reads.
#[derive(Clone, Debug, Default)]
pub struct ConjugateGradient<B: Block> {
    strips: Vec<StripVectors<B>>,
    rest: BlockVector,
    trial: BlockVector,
}

#[derive(Clone, Debug, Default)]
struct StripVectors<B: Block> {
    /// Residual, of the system that is iterated on.
    residual: Vec<B::Vector>,
    direction: Vec<B::Vector>,
    /// t = (1 + Lᵀ)⁻¹ direction; before it is known, what later rows take from it.
    spread: Vec<B::Vector>,
    /// (1 + L)⁻¹ (direction + E t), so that the product is the sum of this and t.
    gathered: Vec<B::Vector>,
    /// Cᵀ x.
    solution: Vec<B::Vector>,
    /// What the strip adds to an inner product.
    sum: f64,
}

impl<B: Block> ConjugateGradient<B> {
    /// Solves A x = b, beginning at x = 0, until |b − A x| ≤ tolerance · |b|. Bits do not depend on the number of
    /// threads.
    ///
    /// The residual is recomputed before it is believed; where rounding has come between the recurrence and the
    /// truth, the solve begins again with what is left.
    #[allow(clippy::too_many_arguments)]
    pub fn solve(
        &mut self,
        pattern: &BlockPattern,
        matrix: &BlockMatrix<B>,
        factor: &IncompleteCholesky<B>,
        b: &BlockVector,
        x: &mut BlockVector,
        tolerance: f64,
        max_iterations: usize,
    ) -> SolveReport {
        let replaced_pivots = factor.replaced_pivots();
        let start = b.length();
        x.set(pattern, |_| glam::DVec4::ZERO);
        self.rest.copy_from(b);
        let goal = tolerance * start;
        let (mut norm, mut iterations) = (start, 0);
        while norm > goal && iterations < max_iterations {
            let cycle_start = norm;
            let first = self.begin(pattern, factor).sqrt();
            // Relative to the beginning of the cycle, in the norm of the system that is iterated on.
            let mut aim = (HOPE * goal / norm).max(B::ATTAINABLE);
            let (mut squared, mut beta) = (first * first, 0.0);
            loop {
                let curvature = self.sweep_back(pattern, factor, beta);
                let alpha = squared / curvature;
                let next = self.sweep_forward(pattern, factor, alpha);
                beta = next / squared;
                squared = next;
                iterations += 1;
                let reached = squared.sqrt() / first;
                let stuck = !(alpha.is_finite() && beta.is_finite());
                let over = stuck || iterations >= max_iterations;
                if reached <= aim || over {
                    self.try_solution(pattern, factor, x);
                    matrix.residual(pattern, b, &self.trial, &mut self.rest);
                    norm = self.rest.length();
                    if norm <= goal || reached <= B::ATTAINABLE || over {
                        break;
                    }
                    aim = (reached * CAUTION * (goal / norm)).max(B::ATTAINABLE);
                }
            }
            if norm.is_nan() || norm >= cycle_start {
                norm = cycle_start;
                break; // nothing was gained; x stays what it was
            }
            std::mem::swap(x, &mut self.trial);
            if norm > GAIN * cycle_start {
                break;
            }
        }
        let residual = if start > 0.0 { norm / start } else { 0.0 };
        // Nothing is to be had below the rounding error of the product itself.
        let converged = norm <= goal || norm <= matrix.rounding_error(x);
        SolveReport { iterations, residual, converged, replaced_pivots }
    }

    /// Residual (1 + L)⁻¹ C⁻¹ rest, direction and solution 0; the squared length of the residual.
    fn begin(&mut self, pattern: &BlockPattern, factor: &IncompleteCholesky<B>) -> f64 {
        let rest = &self.rest;
        self.strips.resize_with(pattern.strips.len(), StripVectors::default);
        let (even, odd) = self.strips.split_at_mut(pattern.even);
        let start = |number: usize, vectors: &mut StripVectors<B>, even: &[StripVectors<B>]| {
            let (strip, factor) = (&pattern.strips[number], &factor.strips[number]);
            vectors.begin(strip, factor, &rest.strips[number], even);
        };
        even.par_iter_mut().enumerate().for_each(|(k, vectors)| start(k, vectors, &[]));
        odd.par_iter_mut().enumerate().for_each(|(k, vectors)| start(pattern.even + k, vectors, even));
        self.sum()
    }

    /// New direction, residual + beta · direction, and its image under (1 + Lᵀ)⁻¹; the direction's product with that of
    /// the matrix.
    fn sweep_back(&mut self, pattern: &BlockPattern, factor: &IncompleteCholesky<B>, beta: f64) -> f64 {
        let (even, odd) = self.strips.split_at_mut(pattern.even);
        odd.par_iter_mut().enumerate().for_each(|(k, vectors)| {
            let number = pattern.even + k;
            vectors.sweep_back(&pattern.strips[number], &factor.strips[number], beta);
        });
        even.par_iter_mut().enumerate().for_each(|(k, vectors)| {
            let strip = &pattern.strips[k];
            for &(row, there, place, number) in &strip.mirrored {
                let block = &factor.strips[there as usize].seams[number as usize];
                let spread = odd[there as usize - pattern.even].spread[place as usize];
                vectors.spread[row as usize] += block.transpose_times(spread);
            }
            vectors.sweep_back(strip, &factor.strips[k], beta);
        });
        self.sum()
    }

    /// A step of length alpha along the direction; the squared length of the residual.
    fn sweep_forward(&mut self, pattern: &BlockPattern, factor: &IncompleteCholesky<B>, alpha: f64) -> f64 {
        let (even, odd) = self.strips.split_at_mut(pattern.even);
        even.par_iter_mut().enumerate().for_each(|(k, vectors)| {
            vectors.sweep_forward(&pattern.strips[k], &factor.strips[k], alpha, &[]);
        });
        odd.par_iter_mut().enumerate().for_each(|(k, vectors)| {
            let number = pattern.even + k;
            vectors.sweep_forward(&pattern.strips[number], &factor.strips[number], alpha, even);
        });
        self.sum()
    }

    /// x and what this cycle has found, as a trial.
    fn try_solution(&mut self, pattern: &BlockPattern, factor: &IncompleteCholesky<B>, x: &BlockVector) {
        let Self { strips, trial, .. } = self;
        trial.strips.resize_with(pattern.strips.len(), Vec::new);
        trial.strips.par_iter_mut().enumerate().for_each(|(k, trial)| {
            trial.clear();
            let rows = strips[k].solution.iter().zip(&factor.strips[k].inverse_root).zip(&x.strips[k]);
            trial.extend(rows.map(|((y, root), x)| *x + B::exact_vector(root.transpose_times(*y))));
        });
    }

    /// The sums of the strips, in their order.
    fn sum(&self) -> f64 {
        self.strips.iter().map(|vectors| vectors.sum).sum()
    }
}

impl<B: Block> StripVectors<B> {
    fn begin(&mut self, strip: &Strip, factor: &StripFactor<B>, rest: &[glam::DVec4], even: &[StripVectors<B>]) {
        let zero = B::Vector::default();
        for v in [&mut self.direction, &mut self.spread, &mut self.gathered, &mut self.solution] {
            v.clear();
            v.resize(strip.rows.len(), zero);
        }
        self.residual.clear();
        self.residual
            .extend(rest.iter().zip(&factor.inverse_root).map(|(rest, root)| root.times(B::round_vector(*rest))));
        for (seam, block) in strip.seams.iter().zip(&factor.seams) {
            let there = even[seam.strip as usize].residual[seam.column as usize];
            self.residual[seam.row as usize] -= block.times(there);
        }
        self.sum = 0.0;
        for row in 0..self.residual.len() {
            let mut r = self.residual[row];
            for link in strip.couplings(row) {
                r -= factor.inner[link].times(self.residual[strip.columns[link] as usize]);
            }
            self.residual[row] = r;
            self.sum += B::dot(r, r);
        }
    }

    /// Rows from last to first. The product of direction p and (1 + L)⁻¹ Â (1 + Lᵀ)⁻¹ p is t · (2 p + E t).
    fn sweep_back(&mut self, strip: &Strip, factor: &StripFactor<B>, beta: f64) {
        let Self { residual, direction, spread, sum, .. } = self;
        *sum = 0.0;
        for row in (0..strip.rows.len()).rev() {
            let p = residual[row] + B::scale(direction[row], beta);
            direction[row] = p;
            let t = p - spread[row];
            spread[row] = t;
            *sum += B::dot(t, (p + p) - t);
            let counts = !factor.replaced[row];
            for link in strip.couplings(row) {
                let w = factor.inner[link].transpose_times(t);
                spread[strip.columns[link] as usize] += w;
                if counts {
                    *sum += B::dot(w, w);
                }
            }
        }
        for (seam, block) in strip.seams.iter().zip(&factor.seams) {
            if !factor.replaced[seam.row as usize] {
                let w = block.transpose_times(spread[seam.row as usize]);
                *sum += B::dot(w, w);
            }
        }
    }

    /// Rows from first to last.
    fn sweep_forward(&mut self, strip: &Strip, factor: &StripFactor<B>, alpha: f64, even: &[StripVectors<B>]) {
        let Self { residual, direction, spread, gathered, solution, sum } = self;
        let w = |block: &B, row: usize, t: B::Vector| {
            if factor.replaced[row] { B::Vector::default() } else { block.transpose_times(t) }
        };
        let mut seams = strip.seams.iter().zip(&factor.seams).peekable();
        *sum = 0.0;
        for row in 0..strip.rows.len() {
            let t = spread[row];
            let mut s = direction[row] - t;
            while let Some((seam, block)) = seams.next_if(|(seam, _)| seam.row as usize == row) {
                s += block.times(w(block, row, t) - even[seam.strip as usize].gathered[seam.column as usize]);
            }
            for link in strip.couplings(row) {
                let block = &factor.inner[link];
                s += block.times(w(block, row, t) - gathered[strip.columns[link] as usize]);
            }
            gathered[row] = s;
            spread[row] = B::Vector::default();
            solution[row] += B::scale(t, alpha);
            let r = residual[row] - B::scale(t + s, alpha);
            residual[row] = r;
            *sum += B::dot(r, r);
        }
    }
}

/// What is looked at is the residual of the system that is iterated on; the true one is mostly this much ahead of it.
const HOPE: f64 = 1.3;
/// How far below the residual that seems to be needed the next attempt goes.
const CAUTION: f64 = 0.95;
/// A cycle that leaves more than this of the residual shows that there is no more to gain.
const GAIN: f64 = 0.5;
