//! Between the numbers of a mesh and those of the file that it comes from.

use super::{EdgeId, FaceId, Mesh, Numbering, UnknownVertex, VertexId};
use std::sync::Arc;

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
        self.vertex_number(v) as usize
    }

    /// [`Mesh::file_vertex`] of all vertices, |V|.
    pub fn file_vertices(&self) -> Vec<u32> {
        self.vertices().map(|v| self.vertex_number(v)).collect()
    }

    /// The number in the file of the polygon that a face was cut from, from 0.
    pub fn file_face(&self, f: FaceId) -> usize {
        self.face_number(f) as usize
    }

    /// [`Mesh::file_face`] of all faces, |F|.
    pub fn file_faces(&self) -> Vec<u32> {
        self.faces().map(|f| self.face_number(f)).collect()
    }

    /// The corners of a face by their numbers in the file.
    pub fn file_corners(&self, f: FaceId) -> [u32; 3] {
        self.corners(f).map(|v| self.vertex_number(v))
    }

    /// The ends of an edge by their numbers in the file.
    pub fn file_ends(&self, e: EdgeId) -> [u32; 2] {
        self.edge_vertices(e).map(|v| self.vertex_number(v))
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

    /// [`Mesh::file_vertex`], as it is kept.
    pub(super) fn vertex_number(&self, v: VertexId) -> u32 {
        self.numbering.as_ref().map_or(v.0, |numbering| numbering.vertices[v.index()])
    }

    /// [`Mesh::file_face`], as it is kept.
    pub(super) fn face_number(&self, f: FaceId) -> u32 {
        self.numbering.as_ref().map_or(f.0, |numbering| numbering.faces[f.index()])
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
