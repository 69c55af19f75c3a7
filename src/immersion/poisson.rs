//! Vertex positions from edge vectors: the Poisson problem (Eq. 42, Alg. 7), with pins.

use crate::algebra::{CholeskyError, SparseCholesky};
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::Metric;
use glam::DVec3;
use rayon::prelude::*;

/// The factorized Laplacian `dᵀ ⋆ d` of a metric. Factorized once per metric.
#[derive(Debug)]
pub struct Poisson {
    factor: Option<SparseCholesky>,
    /// Per vertex: its unknown, or `None` where its position is given.
    unknowns: Vec<Option<usize>>,
    /// Per unknown: its vertex.
    unknown_vertices: Vec<VertexId>,
    /// Per component without pins: its vertices, to be centered.
    floating: Vec<Vec<VertexId>>,
    spokes: Spokes,
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
        let unknown_vertices: Vec<VertexId> = mesh.vertices().filter(|v| !given[v.index()]).collect();
        let mut unknowns = vec![None; mesh.vertex_count()];
        unknown_vertices.iter().enumerate().for_each(|(row, v)| unknowns[v.index()] = Some(row));
        let count = unknown_vertices.len();
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
        Ok(Poisson { factor, unknowns, unknown_vertices, floating, spokes: Spokes::new(mesh) })
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
            // dᵀ ⋆ v̂, with given positions moved to the right side.
            let term = |(e, sign): (EdgeId, f64)| sign * metric.primal_weight(e) * vectors[e.index()];
            let right_side = |v: &VertexId| self.spokes.of(*v).map(term).sum();
            let vertices = self.unknown_vertices.par_iter().with_min_len(TASK);
            let mut x: Vec<DVec3> = vertices.map(right_side).collect();
            for (pin, place) in pins {
                for (e, _) in self.spokes.of(*pin) {
                    let row = mesh.edge_vertices(e).into_iter().find_map(|v| self.unknowns[v.index()]);
                    row.into_iter().for_each(|row| x[row] += metric.primal_weight(e) * *place);
                }
            }
            factor.solve(&mut x);
            positions.par_iter_mut().with_min_len(TASK).zip(&self.unknowns).for_each(|(position, unknown)| {
                if let Some(row) = unknown {
                    *position = x[*row];
                }
            });
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
        (0..mesh.edge_count())
            .into_par_iter()
            .with_min_len(TASK)
            .map(|e| {
                let e = EdgeId::new(e);
                let [a, b] = mesh.edge_vertices(e);
                vectors[e.index()] - (potential[b.index()] - potential[a.index()])
            })
            .collect()
    }
}

/// The edges at every vertex, so that each vertex can sum over its own.
#[derive(Debug)]
struct Spokes {
    /// Per vertex: where its list ends; it begins where that of the vertex before ends.
    ends: Vec<u32>,
    /// Twice an edge, and 1 more if it arrives at the vertex.
    list: Vec<u32>,
}

impl Spokes {
    fn new(mesh: &Mesh) -> Spokes {
        let mut ends = vec![0; mesh.vertex_count()];
        let vertices = || mesh.edges().map(|e| mesh.edge_vertices(e).map(VertexId::index));
        vertices().flatten().for_each(|v| ends[v] += 1);
        let mut total = 0;
        for end in &mut ends {
            // Where the list begins, until it is filled.
            total += std::mem::replace(end, total);
        }
        let mut list = vec![0; 2 * mesh.edge_count()];
        for (e, ends_of_edge) in vertices().enumerate() {
            for (arrives, v) in ends_of_edge.into_iter().enumerate() {
                list[ends[v] as usize] = (2 * e + arrives) as u32;
                ends[v] += 1;
            }
        }
        Spokes { ends, list }
    }

    /// The edges at a vertex, in order; 1 if they arrive there, and −1 if they leave.
    fn of(&self, v: VertexId) -> impl Iterator<Item = (EdgeId, f64)> + '_ {
        let begin = if v.0 == 0 { 0 } else { self.ends[v.index() - 1] };
        let list = &self.list[begin as usize..self.ends[v.index()] as usize];
        list.iter().map(|k| (EdgeId(k / 2), if k % 2 == 1 { 1.0 } else { -1.0 }))
    }
}

/// Vertices or edges that are worth a task of their own.
const TASK: usize = 1024;
