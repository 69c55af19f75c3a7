//! One writer at a time in a folder, or several who share it.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::error::DiskError;
use crate::whole_file;

/// The file that is locked. It says who holds it, and is there only meanwhile.
const NAME: &str = ".lock";
/// Folders of a film that files are written to.
const INNER: [&str; 4] = ["frames", ".immerse", "export", "export/.immerse"];
/// Bytes of it that are read.
const LONGEST: u64 = 1000;
/// How often a folder may go or a file be another one between two calls of the system.
const TRIES: usize = 100;

/// While it lives, nobody else who asks for it writes into a folder, but those who share it with this one. The system frees
/// the lock of a program that is killed; a file that it leaves is in nobody's way.
#[derive(Debug)]
pub struct FolderLock {
    folder: PathBuf,
    /// `None` on file systems that know no locks.
    file: Option<File>,
    /// Whether others may have it at the same time.
    is_shared: bool,
    /// Folders that were made for it, the outermost first; if nothing comes to be in them they go again.
    created: Vec<PathBuf>,
}

impl FolderLock {
    /// Takes the lock of a folder, which is created if it is not there, and removes files that a killed program left
    /// unfinished. `work` says what for, to whom it may concern.
    ///
    /// # Errors
    /// [`DiskError::Busy`] if somebody else has it, [`DiskError::NotAFolder`], [`DiskError::LeadsOut`] if what is written
    /// into the folder would land elsewhere, [`DiskError::Io`]. Then nothing has been changed.
    pub fn try_take(folder: &Path, work: &str) -> Result<FolderLock, DiskError> {
        FolderLock::take(folder, work, false)
    }

    /// As [`FolderLock::try_take`], beside others who share the folder and see to it themselves that no two of them write
    /// the same file in different ways. What is unfinished may be theirs, and is removed by the last one who goes.
    ///
    /// # Errors
    /// As [`FolderLock::try_take`].
    pub fn try_share(folder: &Path, work: &str) -> Result<FolderLock, DiskError> {
        FolderLock::take(folder, work, true)
    }

    fn take(folder: &Path, work: &str, is_shared: bool) -> Result<FolderLock, DiskError> {
        if folder.is_file() {
            return Err(DiskError::not_a_folder(folder));
        }
        let mut lock = FolderLock { folder: folder.to_owned(), file: None, is_shared, created: Vec::new() };
        let path = folder.join(NAME);
        for _ in 0..TRIES {
            lock.created.extend(whole_file::create_folder(folder).map_err(DiskError::io(folder, "created"))?);
            stays_inside(folder)?;
            let mut file = match open(&path) {
                // The one before us has removed the folder that it had made.
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                opened => opened.map_err(DiskError::io(&path, "written"))?,
            };
            match if is_shared { file.try_lock_shared() } else { file.try_lock() } {
                Ok(()) if is_at(&file, &path) => {
                    // It is only there to be read by people; of those who share it, it names the last one who came.
                    let _ = file.set_len(0).and_then(|()| file.write_all(holder(work).as_bytes()));
                    lock.file = Some(file);
                    if !is_shared {
                        lock.sweep();
                    }
                    return Ok(lock);
                }
                // The one before us has removed it meanwhile.
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(DiskError::Busy { path: folder.to_owned(), holder: holder_in(&mut file) });
                }
                Err(TryLockError::Error(_)) => {
                    let _ = fs::remove_file(&path);
                    return Ok(lock);
                }
            }
        }
        Err(DiskError::Busy { path: folder.to_owned(), holder: OTHERS.to_owned() })
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Whether others are kept out, which some file systems cannot do.
    pub fn keeps_others_out(&self) -> bool {
        self.file.is_some()
    }

    /// Whether nobody else has a lock that was shared, which from then on is for this one alone.
    fn is_last(&self, file: &File) -> bool {
        file.unlock().is_ok() && file.try_lock().is_ok() && is_at(file, &self.folder.join(NAME))
    }

    fn sweep(&self) {
        whole_file::sweep(&self.folder);
        INNER.iter().for_each(|inner| whole_file::sweep(&self.folder.join(inner)));
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        if let Some(file) = self.file.as_ref().filter(|file| !self.is_shared || self.is_last(file)) {
            self.sweep();
            // While it is held, so that nobody has locked it whose lock would not be seen. Windows keeps it until it is closed.
            let _ = if cfg!(unix) { fs::remove_file(self.folder.join(NAME)) } else { file.set_len(0) };
        }
        for folder in self.created.iter().rev() {
            if fs::remove_dir(folder).is_err() {
                break;
            }
        }
    }
}

/// Opens the file to lock, and never one that a link leads to.
fn open(path: &Path) -> io::Result<File> {
    if path.is_symlink() {
        fs::remove_file(path)?;
    }
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

/// Whether this file is still the one at this path.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |metadata: io::Result<fs::Metadata>| metadata.ok().map(|metadata| (metadata.dev(), metadata.ino()));
    id(file.metadata()) == id(fs::symlink_metadata(path))
}

/// It is never removed there.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

/// What is not known of a holder.
const OTHERS: &str = "another process";

fn holder(work: &str) -> String {
    let host = gethostname::gethostname();
    let since = humantime::format_rfc3339_seconds(SystemTime::now());
    format!("process {} on {}, since {since}: {work}\n", std::process::id(), host.to_string_lossy())
}

/// The holder as it says of itself, on one line.
fn holder_in(file: &mut File) -> String {
    let mut bytes = Vec::new();
    let _ = file.rewind().and_then(|()| file.take(LONGEST).read_to_end(&mut bytes));
    let text = String::from_utf8_lossy(&bytes);
    let line = text.lines().next().unwrap_or_default().trim().replace(char::is_control, " ");
    if line.is_empty() { OTHERS.to_owned() } else { line }
}

/// What is written of a film is in its folder, and not where a link leads to.
fn stays_inside(folder: &Path) -> Result<(), DiskError> {
    let whole = |path: &Path| path.canonicalize().ok();
    for path in INNER.map(|inner| folder.join(inner)).into_iter().filter(|path| path.is_symlink()) {
        match (whole(&path), whole(folder)) {
            (Some(inner), Some(folder)) if inner.starts_with(&folder) => {}
            _ => return Err(DiskError::LeadsOut { path }),
        }
    }
    Ok(())
}
