//! The numbers that a file gives to its vertices and faces. Unused vertices are dropped, doubled ones welded and polygons
//! cut, so a mesh counts otherwise. Selections, tables and messages mean the file's numbers, counted from 0.

use super::VertexId;

/// What the vertices and faces of a mesh are called in the file that it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// Per vertex of the mesh: the smallest number that it has in the file, |V|.
    pub(super) vertices: Vec<u32>,
    /// Per vertex of the file: which one of the mesh it is; `None` where it belongs to no face.
    pub(super) meant: Vec<Option<VertexId>>,
    /// Per face of the mesh: the polygon that it was cut from, |F|.
    pub(super) faces: Vec<u32>,
}

/// Why a number means no vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnknownVertex {
    /// The file has it, but it belongs to no face.
    Dropped,
    /// The file has only so many.
    Beyond(usize),
}

impl Numbering {
    /// `meant` says for each vertex of the file which one of the mesh it is; `faces` for each face of the mesh the polygon
    /// of the file. Every vertex of the mesh must be meant by a number.
    pub fn new(meant: Vec<Option<VertexId>>, faces: Vec<u32>) -> Numbering {
        let count = meant.iter().flatten().map(|v| v.index() + 1).max().unwrap_or(0);
        let mut vertices = vec![u32::MAX; count];
        for (number, vertex) in (0..).zip(&meant) {
            if let Some(v) = vertex {
                let smallest: &mut u32 = &mut vertices[v.index()];
                *smallest = number.min(*smallest);
            }
        }
        Numbering { vertices, meant, faces }
    }

    /// The numbering of a part of a mesh, whose vertices and faces are called as given. It serves messages only: no number
    /// means a vertex.
    pub(super) fn of_part(vertices: Vec<u32>, faces: Vec<u32>) -> Numbering {
        Numbering { vertices, meant: Vec::new(), faces }
    }

    /// Whether the file counts as the mesh does.
    pub(super) fn is_identity(&self) -> bool {
        let same = |numbers: &[u32]| numbers.iter().enumerate().all(|(k, &number)| k == number as usize);
        self.meant.len() == self.vertices.len() && same(&self.vertices) && same(&self.faces)
    }
}
