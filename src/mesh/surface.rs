//! A mesh with what is known of its geometry.

use super::{Mesh, MeshError};
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

impl Surface {
    /// A surface known by the positions of its vertices.
    ///
    /// # Errors
    /// [`MeshError`] for faces that [`Mesh::from_faces`] refuses.
    pub fn from_positions(positions: Vec<DVec3>, faces: &[[u32; 3]]) -> Result<Surface, MeshError> {
        let mesh = Mesh::from_faces(positions.len(), faces)?;
        Ok(Surface { mesh, positions: Some(positions), coordinates: None, edge_lengths: None, repairs: Vec::new() })
    }

    /// Positions, or else coordinates: what formulas and selections mean by x, y and z of each vertex, |V|.
    pub fn places(&self) -> Option<&[DVec3]> {
        self.positions.as_deref().or(self.coordinates.as_deref())
    }
}
