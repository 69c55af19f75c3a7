//! What can be wrong with a mesh, each with the element and a remedy.

use super::shapes::ShapeError;
use crate::advice::Advice;
use std::path::PathBuf;

/// Why a list of faces or a file is not an oriented manifold triangle mesh, or a shape cannot be made.
///
/// Faces and vertices count from 0 in the order of the input; [`MeshError::InFile`] says from what number the file
/// counts, and means its faces, which may be polygons. Lines count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum MeshError {
    #[error("the mesh has no faces; {}", self.remedy())]
    Empty,
    #[error("face {face} names vertex {vertex}, but there are only {vertex_count} vertices; {}", self.remedy())]
    VertexOutOfRange { face: usize, vertex: u64, vertex_count: usize },
    #[error("face {face} has corners {corners:?}, two of them equal; {}", self.remedy())]
    DegenerateFace { face: usize, corners: [u32; 3] },
    #[error("faces {faces:?} have the same corners; {}", self.remedy())]
    DuplicateFace { faces: [usize; 2] },
    #[error(
        "edge {edge:?} is shared by {} faces {faces:?}, a surface allows two; {}", faces.len(), self.remedy()
    )]
    NonManifoldEdge { edge: [u32; 2], faces: Vec<usize> },
    #[error("the faces around vertex {vertex} form more than one fan; {}", self.remedy())]
    NonManifoldVertex { vertex: usize },
    #[error("faces {faces:?} run along edge {edge:?} in the same direction; {}", self.remedy())]
    InconsistentOrientation { edge: [u32; 2], faces: [usize; 2] },
    #[error(
        "the surface is not orientable: walking from face {} over edge {edge:?} to face {} reverses its orientation \
         (a Moebius band lies in it); {}",
        faces[0], faces[1], self.remedy()
    )]
    NonOrientable { edge: [u32; 2], faces: [usize; 2] },
    #[error("vertex {vertex} belongs to no face; {}", self.remedy())]
    UnreferencedVertex { vertex: usize },
    #[error("{faces} faces and {vertices} vertices are too many, {limit} faces are the limit; {}", self.remedy())]
    TooLarge { faces: usize, vertices: usize, limit: usize },
    #[error("{}; {}", list(*count, faults, unlisted), self.remedy())]
    Several { count: usize, faults: Vec<Fault>, unlisted: Vec<String> },
    #[error("{}{}: counted from {counted_from}, {error}", path.display(), place(lines))]
    InFile { path: PathBuf, lines: Vec<usize>, counted_from: u32, error: Box<MeshError> },
    #[error("{}: {reason}; {remedy}", path.display())]
    File { path: PathBuf, reason: String, remedy: String },
    #[error("{}:{line}: {reason}; {remedy}", path.display())]
    FileLine { path: PathBuf, line: usize, reason: String, remedy: String },
    #[error(transparent)]
    Shape(Box<ShapeError>),
}

impl From<ShapeError> for MeshError {
    fn from(error: ShapeError) -> Self {
        MeshError::Shape(Box::new(error))
    }
}

impl Advice for MeshError {
    fn remedy(&self) -> String {
        let remedy = match self {
            MeshError::Empty => "give at least one triangle",
            MeshError::VertexOutOfRange { .. } => "check the file's index base",
            MeshError::DegenerateFace { .. } => "remove the face or merge its neighbours",
            MeshError::DuplicateFace { .. } => "remove one of them",
            MeshError::NonManifoldEdge { .. } => "split the mesh along it",
            MeshError::NonManifoldVertex { .. } => "duplicate the vertex, one copy per fan",
            MeshError::InconsistentOrientation { .. } => "reverse one of them",
            MeshError::NonOrientable { .. } => "use an orientable surface, for example the orientation double cover",
            MeshError::UnreferencedVertex { .. } => "remove it",
            MeshError::TooLarge { .. } => "use a coarser mesh",
            MeshError::Several { .. } => "correct all of these in the program that made the mesh, or in the file",
            MeshError::InFile { error, .. } => return error.remedy(),
            MeshError::File { remedy, .. } | MeshError::FileLine { remedy, .. } => remedy,
            MeshError::Shape(error) => return error.remedy(),
        };
        remedy.to_owned()
    }
}

/// One of several faults.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// What is wrong.
    pub error: MeshError,
    /// The faces to look at.
    pub faces: Vec<usize>,
    /// Their lines in the file, counted from 1; none where there is no text.
    pub lines: Vec<usize>,
}

impl MeshError {
    /// Whether a file is at fault.
    pub fn is_of_file(&self) -> bool {
        matches!(self, MeshError::File { .. } | MeshError::FileLine { .. } | MeshError::InFile { .. })
    }

    /// The same fault by other numbers of faces and vertices.
    pub(super) fn renumbered(self, face: impl Fn(usize) -> usize, counted_from: u32) -> MeshError {
        let vertex = |v: u32| v.saturating_add(counted_from);
        match self {
            MeshError::VertexOutOfRange { face: f, vertex, vertex_count } => {
                MeshError::VertexOutOfRange { face: face(f), vertex: vertex + u64::from(counted_from), vertex_count }
            }
            MeshError::DegenerateFace { face: f, corners } => {
                MeshError::DegenerateFace { face: face(f), corners: corners.map(vertex) }
            }
            MeshError::DuplicateFace { faces } => MeshError::DuplicateFace { faces: faces.map(face) },
            MeshError::NonManifoldEdge { edge, faces } => {
                MeshError::NonManifoldEdge { edge: edge.map(vertex), faces: faces.into_iter().map(face).collect() }
            }
            MeshError::NonManifoldVertex { vertex } => {
                MeshError::NonManifoldVertex { vertex: vertex + counted_from as usize }
            }
            MeshError::InconsistentOrientation { edge, faces } => {
                MeshError::InconsistentOrientation { edge: edge.map(vertex), faces: faces.map(face) }
            }
            MeshError::NonOrientable { edge, faces } => {
                MeshError::NonOrientable { edge: edge.map(vertex), faces: faces.map(face) }
            }
            other => other,
        }
    }
}

/// Where a fault is, behind the name of the file.
fn place(lines: &[usize]) -> String {
    match lines {
        [] => String::new(),
        [line] => format!(":{line}"),
        lines => format!(", lines {}", numbers(lines)),
    }
}

fn numbers(lines: &[usize]) -> String {
    lines.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}

/// A line for each fault.
fn list(count: usize, faults: &[Fault], unlisted: &[String]) -> String {
    let mut text = format!("there are {count} faults:");
    for Fault { error, lines, .. } in faults {
        let place = match lines.as_slice() {
            [] => String::new(),
            [line] => format!("line {line}: "),
            lines => format!("lines {}: ", numbers(lines)),
        };
        text += &format!("\n- {place}{error}");
    }
    unlisted.iter().for_each(|more| text += &format!("\n- and {more}"));
    text
}
