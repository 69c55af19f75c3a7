//! Reads triangle meshes from files. What is not a triangle is cut into triangles, what can be repaired is repaired, and
//! everything else is an error with its place in the file.

mod content;
mod edges;
mod file;
mod format;
mod formats;
mod keyframes;
mod lengths;
mod positions;
mod problem;
mod soup;
mod surface;
mod tables;
mod words;

pub use file::{read, read_welded};
pub use format::FileFormat;
pub(crate) use formats::stl::is_binary as is_binary_stl;
pub use keyframes::{Keyframe, read_bending_keyframes, read_length_keyframes};
pub use lengths::{read_bending_angles, read_lengths};
pub use positions::read_positions;
pub use tables::{read_edge_lengths, read_vertex_numbers};
