//! Connectivity: halfedges, validation and repair, file readers and generated shapes.

mod component;
mod connectivity;
mod error;
mod faults;
mod from_scene;
mod ids;
mod numbering;
mod places;
mod polygon;
mod read;
mod repair;
mod selection;
pub mod shapes;
mod weld;

pub use component::{Component, Subset};
pub use connectivity::Mesh;
pub use error::{Fault, MeshError};
pub use from_scene::{from_scene, of_scene};
pub use ids::{EdgeId, FaceId, HalfedgeId, VertexId};
pub use numbering::{Numbering, UnknownVertex};
pub use read::{read, read_edge_lengths, read_positions, read_vertex_numbers, read_welded};
pub use repair::{Repaired, repair};
pub use selection::{SelectionError, longest_loops, outer_loops, select_edges, select_vertices};

/// What a reader or a generator hands on: connectivity and what is known of the geometry.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Connectivity.
    pub mesh: Mesh,
    /// One position per vertex, where the source has any. Purely intrinsic sources have none.
    pub positions: Option<Vec<glam::DVec3>>,
    /// Where each vertex lies in the chart that a purely intrinsic shape is made in: a point of the parallelogram of a
    /// flat torus, or of the Poincaré disk. For formulas and selections.
    pub coordinates: Option<Vec<glam::DVec3>>,
    /// One length per edge, where the source decrees them independently of positions.
    pub edge_lengths: Option<Vec<f64>>,
    /// What had to be changed to get a valid mesh, in words for a report.
    pub repairs: Vec<String>,
}

impl Surface {
    /// Positions, or else coordinates: what x, y and z of a vertex mean in a scene.
    pub fn places(&self) -> Option<&[glam::DVec3]> {
        self.positions.as_deref().or(self.coordinates.as_deref())
    }
}
