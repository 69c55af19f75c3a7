//! Files that appear whole or not at all.

use std::path::Path;

use crate::render::RenderError;
use crate::whole_file;

pub(in crate::render) fn write_error(path: &Path, error: impl std::fmt::Display) -> RenderError {
    RenderError::Write { path: path.to_owned(), reason: error.to_string() }
}

pub(in crate::render) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    whole_file::write(path, bytes).map_err(|error| write_error(path, error))
}
