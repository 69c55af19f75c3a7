//! What is wrong with a file, before it is said of which.

use std::path::Path;

use crate::advice::Advice;
use crate::mesh::MeshError;
use crate::whole_file::{self, ReadError};

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
        Self { line: None, reason: short(reason.into()), remedy: remedy.into() }
    }

    /// A problem of a line.
    pub fn at(line: usize, reason: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { line: Some(line), reason: short(reason.into()), remedy: remedy.into() }
    }

    /// A mesh that is too small or too large as a whole.
    pub fn of_size(error: &MeshError) -> Self {
        Self::new(error.reason(), error.remedy())
    }

    /// The problem of a frame of a file that has several; that at the top, number 0, needs no name.
    pub fn of_frame(self, number: usize) -> Self {
        match number {
            0 => self,
            _ => Self { reason: short(format!("frame {number}: {}", self.reason)), ..self },
        }
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

/// A reason as far as it is read: a word of the file that it repeats may be as long as the file.
fn short(mut reason: String) -> String {
    const SHOWN: usize = 400;
    if let Some((end, _)) = reason.char_indices().nth(SHOWN) {
        reason.truncate(end);
        reason.push('…');
    }
    reason
}

/// The most bytes of a mesh file or a table, which is more than the largest mesh that fits into memory has.
pub(super) const MOST_BYTES: u64 = 4 << 30;

/// All bytes of a file.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    whole_file::read(path, MOST_BYTES).map_err(|error| {
        let remedy = match error {
            ReadError::Io(_) => "check the path (relative ones start at the scene file) and the permissions",
            ReadError::NoFile(_) => "name a file; what comes out of a pipe can be saved as one",
            ReadError::TooLarge { .. } => "reduce it to fewer faces or lines",
        };
        Problem::new(format!("cannot be read: {error}"), remedy).in_file(path)
    })
}
