//! Linear systems of conformal scaling: the cotangent Laplacian, and what differs from it by little.

use super::triangulation::{Shape, Triangulation};
use crate::algebra::SparseCholesky;
use crate::metric::MetricError;
use glam::DVec3;

/// Most directions that [`solve_near_laplacian`] tries. Curvature in proportion to area needs about 20.
const MAX_DIRECTIONS: usize = 80;

/// The inverse of `L + D` on the free vertices, `L` the cotangent Laplacian and `D` a diagonal.
///
/// Where `L` alone would be singular (no vertex is held and `D` is zero) one vertex is held instead, right-hand
/// sides must add up to zero, and solutions are those of mean zero.
pub(super) struct LaplacianInverse {
    factor: SparseCholesky,
    /// Per vertex its unknown; `None` where it is held at zero.
    unknowns: Vec<Option<usize>>,
    singular: bool,
}

impl LaplacianInverse {
    /// `diagonal` has one entry per vertex.
    pub fn new(
        triangulation: &Triangulation,
        shape: &Shape,
        free: &[bool],
        diagonal: Option<&[f64]>,
    ) -> Result<LaplacianInverse, MetricError> {
        let singular = diagonal.is_none() && free.iter().all(|&free| free);
        let mut size = 0;
        let unknowns: Vec<Option<usize>> = free
            .iter()
            .enumerate()
            .map(|(v, &free)| {
                let held = !free || (singular && v == 0);
                size += usize::from(!held);
                (!held).then(|| size - 1)
            })
            .collect();
        let mut entries: Vec<(usize, usize, f64)> = triangulation
            .laplacian(shape)
            .into_iter()
            .filter_map(|(i, j, value)| Some((unknowns[i]?, unknowns[j]?, value)))
            .collect();
        if let Some(diagonal) = diagonal {
            entries.extend(unknowns.iter().zip(diagonal).filter_map(|(&k, &d)| k.map(|k| (k, k, d))));
        }
        let factor = SparseCholesky::new(size, &entries).map_err(MetricError::Linear)?;
        Ok(LaplacianInverse { factor, unknowns, singular })
    }

    pub fn apply(&self, b: &[f64]) -> Vec<f64> {
        let mut x: Vec<DVec3> =
            self.unknowns.iter().zip(b).filter(|(k, _)| k.is_some()).map(|(_, &b)| DVec3::new(b, 0.0, 0.0)).collect();
        self.factor.solve(&mut x);
        let mut x: Vec<f64> = self.unknowns.iter().map(|k| k.map_or(0.0, |k| x[k].x)).collect();
        if self.singular {
            let mean = x.iter().sum::<f64>() / x.len() as f64;
            x.iter_mut().for_each(|x| *x -= mean);
        }
        x
    }
}

/// Solves `A x = b` for an operator `A` near the Laplacian, by GMRES with its inverse on the right (Saad and
/// Schultz 1986), until the residual has shrunk to `tolerance`. Few directions are needed since `L⁻¹ A` is the
/// identity and something compact; `A` may be indefinite and unsymmetric.
pub(super) fn solve_near_laplacian(
    inverse: &LaplacianInverse,
    apply: impl Fn(&[f64]) -> Vec<f64>,
    b: &[f64],
    tolerance: f64,
) -> Vec<f64> {
    let start = norm(b);
    let mut x = vec![0.0; b.len()];
    if start == 0.0 {
        return x;
    }
    let mut basis: Vec<Vec<f64>> = vec![b.iter().map(|b| b / start).collect()];
    let mut images: Vec<Vec<f64>> = Vec::new();
    // The Hessenberg matrix, made triangular column by column with Givens rotations.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut rhs = vec![start];
    for k in 0..MAX_DIRECTIONS {
        let image = inverse.apply(&basis[k]);
        let mut next = apply(&image);
        images.push(image);
        let mut column = Vec::with_capacity(k + 2);
        for q in &basis {
            let along = dot(q, &next);
            next.iter_mut().zip(q).for_each(|(n, q)| *n -= along * q);
            column.push(along);
        }
        let length = norm(&next);
        for (i, &(c, s)) in rotations.iter().enumerate() {
            (column[i], column[i + 1]) = (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let pivot = libm::hypot(column[k], length);
        if pivot == 0.0 {
            images.pop();
            break;
        }
        let (c, s) = (column[k] / pivot, length / pivot);
        column[k] = pivot;
        rotations.push((c, s));
        rhs.push(-s * rhs[k]);
        rhs[k] *= c;
        columns.push(column);
        if rhs[k + 1].abs() <= tolerance * start || length == 0.0 {
            break;
        }
        basis.push(next.iter().map(|n| n / length).collect());
    }
    let mut coefficients = vec![0.0; columns.len()];
    for i in (0..columns.len()).rev() {
        let known: f64 = (i + 1..columns.len()).map(|j| columns[j][i] * coefficients[j]).sum();
        coefficients[i] = (rhs[i] - known) / columns[i][i];
    }
    for (image, c) in images.iter().zip(&coefficients) {
        x.iter_mut().zip(image).for_each(|(x, i)| *x += c * i);
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
