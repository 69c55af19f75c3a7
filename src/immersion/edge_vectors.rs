//! Edge vectors of a frame field (Eq. 41) and their period part.

use super::Poisson;
use crate::algebra::quaternion;
use crate::mesh::{EdgeId, HalfedgeId, Mesh};
use crate::metric::Metric;
use crate::spin::Homology;
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::collections::VecDeque;

/// The averaged edge vectors v̂ (Eq. 41), |E|, each in the direction of its edge: the mean of `ω_i(v)` (Eq. 10) of the
/// faces on its sides, the edge vector as each one's own frame sees it.
pub fn edge_vectors(mesh: &Mesh, metric: &Metric, frames: &[DQuat]) -> Vec<DVec3> {
    let tangents: Vec<[DVec3; 2]> = frames.par_iter().with_min_len(TASK).map(|q| quaternion::tangents(*q)).collect();
    let direction = |h: HalfedgeId| {
        let (z, [x, y]) = (metric.direction(h), tangents[h.face().index()]);
        z.re * x + z.im * y
    };
    let vector = |e: usize| {
        let e = EdgeId::new(e);
        let h = mesh.edge_halfedge(e);
        match mesh.twin(h) {
            None => metric.length(e) * direction(h),
            Some(twin) => 0.5 * metric.length(e) * (direction(h) - direction(twin)),
        }
    };
    (0..mesh.edge_count()).into_par_iter().with_min_len(TASK).map(vector).collect()
}

/// Faces or edges that are worth a task of their own.
const TASK: usize = 1024;

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
        let closed: Vec<Vec<f64>> =
            homology.generators().iter().map(|g| crossings(mesh, &oriented(mesh, &g.path))).collect();
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

/// A path with its edges in order, each as a halfedge in the direction of the path. `path` begins with one of its
/// edges, from whose ends it is followed one after the other.
fn oriented(mesh: &Mesh, path: &[EdgeId]) -> Vec<HalfedgeId> {
    let Some((&first, rest)) = path.split_first() else { return Vec::new() };
    let [mut start, mut end] = mesh.edge_vertices(first);
    let mut ordered = VecDeque::from([(first, start)]);
    for &e in rest {
        let [a, b] = mesh.edge_vertices(e);
        let ends = [(a, b), (b, a)];
        if let Some((_, far)) = ends.into_iter().find(|(near, _)| *near == start) {
            ordered.push_front((e, far));
            start = far;
        } else if let Some((near, far)) = ends.into_iter().find(|(near, _)| *near == end) {
            ordered.push_back((e, near));
            end = far;
        }
    }
    let halfedge = |(e, tail)| mesh.halfedges_of(e).find(|&h| mesh.tail(h) == tail);
    ordered.into_iter().filter_map(halfedge).collect()
}

/// How often each edge crosses a closed path, or one from boundary to boundary, when it is pushed a little to its
/// left: a closed form whose period along a strip is how often the strip crosses the path.
///
/// Counting crossings of a strip would not do on a surface with boundary: along a strip around a boundary curve that
/// form has no period at all.
fn crossings(mesh: &Mesh, path: &[HalfedgeId]) -> Vec<f64> {
    let mut form = vec![0.0; mesh.edge_count()];
    let mut add = |h: HalfedgeId, count: f64| {
        let e = mesh.edge(h);
        form[e.index()] += if mesh.edge_halfedge(e) == h { count } else { -count };
    };
    let ends = path.last().zip(path.first()).map(|(&last, &first)| (last, mesh.tip(last), mesh.tail(first)));
    // A path that comes back to a boundary vertex may as well end there.
    let closing = ends.and_then(|(last, to, from)| (to == from && !mesh.is_boundary_vertex(to)).then_some(last));
    for (k, &h) in path.iter().enumerate() {
        let before = if k > 0 { Some(path[k - 1]) } else { closing };
        // Counterclockwise around the tail, to where the path came from or to the boundary.
        let mut side = h.previous();
        while before.is_none_or(|before| mesh.edge(before) != mesh.edge(side)) {
            add(side, -1.0);
            let Some(twin) = mesh.twin(side) else { break };
            side = twin.previous();
        }
        // Clockwise around the tip, where the path ends on the boundary.
        if k + 1 == path.len() && closing.is_none() {
            let mut side = h.next();
            loop {
                add(side, 1.0);
                let Some(twin) = mesh.twin(side) else { break };
                side = twin.next();
            }
        }
    }
    form
}

fn inner(mesh: &Mesh, metric: &Metric, a: &[f64], b: &[f64]) -> f64 {
    mesh.edges().map(|e| metric.primal_weight(e) * a[e.index()] * b[e.index()]).sum()
}
