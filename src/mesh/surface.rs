//! A mesh with what is known of its geometry.

use super::limits::{LARGEST_COORDINATE, is_in_reach};
use super::{Mesh, MeshError, VertexId};
use crate::advice::Advice;
use glam::DVec3;

/// What a reader or a generator hands on: connectivity and what is known of the geometry.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Connectivity.
    pub mesh: Mesh,
    /// One position per vertex, where the source has any. Purely intrinsic sources have none.
    pub positions: Option<Vec<DVec3>>,
    /// Where each vertex lies in the chart that a purely intrinsic shape is made in: a point of the parallelogram of a
    /// flat torus, or of the Poincaré disk. Formulas and selections mean these points where there are no positions.
    pub coordinates: Option<Vec<DVec3>>,
    /// One length per edge, where the source decrees them independently of positions.
    pub edge_lengths: Option<Vec<f64>>,
    /// What had to be changed to get a valid mesh, in words for a report.
    pub repairs: Vec<String>,
}

/// Why a surface does not hold together.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SurfaceError {
    #[error("there are {found} {what}, the mesh wants {expected}; {}", self.remedy())]
    Count { what: &'static str, found: usize, expected: usize },
    #[error("vertex {vertex} is at {place:?}; {}", self.remedy())]
    OutOfReach { vertex: usize, place: [f64; 3] },
}

impl Advice for SurfaceError {
    fn remedy(&self) -> String {
        match self {
            SurfaceError::Count { .. } => "take all of them from the same mesh".into(),
            SurfaceError::OutOfReach { .. } => format!(
                "coordinates must be finite and at most {LARGEST_COORDINATE:e}, correct them or use another unit"
            ),
        }
    }
}

/// The first point that is none, or too far away to compute with, and its coordinates.
pub(crate) fn first_out_of_reach(points: &[DVec3]) -> Option<(usize, [f64; 3])> {
    let index = points.iter().position(|point| !is_in_reach(*point))?;
    Some((index, points[index].to_array()))
}

impl Surface {
    /// A surface known by the positions of its vertices.
    ///
    /// # Errors
    /// [`MeshError`] for faces that [`Mesh::from_faces`] refuses.
    pub fn from_positions(positions: Vec<DVec3>, faces: &[[u32; 3]]) -> Result<Surface, MeshError> {
        let mesh = Mesh::from_faces(positions.len(), faces)?;
        Ok(Surface { mesh, positions: Some(positions), coordinates: None, edge_lengths: None, repairs: Vec::new() })
    }

    /// Whether every array has one entry per vertex or edge, and positions are in reach.
    ///
    /// # Errors
    /// [`SurfaceError`] for the first array that is of another mesh.
    pub fn check(&self) -> Result<(), SurfaceError> {
        let (vertices, edges) = (self.mesh.vertex_count(), self.mesh.edge_count());
        let counts = [
            ("positions", self.positions.as_ref().map(Vec::len), vertices),
            ("coordinates", self.coordinates.as_ref().map(Vec::len), vertices),
            ("edge lengths", self.edge_lengths.as_ref().map(Vec::len), edges),
        ];
        for (what, found, expected) in counts {
            if let Some(found) = found.filter(|found| *found != expected) {
                return Err(SurfaceError::Count { what, found, expected });
            }
        }
        let lost = |points: &Option<Vec<DVec3>>| points.as_deref().and_then(first_out_of_reach);
        match lost(&self.positions).or(lost(&self.coordinates)) {
            Some((vertex, place)) => {
                Err(SurfaceError::OutOfReach { vertex: self.mesh.file_vertex(VertexId::new(vertex)), place })
            }
            None => Ok(()),
        }
    }

    /// Positions, or else coordinates: what formulas and selections mean by x, y and z of each vertex, |V|.
    pub fn places(&self) -> Option<&[DVec3]> {
        self.positions.as_deref().or(self.coordinates.as_deref())
    }
}
