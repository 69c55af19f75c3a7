//! Files that are read and written whole. What is written appears whole or not at all: under a temporary name beside its
//! own, which is then renamed. What is read is a regular file of a size that has a limit, and never a device or a pipe,
//! which may have no end.

use std::fs::{File, FileType};
use std::io::{self, Read, Write};
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
    File::open(folder_of(path))?.sync_all()?;
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

/// Why a file cannot be read whole.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ReadError {
    /// What the system says.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// There is something of this name that is no file.
    #[error("it is {0}, not a file")]
    NoFile(&'static str),
    /// It has more bytes than are taken.
    #[error("it is larger than {} MiB", most >> 20)]
    TooLarge { most: u64 },
}

/// All bytes of a regular file, or of one that a link leads to, if they are not more than `most`.
///
/// # Errors
/// [`ReadError`], found before anything is read.
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, ReadError> {
    // Before it is opened: a pipe that nobody writes to would not open.
    let what = std::fs::metadata(path)?;
    if !what.is_file() {
        return Err(ReadError::NoFile(kind(what.file_type())));
    }
    let too_large = ReadError::TooLarge { most };
    if what.len() > most {
        return Err(too_large);
    }
    let mut bytes = Vec::new();
    // It may grow meanwhile.
    File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large) } else { Ok(bytes) }
}

/// What is no regular file, in words.
fn kind(of: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if of.is_fifo() {
            return "a pipe";
        }
        if of.is_socket() {
            return "a socket";
        }
        if of.is_char_device() || of.is_block_device() {
            return "a device";
        }
    }
    if of.is_dir() { "a folder" } else { "something else" }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
