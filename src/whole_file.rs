//! Files that appear whole or not at all: they are written under a temporary name beside their own, and then renamed.

use std::io::{self, Write};
use std::path::Path;

use tempfile::NamedTempFile;

/// A file in the making, in the folder of the path that it is to have, with the rights of any new file.
///
/// # Errors
/// What the system says.
pub(crate) fn begin(path: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".").suffix(".part");
    // Temporary files are for their owner alone, and this one is to stay.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder_of(path))
}

/// Gives a file that has been written its name. After a crash at any instant there is the old file, the new one or none.
///
/// # Errors
/// What the system says; then there is no part of the file.
pub(crate) fn publish(file: NamedTempFile, path: &Path) -> io::Result<()> {
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    // The rename itself lasts only once the folder is on disk.
    #[cfg(unix)]
    std::fs::File::open(folder_of(path))?.sync_all()?;
    Ok(())
}

/// Writes a file of these bytes.
///
/// # Errors
/// What the system says; then there is no part of the file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = begin(path)?;
    file.write_all(bytes)?;
    publish(file, path)
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
