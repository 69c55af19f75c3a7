//! Edge vectors of a frame field (Eq. 41).

use crate::algebra::quaternion;
use crate::mesh::{EdgeId, HalfedgeId, Mesh};
use crate::metric::Metric;
use glam::{DQuat, DVec3};
use rayon::prelude::*;

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
