//! What is on disk: one folder per film, readable without this program.
//!
//! ```text
//! renders/<scene name>/
//!     manifest.json        format version, what was simulated, mesh counts, checks
//!     mesh.npz             triangles (F x 3, u32); file_vertex (V, u32) and file_face (F, u32), the numbers of vertices and
//!                          polygons in the mesh file, from 0; places (V x 3), x, y and z of scenes, if the mesh has any
//!     frames/000001.npz    the state of frame 1: one numpy.load opens it
//!     frames/000001.json   its report, and the checksum of the state
//! ```
//!
//! Every file appears whole or not at all: it is written under a temporary name in the same folder,
//! synced and renamed. Every file is checksummed, and a frame counts as done only if it verifies. The
//! state is the same bytes from run to run; what depends on the machine (seconds) stands in the report.

mod error;
mod file;
mod film;
mod frame;
mod manifest;
mod npz;

pub use crate::evolve::FrameReport;
pub use error::CacheError;
pub(crate) use file::write_atomically;
pub use film::Cache;
pub use manifest::{Film, Manifest, MeshCounts};

/// Version of all files in the folder. Raised when their meaning changes.
pub const FORMAT: u32 = 1;
