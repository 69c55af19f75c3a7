//! Point constraints (Sec. 5.4.1): vertices whose positions are given.

use crate::mesh::{Mesh, VertexId};
use crate::scene::PinSection;
use glam::DVec3;

/// Why pins are refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum PinError {
    #[error("pin {pin} selects no vertex; list vertex indices from 0 in `vertices`")]
    Empty { pin: usize },
    #[error("pin {pin} names vertex {vertex}, but the mesh has {vertices} vertices; use indices below {vertices}")]
    OutOfRange { pin: usize, vertex: usize, vertices: usize },
    #[error("pin {pin} has {vertices} vertices and {positions} positions; give one position per vertex, or none")]
    Count { pin: usize, vertices: usize, positions: usize },
    #[error("pin {pin} gives no positions and the mesh has none; add `positions`, one per vertex")]
    NoPositions { pin: usize },
    #[error("vertex {vertex} is pinned to {first:?} and to {second:?}; keep one of the two")]
    Contradiction { vertex: usize, first: [f64; 3], second: [f64; 3] },
}

/// Pinned vertices with their positions, each vertex once, in order of vertices.
pub fn pins_from_scene(
    sections: &[PinSection],
    mesh: &Mesh,
    positions: Option<&[DVec3]>,
) -> Result<Vec<(VertexId, DVec3)>, PinError> {
    let mut pins: Vec<(VertexId, DVec3)> = Vec::new();
    for (pin, section) in sections.iter().enumerate() {
        let count = section.vertices.len();
        if count == 0 {
            return Err(PinError::Empty { pin });
        }
        if !section.positions.is_empty() && section.positions.len() != count {
            return Err(PinError::Count { pin, vertices: count, positions: section.positions.len() });
        }
        for (k, &vertex) in section.vertices.iter().enumerate() {
            if vertex >= mesh.vertex_count() {
                return Err(PinError::OutOfRange { pin, vertex, vertices: mesh.vertex_count() });
            }
            let place = match (section.positions.get(k), positions) {
                (Some(p), _) => DVec3::from_array(*p),
                (None, Some(positions)) => positions[vertex],
                (None, None) => return Err(PinError::NoPositions { pin }),
            };
            pins.push((VertexId::new(vertex), place));
        }
    }
    pins.sort_by_key(|(v, _)| *v);
    if let Some([(v, a), (_, b)]) = pins.array_windows().find(|[(v, a), (w, b)]| v == w && a != b) {
        return Err(PinError::Contradiction { vertex: v.index(), first: a.to_array(), second: b.to_array() });
    }
    pins.dedup_by_key(|(v, _)| *v);
    Ok(pins)
}
