//! What is on disk: one folder per film, readable without this program.
//!
//! ```text
//! renders/<scene name>/
//!     manifest.json        format version, what was simulated, mesh counts, checks, the key of every frame
//!     mesh.npz             triangles (F x 3, u32); edges (E x 2, u32), in the order of all that has an entry per edge;
//!                          file_vertex (V, u32) and file_face (F, u32), the numbers of vertices and polygons in the mesh
//!                          file, from 0; pinned (V, u8), 1 for vertices that are held; places (V x 3), x, y and z of
//!                          scenes, if the mesh has any; lattice (2 x 2), the sides of a flat torus
//!     frames/000001.npz    the state of frame 1: one numpy.load opens it
//!     frames/000001.json   its report, its key, and the checksum of the state
//!     report.html          a page of the film
//!     .immerse             what the pictures and the page were made of
//!     farm                 job files
//!     .lock                who writes there, while somebody does
//! ```
//!
//! Every file appears whole or not at all: it is written under a temporary name in the same folder,
//! synced and renamed. Every file is checksummed, and a frame counts as done only if it verifies and has the
//! key that the scene asks for. The same film has the same bytes, whoever made it and however often it was interrupted.

mod error;
mod folder;
mod frame_file;
mod frame_names;
mod lock;
mod manifest;
mod mesh_file;
mod seal;

pub use error::DiskError;
pub use folder::FilmFolder;
pub use lock::FolderLock;
pub use manifest::{FilmSpec, Manifest, MeshCounts};
pub use mesh_file::FilmMesh;
