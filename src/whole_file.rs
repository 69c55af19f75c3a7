//! Files that are read and written whole. What is written appears whole or not at all: under a temporary name beside its
//! own, which is then renamed. What is read is a regular file of a size that has a limit, and never a device or a pipe,
//! which may have no end.

use std::fs::{self, File, FileType};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use tempfile::NamedTempFile;

/// How temporary names begin and end; in between stand six letters and digits.
const BEGINNING: &str = ".immerse-";
const ENDING: &str = ".part";
/// Names of former versions say less of whose they are, so that files that somebody may be writing are left alone.
const FORMER_AGE: Duration = Duration::from_secs(3600);

/// A file in the making, in the folder of the path that it is to have, with the rights of any new file.
///
/// # Errors
/// What the system says.
pub(crate) fn begin(path: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(BEGINNING).suffix(ENDING);
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
    sync(folder_of(path))
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

/// As [`write`]; a file that already has the bytes is left alone, so that looking at a film does not touch it.
///
/// # Errors
/// What the system says.
pub(crate) fn write_unless_same(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match read(path, u64::MAX) {
        Ok(there) if there == bytes => Ok(()),
        Err(error @ ReadError::NoFile(_)) => Err(io::Error::other(error.to_string())),
        _ => write(path, bytes),
    }
}

/// Removes a file if it is there.
///
/// # Errors
/// What the system says.
pub(crate) fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
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

/// Writes a file of these bytes where there is none.
///
/// # Errors
/// What the system says, also if there is one; then nothing is changed.
pub(crate) fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = begin(path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist_noclobber(path).map_err(|error| error.error)?;
    sync(folder_of(path))
}

/// Creates a folder that lasts, and those that it is in. Returns those that were not there before, the outermost first.
///
/// # Errors
/// What the system says.
pub(crate) fn create_folder(path: &Path) -> io::Result<Vec<PathBuf>> {
    let is_missing = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.is_dir();
    let missing: Vec<&Path> = path.ancestors().take_while(is_missing).collect();
    let mut created = Vec::new();
    for folder in missing.into_iter().rev() {
        match fs::create_dir(folder) {
            Ok(()) => {
                created.push(folder.to_owned());
                sync(folder_of(folder))?;
            }
            // Somebody else was faster.
            Err(_) if folder.is_dir() => {}
            Err(error) => return Err(error),
        }
    }
    Ok(created)
}

/// Removes the files of a folder that were begun and never got their name, as when the program was killed. Whoever calls
/// this must be the only one who writes there.
pub(crate) fn sweep(folder: &Path) {
    // What cannot be removed is in nobody's way.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_file = || entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_unfinished(&entry.file_name().to_string_lossy(), || age(&entry)) && is_file() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether this is the name of a file in the making, of this version of the program or, after a while, of a former one.
fn is_unfinished(name: &str, age: impl Fn() -> Duration) -> bool {
    let is_random = |middle: &str| middle.len() == 6 && middle.bytes().all(|b| b.is_ascii_alphanumeric());
    let between = |beginning, ending| {
        name.strip_prefix(beginning).and_then(|rest: &str| rest.strip_suffix(ending)).is_some_and(is_random)
    };
    between(BEGINNING, ENDING) || ((between(".", ENDING) || between(BEGINNING, "")) && age() > FORMER_AGE)
}

/// Since a file was last written.
fn age(entry: &fs::DirEntry) -> Duration {
    let written = entry.metadata().and_then(|metadata| metadata.modified()).unwrap_or_else(|_| SystemTime::now());
    written.elapsed().unwrap_or_default()
}

/// Sees to it that what a folder lists is on disk.
fn sync(folder: &Path) -> io::Result<()> {
    // Only there a folder can be opened.
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
