//! What a closed surface encloses.

use crate::mesh::{Mesh, VertexId};
use glam::DVec3;

/// The volume that a surface encloses, positive where its front is outside; parts that are covered several times count
/// as often. `None` for a surface with boundary.
pub fn enclosed_volume(mesh: &Mesh, positions: &[DVec3]) -> Option<f64> {
    if mesh.edges().any(|e| mesh.is_boundary_edge(e)) {
        return None;
    }
    // From a point near the surface, so that nothing cancels far from the origin.
    let origin = *positions.first()?;
    let corners = |f| mesh.corners(f).map(|v: VertexId| positions[v.index()] - origin);
    Some(mesh.faces().map(corners).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum())
}
