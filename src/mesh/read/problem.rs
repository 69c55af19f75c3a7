//! What is wrong with a file, before it is said of which.

use std::path::Path;

use crate::advice::Advice;
use crate::mesh::MeshError;

/// What is wrong with a file, on which line, and what to do about it.
pub(super) struct Problem {
    /// The line, counted from 1; `None` where there are no lines or the whole file is meant.
    pub line: Option<usize>,
    pub reason: String,
    pub remedy: String,
}

impl Problem {
    /// A problem of the whole file.
    pub fn new(reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { line: None, reason: reason.into(), remedy: remedy.into() }
    }

    /// A problem of a line.
    pub fn at(line: usize, reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { line: Some(line), reason: reason.into(), remedy: remedy.into() }
    }

    /// A mesh that is too small or too large as a whole.
    pub fn of_size(error: &MeshError) -> Self {
        Self::new(error.reason(), error.remedy())
    }

    /// The problem as an error that names the file.
    pub fn in_file(self, path: &Path) -> MeshError {
        let Problem { line, reason, remedy } = self;
        let path = path.to_path_buf();
        match line {
            Some(line) => MeshError::FileLine { path, line, reason, remedy },
            None => MeshError::File { path, reason, remedy },
        }
    }
}

/// All bytes of a file.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    std::fs::read(path).map_err(|error| {
        let remedy = "check the path (relative ones start at the scene file) and the permissions";
        Problem::new(format!("cannot be read: {error}"), remedy).in_file(path)
    })
}
