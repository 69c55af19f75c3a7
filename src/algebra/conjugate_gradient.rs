//! Preconditioned conjugate gradients on block matrices.

use super::block_sparse::{BlockMatrix, BlockPattern, IncompleteCholesky};
use super::inner_product;
use glam::DVec4;

/// What a solve took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveReport {
    /// Matrix products.
    pub iterations: usize,
    /// |b − A x| / |b − A x₀|, recomputed from the result.
    pub residual: f64,
    /// Whether the tolerance was met.
    pub converged: bool,
}

impl SolveReport {
    /// Of a direct solve.
    pub const DIRECT: SolveReport = SolveReport { iterations: 0, residual: 0.0, converged: true };
}

/// Vectors of a solve, kept between solves.
#[derive(Clone, Debug, Default)]
pub struct ConjugateGradient {
    preconditioner: IncompleteCholesky,
    residual: Vec<DVec4>,
    preconditioned: Vec<DVec4>,
    direction: Vec<DVec4>,
    product: Vec<DVec4>,
}

impl ConjugateGradient {
    /// Improves `x` until the residual has shrunk to `tolerance` times the one of the given `x`.
    pub fn solve(
        &mut self,
        pattern: &BlockPattern,
        a: &BlockMatrix,
        b: &[DVec4],
        x: &mut [DVec4],
        tolerance: f64,
        max_iterations: usize,
    ) -> SolveReport {
        let n = b.len();
        for v in [&mut self.residual, &mut self.preconditioned, &mut self.direction, &mut self.product] {
            v.resize(n, DVec4::ZERO);
        }
        self.preconditioner.factorize(pattern, a);
        let Self { preconditioner, residual: r, preconditioned: z, direction: p, product: q } = self;

        a.multiply(pattern, x, q);
        for k in 0..n {
            r[k] = b[k] - q[k];
        }
        let start = dot(r, r).sqrt();
        // Nothing to gain below the rounding error of b itself.
        let goal = (tolerance * start).max(4.0 * f64::EPSILON * dot(b, b).sqrt());
        let mut iterations = 0;
        let mut norm = start;
        let mut rz = 0.0;
        while norm > goal && iterations < max_iterations {
            preconditioner.solve(pattern, a, r, z);
            let rz_new = dot(r, z);
            let beta = if iterations == 0 { 0.0 } else { rz_new / rz };
            rz = rz_new;
            for k in 0..n {
                p[k] = z[k] + beta * p[k];
            }
            a.multiply(pattern, p, q);
            let alpha = rz / dot(p, q);
            for k in 0..n {
                x[k] += alpha * p[k];
                r[k] -= alpha * q[k];
            }
            norm = dot(r, r).sqrt();
            iterations += 1;
        }
        a.multiply(pattern, x, q);
        for k in 0..n {
            r[k] = b[k] - q[k];
        }
        let end = dot(r, r).sqrt();
        let residual = if start > 0.0 { end / start } else { 0.0 };
        SolveReport { iterations, residual, converged: end <= 2.0 * goal }
    }
}

fn dot(a: &[DVec4], b: &[DVec4]) -> f64 {
    inner_product(a, b, DVec4::dot)
}
