//! Connectivity: halfedges, validation and repair, files, generated shapes, and sets of vertices and edges.

mod boundary_loops;
mod component;
mod connectivity;
mod error;
mod faults;
mod file_numbers;
mod ids;
mod limits;
mod numbering;
mod polygon;
mod read;
mod repair;
mod selection;
pub mod shapes;
mod surface;
pub(crate) mod union_find;
mod weld;
mod write;

pub use boundary_loops::{longest_loops, outer_loops};
pub use component::{Component, Subset};
pub use connectivity::Mesh;
pub use error::{Fault, MeshError};
pub use ids::{EdgeId, FaceId, HalfedgeId, VertexId};
pub use limits::{LARGEST_COORDINATE, MOST_FACES, MOST_KEYFRAMES, MOST_VERTICES, is_in_reach};
pub use numbering::{Numbering, UnknownVertex};
pub(crate) use read::is_binary_stl;
pub use read::{
    FileFormat, Keyframe, read, read_bending_angles, read_bending_keyframes, read_edge_lengths, read_length_keyframes,
    read_lengths, read_positions, read_vertex_numbers, read_welded,
};
pub use repair::{Repaired, repair};
pub use selection::{EdgeSelection, Selection, SelectionError, select_edges, select_vertices};
pub(crate) use surface::first_out_of_reach;
pub use surface::{Surface, SurfaceError};
pub use weld::Weld;
pub use write::{WriteError, write_obj};
