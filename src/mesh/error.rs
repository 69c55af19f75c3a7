//! What can be wrong with a mesh, each with the element and a remedy.

use std::path::PathBuf;

/// Why a list of faces or a file is not an oriented manifold triangle mesh.
///
/// Face, vertex and line numbers: faces and vertices count from 0 in the order of the input,
/// lines from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum MeshError {
    #[error("the mesh has no faces; give at least one triangle")]
    Empty,
    #[error(
        "face {face} names vertex {vertex}, but there are only {vertex_count} vertices; check the file's index base"
    )]
    VertexOutOfRange { face: usize, vertex: u64, vertex_count: usize },
    #[error("face {face} has corners {corners:?}, two of them equal; remove the face or merge its neighbours")]
    DegenerateFace { face: usize, corners: [u32; 3] },
    #[error("faces {faces:?} have the same corners; remove one of them")]
    DuplicateFace { faces: [usize; 2] },
    #[error("edge {edge:?} is shared by {} faces {faces:?}, a surface allows two; split the mesh along it", faces.len())]
    NonManifoldEdge { edge: [u32; 2], faces: Vec<usize> },
    #[error("the faces around vertex {vertex} form more than one fan; duplicate the vertex, one copy per fan")]
    NonManifoldVertex { vertex: usize },
    #[error("faces {faces:?} run along edge {edge:?} in the same direction; reverse one of them")]
    InconsistentOrientation { edge: [u32; 2], faces: [usize; 2] },
    #[error(
        "the surface is not orientable: walking from face {} over edge {edge:?} to face {} reverses its orientation \
         (a Moebius band lies in it); use an orientable surface, for example the orientation double cover",
        faces[0], faces[1]
    )]
    NonOrientable { edge: [u32; 2], faces: [usize; 2] },
    #[error("vertex {vertex} belongs to no face; remove it")]
    UnreferencedVertex { vertex: usize },
    #[error("{faces} faces and {vertices} vertices are too many, {limit} faces are the limit; use a coarser mesh")]
    TooLarge { faces: usize, vertices: usize, limit: usize },
    #[error("{}{lines} (faces and vertices counted from 0): {error}", path.display())]
    InFile { path: PathBuf, lines: String, error: Box<MeshError> },
    #[error("{}: {reason}; {remedy}", path.display())]
    File { path: PathBuf, reason: String, remedy: String },
    #[error("{}:{line}: {reason}; {remedy}", path.display())]
    FileLine { path: PathBuf, line: usize, reason: String, remedy: String },
    #[error("shape `{shape}`: {reason}; {remedy}")]
    Shape { shape: String, reason: String, remedy: String },
}

impl MeshError {
    /// The faces this is about, if it names any.
    pub fn faces(&self) -> Vec<usize> {
        match self {
            MeshError::VertexOutOfRange { face, .. } | MeshError::DegenerateFace { face, .. } => vec![*face],
            MeshError::DuplicateFace { faces }
            | MeshError::InconsistentOrientation { faces, .. }
            | MeshError::NonOrientable { faces, .. } => faces.to_vec(),
            MeshError::NonManifoldEdge { faces, .. } => faces.clone(),
            MeshError::InFile { error, .. } => error.faces(),
            _ => Vec::new(),
        }
    }
}
