//! What keeps closed edge vectors from being exact (App. D.2).

use super::crossings::crossings;
use super::poisson::Poisson;
use crate::mesh::Mesh;
use crate::metric::Metric;
use crate::spin::Homology;
use glam::DVec3;

/// Harmonic 1-forms: closed, and orthogonal to all differentials of functions. What v̂ has of them are its periods,
/// the displacements by which the surface fails to close up along generators.
#[derive(Clone, Debug)]
pub struct Periods {
    /// Orthonormal with respect to the primal weights; β₁ forms of |E| values.
    basis: Vec<Vec<f64>>,
}

impl Periods {
    /// One Poisson solve for every three generators.
    pub fn new(mesh: &Mesh, metric: &Metric, homology: &Homology, poisson: &Poisson) -> Periods {
        let closed: Vec<Vec<f64>> = homology.generators().iter().map(|g| crossings(mesh, &g.path)).collect();
        let mut basis: Vec<Vec<f64>> = Vec::with_capacity(closed.len());
        for group in closed.chunks(3) {
            let value = |e: usize, k: usize| group.get(k).map_or(0.0, |form| form[e]);
            let vectors: Vec<DVec3> =
                (0..mesh.edge_count()).map(|e| DVec3::new(value(e, 0), value(e, 1), value(e, 2))).collect();
            let rest = poisson.remove_exact_part(mesh, metric, &vectors);
            for k in 0..group.len() {
                let mut form: Vec<f64> = rest.iter().map(|v| v[k]).collect();
                // Twice, for orthogonality to rounding.
                for _ in 0..2 {
                    for other in &basis {
                        let c = inner(mesh, metric, other, &form);
                        form.iter_mut().zip(other).for_each(|(f, o)| *f -= c * o);
                    }
                }
                let norm = inner(mesh, metric, &form, &form).sqrt();
                form.iter_mut().for_each(|f| *f /= norm);
                basis.push(form);
            }
        }
        Periods { basis }
    }

    /// Whether there are any: not on spheres and disks.
    pub fn is_empty(&self) -> bool {
        self.basis.is_empty()
    }

    /// The harmonic part of edge vectors: what keeps them from being exact though closed.
    pub fn harmonic_part(&self, mesh: &Mesh, metric: &Metric, vectors: &[DVec3]) -> Vec<DVec3> {
        let mut part = vec![DVec3::ZERO; vectors.len()];
        for form in &self.basis {
            let c: DVec3 = mesh.edges().map(|e| metric.primal_weight(e) * form[e.index()] * vectors[e.index()]).sum();
            part.iter_mut().zip(form).for_each(|(p, f)| *p += c * *f);
        }
        part
    }

    /// Norm of the harmonic part relative to the norm of the edge lengths; 0 when all periods vanish.
    pub fn relative_error(&self, mesh: &Mesh, metric: &Metric, vectors: &[DVec3]) -> f64 {
        let [error, scale] = self.squared_norms(mesh, metric, vectors);
        (error / scale).sqrt()
    }

    /// Squared norms of the harmonic part and of the edge lengths.
    pub fn squared_norms(&self, mesh: &Mesh, metric: &Metric, vectors: &[DVec3]) -> [f64; 2] {
        let part = self.harmonic_part(mesh, metric, vectors);
        let weighted = |e| metric.primal_weight(e);
        let error: f64 = mesh.edges().map(|e| weighted(e) * part[e.index()].length_squared()).sum();
        let scale: f64 = mesh.edges().map(|e| weighted(e) * metric.length(e).powi(2)).sum();
        [error, scale]
    }
}

fn inner(mesh: &Mesh, metric: &Metric, a: &[f64], b: &[f64]) -> f64 {
    mesh.edges().map(|e| metric.primal_weight(e) * a[e.index()] * b[e.index()]).sum()
}
