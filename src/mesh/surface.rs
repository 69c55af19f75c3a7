//! A mesh with what is known of its geometry.

use super::{Mesh, MeshError};
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum SurfaceError {
    #[error("there are {found} {what}, the mesh wants {expected}; {}", self.remedy())]
    Count { what: &'static str, found: usize, expected: usize },
    #[error("the position of vertex {vertex} is not finite; {}", self.remedy())]
    NotFinite { vertex: usize },
}

impl Advice for SurfaceError {
    fn remedy(&self) -> String {
        match self {
            SurfaceError::Count { .. } => "take all of them from the same mesh".into(),
            SurfaceError::NotFinite { .. } => "correct it, or leave the positions out".into(),
        }
    }
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

    /// Whether every array has one entry per vertex or edge, and positions are finite.
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
        let lost = |points: &Option<Vec<DVec3>>| points.iter().flatten().position(|point| !point.is_finite());
        match lost(&self.positions).or(lost(&self.coordinates)) {
            Some(vertex) => Err(SurfaceError::NotFinite { vertex }),
            None => Ok(()),
        }
    }

    /// Positions, or else coordinates: what formulas and selections mean by x, y and z of each vertex, |V|.
    pub fn places(&self) -> Option<&[DVec3]> {
        self.positions.as_deref().or(self.coordinates.as_deref())
    }
}
