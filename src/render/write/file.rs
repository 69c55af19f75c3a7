//! Files that appear whole or not at all.

use std::{
    io::{self, Write},
    path::Path,
};

use tempfile::NamedTempFile;

use crate::render::RenderError;

pub(in crate::render) fn write_error(path: &Path, error: impl std::fmt::Display) -> RenderError {
    RenderError::Write { path: path.to_owned(), reason: error.to_string() }
}

/// Writes a temporary file next to the target, then renames it.
pub(in crate::render) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    let mut file = temporary_beside(path).map_err(|error| write_error(path, error))?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(|error| write_error(path, error))?;
    file.persist(path).map_err(|error| write_error(path, error.error))?;
    Ok(())
}

/// A file under a temporary name in the folder of a path, with the rights of any new file.
pub(crate) fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".immerse-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
