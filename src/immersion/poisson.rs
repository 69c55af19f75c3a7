//! Vertex positions from edge vectors: the Poisson problem (Eq. 42, Alg. 7), with pins.

use crate::algebra::{CholeskyError, SparseCholesky};
use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use glam::DVec3;

/// The factorized Laplacian `dᵀ ⋆ d` of a metric. Factorized once per metric.
#[derive(Debug)]
pub struct Poisson {
    factor: Option<SparseCholesky>,
    /// Per vertex: its unknown, or `None` where its position is given.
    unknowns: Vec<Option<usize>>,
    /// Per component without pins: its vertices, to be centered.
    floating: Vec<Vec<VertexId>>,
}

impl Poisson {
    /// `pinned` vertices keep given positions; a component without any is fixed at one vertex for the solve
    /// and then centered at the origin.
    ///
    /// # Errors
    /// [`CholeskyError`] if the weights are so uneven that the factorization breaks down.
    pub fn new(mesh: &Mesh, metric: &Metric, pinned: &[VertexId]) -> Result<Poisson, CholeskyError> {
        let mut given = vec![false; mesh.vertex_count()];
        pinned.iter().for_each(|v| given[v.index()] = true);
        let mut floating = Vec::new();
        for component in mesh.components() {
            let mut vertices: Vec<VertexId> = component.iter().flat_map(|&f| mesh.corners(f)).collect();
            vertices.sort_unstable();
            vertices.dedup();
            if vertices.iter().all(|v| !given[v.index()]) {
                given[vertices[0].index()] = true;
                floating.push(vertices);
            }
        }
        let mut count = 0;
        let unknowns: Vec<Option<usize>> = given
            .iter()
            .map(|&given| {
                (!given).then(|| {
                    count += 1;
                    count - 1
                })
            })
            .collect();
        let mut lower = Vec::with_capacity(count + 3 * mesh.edge_count());
        for e in mesh.edges() {
            let w = metric.primal_weight(e);
            let [a, b] = mesh.edge_vertices(e).map(|v| unknowns[v.index()]);
            lower.extend([a, b].into_iter().flatten().map(|u| (u, u, w)));
            if let (Some(a), Some(b)) = (a, b) {
                lower.push((a.max(b), a.min(b), -w));
            }
        }
        let factor = if count == 0 { None } else { Some(SparseCholesky::new(count, &lower)?) };
        Ok(Poisson { factor, unknowns, floating })
    }

    /// The vertices of every component without pins.
    pub fn floating(&self) -> &[Vec<VertexId>] {
        &self.floating
    }

    /// Positions whose differences fit `vectors` (|E|) best in the weighted least-squares sense.
    /// `pins` are pinned vertices with their positions, the same vertices as in [`Poisson::new`].
    pub fn solve(&self, mesh: &Mesh, metric: &Metric, vectors: &[DVec3], pins: &[(VertexId, DVec3)]) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; mesh.vertex_count()];
        pins.iter().for_each(|&(v, p)| positions[v.index()] = p);
        if let Some(factor) = &self.factor {
            let mut x = vec![DVec3::ZERO; self.unknowns.iter().flatten().count()];
            for e in mesh.edges() {
                let w = metric.primal_weight(e);
                let [a, b] = mesh.edge_vertices(e);
                let v = vectors[e.index()];
                // dᵀ ⋆ v̂, with given positions moved to the right side.
                if let Some(row) = self.unknowns[a.index()] {
                    x[row] += w * (positions[b.index()] - v);
                }
                if let Some(row) = self.unknowns[b.index()] {
                    x[row] += w * (positions[a.index()] + v);
                }
            }
            factor.solve(&mut x);
            for (position, unknown) in positions.iter_mut().zip(&self.unknowns) {
                if let Some(row) = unknown {
                    *position = x[*row];
                }
            }
        }
        for vertices in &self.floating {
            let center = vertices.iter().map(|v| positions[v.index()]).sum::<DVec3>() / vertices.len() as f64;
            vertices.iter().for_each(|v| positions[v.index()] -= center);
        }
        positions
    }

    /// What remains of `vectors` after their closest differential is taken off. Without pins.
    pub fn remove_exact_part(&self, mesh: &Mesh, metric: &Metric, vectors: &[DVec3]) -> Vec<DVec3> {
        let potential = self.solve(mesh, metric, vectors, &[]);
        mesh.edges()
            .map(|e| {
                let [a, b] = mesh.edge_vertices(e);
                vectors[e.index()] - (potential[b.index()] - potential[a.index()])
            })
            .collect()
    }
}
