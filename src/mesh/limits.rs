//! How many elements a mesh may have. Elements are numbered with 32 bits, so every number of an element that passes
//! [`check_size`] may be narrowed.

use super::MeshError;

/// The most faces of a mesh. Its halfedges, three a face, are numbered as well, and so are both ends of all edges, of which
/// there may be as many; one number stands for "none".
pub const MOST_FACES: usize = u32::MAX as usize / 6 - 1;

/// The most vertices of a mesh.
pub const MOST_VERTICES: usize = u32::MAX as usize - 1;

/// How far from 0 coordinates may be. Squares of them, and products of several, are still numbers then, also in single
/// precision where pictures are made.
pub const LARGEST_COORDINATE: f64 = 1e15;

/// More keyframes than any film needs, each of which has a number for every edge.
pub const MOST_KEYFRAMES: usize = 10_000;

/// Whether a point is one, not too far away to compute with.
pub fn is_in_reach(point: glam::DVec3) -> bool {
    point.is_finite() && point.abs().max_element() <= LARGEST_COORDINATE
}

/// Refuses what has no faces, and what has too many elements.
pub(super) fn check_size(vertices: usize, faces: usize) -> Result<(), MeshError> {
    if faces == 0 {
        return Err(MeshError::Empty);
    }
    if faces > MOST_FACES || vertices > MOST_VERTICES {
        return Err(MeshError::TooLarge { faces, vertices, limit: MOST_FACES });
    }
    Ok(())
}
