//! Connectivity: halfedges, validation and repair, file readers and generated shapes.

mod connectivity;
mod error;
mod from_scene;
mod ids;
mod read;
mod repair;
pub mod shapes;

pub use connectivity::Mesh;
pub use error::MeshError;
pub use from_scene::from_scene;
pub use ids::{EdgeId, FaceId, HalfedgeId, VertexId};
pub use read::{read, read_edge_lengths};
pub use repair::{Repaired, repair};

/// What a reader or a generator hands on: connectivity and what is known of the geometry.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Connectivity.
    pub mesh: Mesh,
    /// One position per vertex, where the source has any. Purely intrinsic sources have none.
    pub positions: Option<Vec<glam::DVec3>>,
    /// One length per edge, where the source decrees them independently of positions.
    pub edge_lengths: Option<Vec<f64>>,
    /// What had to be changed to get a valid mesh, in words for a report.
    pub repairs: Vec<String>,
}
