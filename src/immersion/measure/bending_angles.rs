//! How a realized surface is bent along its edges.

use super::TASK;
use crate::mesh::{EdgeId, HalfedgeId, Mesh};
use glam::DVec3;
use rayon::prelude::*;

/// Bending angles α of a map in radians, |E|, 0 on the boundary: the angle from the normal on the named side
/// of an edge to the one on the other side, with the sign of Eq. 15.
pub fn bending_angles(mesh: &Mesh, positions: &[DVec3]) -> Vec<f64> {
    let normal = |h: HalfedgeId| {
        let [a, b, c] = mesh.corners(h.face()).map(|v| positions[v.index()]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    (0..mesh.edge_count())
        .into_par_iter()
        .with_min_len(TASK)
        .map(|e| {
            let e = EdgeId::new(e);
            let Some([h, twin]) = mesh.edge_sides(e) else { return 0.0 };
            let (ni, nj) = (normal(h), normal(twin));
            let along = (positions[mesh.tip(h).index()] - positions[mesh.tail(h).index()]).normalize_or_zero();
            // n_j is n_i turned by α about v_ij (Eq. 1).
            libm::atan2(ni.cross(nj).dot(along), ni.dot(nj))
        })
        .collect()
}
