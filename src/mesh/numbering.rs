//! The numbers that a file gives to its vertices and faces. Unused vertices are dropped, doubled ones welded and polygons
//! cut, so a mesh counts otherwise; scenes, tables and messages mean the file's numbers, counted from 0.

use super::{EdgeId, FaceId, Mesh, VertexId};
use std::sync::Arc;

/// What the vertices and faces of a mesh are called in the file that it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// Per vertex of the mesh: the smallest number that it has in the file, |V|.
    vertices: Vec<u32>,
    /// Per vertex of the file: which one of the mesh it is; `None` where it belongs to no face.
    meant: Vec<Option<VertexId>>,
    /// Per face of the mesh: the polygon that it was cut from, |F|.
    faces: Vec<u32>,
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
        for (number, vertex) in meant.iter().enumerate().rev() {
            if let Some(v) = vertex {
                vertices[v.index()] = number as u32;
            }
        }
        Numbering { vertices, meant, faces }
    }

    /// Of a part of a mesh, whose vertices and faces are called as given, for messages.
    pub(super) fn of_part(vertices: Vec<u32>, faces: Vec<u32>) -> Numbering {
        Numbering { vertices, meant: Vec::new(), faces }
    }

    fn is_identity(&self) -> bool {
        let same = |numbers: &[u32]| numbers.iter().enumerate().all(|(k, &number)| k == number as usize);
        self.meant.len() == self.vertices.len() && same(&self.vertices) && same(&self.faces)
    }
}

impl Mesh {
    /// The same mesh, called by the numbers of its file.
    #[must_use]
    pub fn numbered(mut self, numbering: Numbering) -> Mesh {
        self.numbering = (!numbering.is_identity()).then(|| Arc::new(numbering));
        self
    }

    /// How many vertices the file has, counting those that belong to no face.
    pub fn file_vertex_count(&self) -> usize {
        self.numbering.as_ref().map_or(self.vertex_count(), |numbering| numbering.meant.len())
    }

    /// The number of a vertex in the file, from 0; of a welded vertex the smallest. Its own where nothing was dropped.
    pub fn file_vertex(&self, v: VertexId) -> usize {
        self.numbering.as_ref().map_or(v.index(), |numbering| numbering.vertices[v.index()] as usize)
    }

    /// [`Mesh::file_vertex`] of all vertices, |V|.
    pub fn file_vertices(&self) -> Vec<u32> {
        self.vertices().map(|v| self.file_vertex(v) as u32).collect()
    }

    /// The number in the file of the polygon that a face was cut from, from 0.
    pub fn file_face(&self, f: FaceId) -> usize {
        self.numbering.as_ref().map_or(f.index(), |numbering| numbering.faces[f.index()] as usize)
    }

    /// [`Mesh::file_face`] of all faces, |F|.
    pub fn file_faces(&self) -> Vec<u32> {
        self.faces().map(|f| self.file_face(f) as u32).collect()
    }

    /// The corners of a face by their numbers in the file.
    pub fn file_corners(&self, f: FaceId) -> [u32; 3] {
        self.corners(f).map(|v| self.file_vertex(v) as u32)
    }

    /// The ends of an edge by their numbers in the file.
    pub fn file_ends(&self, e: EdgeId) -> [u32; 2] {
        self.edge_vertices(e).map(|v| self.file_vertex(v) as u32)
    }

    /// The vertex that a number of the file means.
    ///
    /// # Errors
    /// [`UnknownVertex`]
    pub fn vertex_of_file(&self, number: usize) -> Result<VertexId, UnknownVertex> {
        let count = self.file_vertex_count();
        match &self.numbering {
            _ if number >= count => Err(UnknownVertex::Beyond(count)),
            None => Ok(VertexId::new(number)),
            Some(numbering) => numbering.meant[number].ok_or(UnknownVertex::Dropped),
        }
    }

    /// The numbers of the file that mean each vertex, for those that several mean: the smallest and another one.
    pub(super) fn welded_numbers(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let meant = self.numbering.iter().flat_map(|numbering| numbering.meant.iter().enumerate());
        meant.filter_map(|(number, v)| {
            let first = self.file_vertex((*v)?);
            (first != number).then_some([first, number])
        })
    }
}
