//! The file of a moving picture while it is written.

use std::{fs::File, io::BufWriter, path::PathBuf};

use tempfile::NamedTempFile;

use crate::film::error::FilmError;
use crate::whole_file;

/// A file under a temporary name beside its final one.
#[derive(Debug)]
pub(super) struct Draft {
    file: NamedTempFile,
    path: PathBuf,
}

impl Draft {
    pub fn begin(path: PathBuf) -> Result<Draft, FilmError> {
        let file = whole_file::begin(&path);
        Ok(Draft { file: file.map_err(|error| FilmError::write(&path, error))?, path })
    }

    pub fn writer(&self) -> Result<BufWriter<File>, FilmError> {
        let file = self.file.as_file().try_clone();
        Ok(BufWriter::new(file.map_err(|error| self.error(error))?))
    }

    pub fn error(&self, reason: impl std::fmt::Display) -> FilmError {
        FilmError::write(&self.path, reason)
    }

    /// Gives the file its name; everything must have been flushed.
    pub fn publish(self) -> Result<(), FilmError> {
        let Draft { file, path } = self;
        whole_file::publish(file, &path).map_err(|error| FilmError::write(&path, error))
    }
}
