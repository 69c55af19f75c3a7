//! The logarithm of the scale between two metrics.

use crate::algebra::{CholeskyError, SparseCholesky};
use crate::mesh::{Mesh, VertexId};
use glam::DVec3;

/// Finds, for lengths ℓ on a mesh, the u per vertex with `(u_a + u_b)/2 = ln(ℓ/ℓ₀)` on its edges, in the sense of least
/// squares; metrics that are discretely conformal to ℓ₀ have exactly such a u. Factorized once for all ℓ.
#[derive(Debug)]
pub struct ConformalFactor {
    first: Vec<f64>,
    matrix: SparseCholesky,
}

impl ConformalFactor {
    /// Against the lengths `first`, |E|, all positive.
    ///
    /// # Errors
    /// [`CholeskyError`] if memory runs out: the matrix, degrees plus adjacency, is positive definite on triangles.
    pub fn new(mesh: &Mesh, first: Vec<f64>) -> Result<ConformalFactor, CholeskyError> {
        let mut entries: Vec<(usize, usize, f64)> = Vec::with_capacity(3 * mesh.edge_count());
        for e in mesh.edges() {
            let [a, b] = mesh.edge_vertices(e).map(VertexId::index);
            entries.extend([(a, a, 1.0), (b, b, 1.0), (a.max(b), a.min(b), 1.0)]);
        }
        Ok(ConformalFactor { first, matrix: SparseCholesky::new(mesh.vertex_count(), &entries)? })
    }

    /// u of the lengths, |V|.
    pub fn of(&self, mesh: &Mesh, lengths: &[f64]) -> Vec<f64> {
        let mut solution = vec![DVec3::ZERO; mesh.vertex_count()];
        for (e, (length, first)) in mesh.edges().zip(lengths.iter().zip(&self.first)) {
            let twice = 2.0 * libm::log(length / first);
            mesh.edge_vertices(e).into_iter().for_each(|v| solution[v.index()].x += twice);
        }
        self.matrix.solve(&mut solution);
        solution.into_iter().map(|u| u.x).collect()
    }
}
