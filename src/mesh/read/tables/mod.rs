//! Tables of numbers that belong to elements of a mesh.

mod csv;
mod header;
mod table;

pub use csv::{read_edge_lengths, read_vertex_numbers};
