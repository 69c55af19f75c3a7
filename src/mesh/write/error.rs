//! Why a file of a mesh cannot be written.

use std::path::PathBuf;

use crate::advice::Advice;

/// Why a file of a mesh cannot be written. There is no part of it then, and a file that was there before is as it was.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum WriteError {
    #[error("{}: there is no folder {}; {}", path.display(), folder.display(), self.remedy())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("{}: cannot be written: {reason}; {}", path.display(), self.remedy())]
    Io { path: PathBuf, reason: String },
    #[error("{}: there are {positions} positions for {vertices} vertices; {}", path.display(), self.remedy())]
    Count { path: PathBuf, positions: usize, vertices: usize },
    #[error("{}: vertex {vertex} lies at {position:?}, which is not finite; {}", path.display(), self.remedy())]
    NotFinite { path: PathBuf, vertex: usize, position: [f64; 3] },
}

impl Advice for WriteError {
    fn remedy(&self) -> String {
        let remedy = match self {
            WriteError::NoFolder { .. } => "make the folder first, or write to another one",
            WriteError::Io { .. } => "check the path, the permissions and the space that is left",
            WriteError::Count { .. } => "give one position for each vertex of the mesh",
            WriteError::NotFinite { .. } => "give finite positions",
        };
        remedy.to_owned()
    }
}
