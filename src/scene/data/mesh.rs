//! `[mesh]`: a file or a generated shape.

use std::path::PathBuf;

use crate::mesh::shapes::Shape;

/// `[mesh]`: a file or a generated shape.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSection {
    /// `file = "…"`: OBJ, PLY, OFF, STL, FOLD or arrays of NumPy, by its ending.
    File(PathBuf),
    /// `shape = "…"` with that shape's parameters.
    Shape(Shape),
}

impl MeshSection {
    /// The file, if it is one.
    pub fn file(&self) -> Option<&PathBuf> {
        match self {
            MeshSection::File(path) => Some(path),
            MeshSection::Shape(_) => None,
        }
    }
}

impl Default for MeshSection {
    fn default() -> Self {
        MeshSection::Shape(Shape::Sphere { radius: 1.0, subdivisions: 16 })
    }
}
