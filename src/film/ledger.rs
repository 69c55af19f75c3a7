//! Which pictures of a film are made, `.immerse/pictures.jsonl` in its folder, and its page, `.immerse/page.jsonl`; and which exports,
//! `.immerse/exports.jsonl` in theirs.
//!
//! Each line names a file, the key of all that it was made of, the key of the frames that it shows, and its checksum, after a
//! checksum of the line itself. Lines are appended as files appear, and the last one of a file holds; a line that is not as
//! it was written counts for nothing, and its file is made again. In the end the lines are put in order, so that the file has the same bytes however often a run was interrupted.
//!
//! Of several programs that make pictures of a film at the same time, each enters them into a part of its own,
//! `.immerse/pictures.000031.jsonl`, called by its first frame. Whoever is alone in the folder then reads all parts, and puts them
//! into the one ledger.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};

use super::error::FilmError;
use crate::digest::Key;
use crate::whole_file;

/// The pictures of a film, of which several may be made at a time.
#[derive(Debug)]
pub(super) struct Ledger {
    folder: PathBuf,
    /// Where it is there.
    name: &'static str,
    /// The part that files are entered into; `None` for the ledger itself.
    part: Option<PathBuf>,
    pages: Mutex<Pages>,
}

#[derive(Debug)]
struct Pages {
    entries: BTreeMap<String, Entry>,
    /// Open once something was entered.
    log: Option<File>,
}

/// What is known of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Of all that it was made of.
    pub key: Key,
    /// Of the frames that it shows, without camera and look.
    pub shows: Key,
    /// Its checksum.
    pub sha256: Key,
}

#[derive(Deserialize, Serialize)]
struct Line<'a> {
    file: std::borrow::Cow<'a, str>,
    key: Key,
    shows: Key,
    sha256: Key,
}

/// How a line begins, before the CRC-32 of the name of the ledger and all the bytes after `SEALED`.
const SEAL: &[u8] = b"{\"crc32\":\"";
const SEALED: &[u8] = b"\",";

impl Line<'_> {
    /// With its checksum and its end, for a ledger of this name.
    fn written(&self, name: &str) -> io::Result<Vec<u8>> {
        let json = serde_json::to_vec(self)?;
        let body = [json.strip_prefix(b"{").unwrap_or(&json), b"\n"].concat();
        let crc = crc_of(name, &body);
        Ok([SEAL, crc.as_bytes(), SEALED, &body].concat())
    }

    /// The reverse; none of what is damaged, or of another ledger.
    fn read<'a>(line: &'a [u8], name: &str) -> Option<Line<'a>> {
        let (crc, rest) = line.strip_prefix(SEAL)?.split_at_checked(8)?;
        let body = rest.strip_prefix(SEALED)?;
        (crc == crc_of(name, body).as_bytes()).then(|| serde_json::from_slice(line).ok())?
    }
}

/// The checksum of a line, which is of no ledger but the one of this name.
fn crc_of(name: &str, body: &[u8]) -> String {
    let mut crc = crc32fast::Hasher::new();
    crc.update(name.as_bytes());
    crc.update(body);
    format!("{:08x}", crc.finalize())
}

/// Where it is in the folder of a film.
const LEDGER: &str = ".immerse/pictures.jsonl";
/// Where its parts are, and how they are called around a number.
const PARTS: &str = ".immerse";
const PART: [&str; 2] = ["pictures.", ".jsonl"];
/// Where that of exports is in the folder they are in.
pub(super) const EXPORTS: &str = ".immerse/exports.jsonl";

/// Where that of the page of a film is in its folder.
pub(super) const PAGE: &str = ".immerse/page.jsonl";

impl Ledger {
    /// Of the pictures in a folder; empty if there is none.
    ///
    /// # Errors
    /// [`FilmError::Render`] if it is there and cannot be read.
    pub fn open(folder: &Path) -> Result<Ledger, FilmError> {
        let ledger = Ledger::named(folder, LEDGER)?;
        for part in parts(folder)? {
            ledger.pages().entries.extend(entries(&part, LEDGER)?);
        }
        Ok(ledger)
    }

    /// As [`Ledger::open`], to enter pictures from this frame on while others enter theirs elsewhere.
    ///
    /// # Errors
    /// As [`Ledger::open`].
    pub fn open_part(folder: &Path, first_frame: usize) -> Result<Ledger, FilmError> {
        let [before, after] = PART;
        let part = folder.join(PARTS).join(format!("{before}{first_frame:06}{after}"));
        Ok(Ledger { part: Some(part), ..Ledger::open(folder)? })
    }

    /// Removes the ledger of the pictures in a folder.
    ///
    /// # Errors
    /// [`FilmError::Render`] if it cannot be removed.
    pub fn forget(folder: &Path) -> Result<(), FilmError> {
        parts(folder)?.into_iter().chain([folder.join(LEDGER)]).try_for_each(|path| remove(&path))
    }

    /// Of the exports in a folder.
    ///
    /// # Errors
    /// As [`Ledger::open`].
    pub fn of_exports(folder: &Path) -> Result<Ledger, FilmError> {
        Ledger::named(folder, EXPORTS)
    }

    /// Of the page in the folder of a film. Pictures come and go without it.
    ///
    /// # Errors
    /// As [`Ledger::open`].
    pub fn of_page(folder: &Path) -> Result<Ledger, FilmError> {
        Ledger::named(folder, PAGE)
    }

    fn named(folder: &Path, name: &'static str) -> Result<Ledger, FilmError> {
        let entries = entries(&folder.join(name), name)?;
        Ok(Ledger { folder: folder.to_owned(), name, part: None, pages: Mutex::new(Pages { entries, log: None }) })
    }

    /// The bytes of a file that was made of what has this key, if it is there and whole.
    pub fn fresh(&self, file: &str, key: Key) -> Option<Vec<u8>> {
        let entry = self.entry(file).filter(|entry| entry.key == key)?;
        let bytes = fs::read(self.folder.join(file)).ok()?;
        (Key::of_bytes(&bytes) == entry.sha256).then_some(bytes)
    }

    /// Whether a file was made of what has this key, is there and whole. It may be larger than memory.
    pub fn is_fresh(&self, file: &str, key: Key) -> bool {
        let entry = self.entry(file).filter(|entry| entry.key == key);
        entry.is_some_and(|entry| key_of_file(&self.folder.join(file)).is_ok_and(|found| found == entry.sha256))
    }

    /// The files that are known, in order.
    pub fn files(&self) -> Vec<String> {
        self.pages().entries.keys().cloned().collect()
    }

    /// What is known of a file.
    pub fn entry(&self, file: &str) -> Option<Entry> {
        self.pages().entries.get(file).copied()
    }

    /// Enters a file that has just been made.
    ///
    /// # Errors
    /// [`FilmError::Render`] if the file or the ledger cannot be read or written.
    pub fn enter(&self, file: &str, key: Key, shows: Key) -> Result<(), FilmError> {
        let made = self.folder.join(file);
        let sha256 = key_of_file(&made).map_err(|error| FilmError::read(&made, error))?;
        let path = self.part.clone().unwrap_or_else(|| self.folder.join(self.name));
        let mut pages = self.pages();
        let written = pages.append(&path, self.name, &Line { file: file.into(), key, shows, sha256 });
        written.map_err(|error| FilmError::write(&path, error))?;
        pages.entries.insert(file.to_owned(), Entry { key, shows, sha256 });
        Ok(())
    }

    /// Puts the entries in order, those of all parts too, and leaves out those of files that are gone. Without any there is no
    /// ledger. A part stays as it is.
    ///
    /// # Errors
    /// [`FilmError::Render`] if the ledger cannot be written.
    pub fn close(self) -> Result<(), FilmError> {
        let Ledger { folder, name, part, pages } = self;
        let Pages { mut entries, log } = pages.into_inner().unwrap_or_else(PoisonError::into_inner);
        drop(log);
        if part.is_some() {
            return Ok(());
        }
        entries.retain(|file, _| folder.join(file).is_file());
        let path = folder.join(name);
        let mut bytes = Vec::new();
        for (file, &Entry { key, shows, sha256 }) in &entries {
            let line = Line { file: file.into(), key, shows, sha256 };
            bytes.extend(line.written(name).map_err(|error| FilmError::write(&path, error))?);
        }
        let written = match bytes.is_empty() {
            true => whole_file::remove(&path),
            false => whole_file::write_unless_same(&path, &bytes),
        };
        written.map_err(|error| FilmError::write(&path, error))?;
        if name == LEDGER { parts(&folder)?.iter().try_for_each(|part| remove(part)) } else { Ok(()) }
    }

    fn pages(&self) -> std::sync::MutexGuard<'_, Pages> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The entries of a ledger or a part of it, whose lines are those of a ledger of this name; none if it is not there.
fn entries(path: &Path, name: &str) -> Result<BTreeMap<String, Entry>, FilmError> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(FilmError::read(path, error)),
    };
    let whole_lines = bytes.split_inclusive(|&byte| byte == b'\n').filter(|line| line.ends_with(b"\n"));
    let lines = whole_lines.filter_map(|line| Line::read(line, name));
    Ok(lines.map(|Line { file, key, shows, sha256 }| (file.into_owned(), Entry { key, shows, sha256 })).collect())
}

/// The parts of the ledger of pictures in a folder, in order.
fn parts(folder: &Path) -> Result<Vec<PathBuf>, FilmError> {
    let folder = folder.join(PARTS);
    let names = match fs::read_dir(&folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        names => names.and_then(|names| names.map(|entry| Ok(entry?.file_name())).collect::<io::Result<Vec<_>>>()),
    };
    let [before, after] = PART;
    let is_part = |name: &str| {
        let number = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    let names = names.map_err(|error| FilmError::read(&folder, error))?;
    let mut parts: Vec<PathBuf> =
        names.iter().filter(|name| name.to_str().is_some_and(is_part)).map(|name| folder.join(name)).collect();
    parts.sort();
    Ok(parts)
}

/// Removes a file, if it is there.
pub(super) fn remove(path: &Path) -> Result<(), FilmError> {
    whole_file::remove(path).map_err(|error| FilmError::write(path, error))
}

fn key_of_file(path: &Path) -> io::Result<Key> {
    Key::of_reader(&mut File::open(path)?)
}

impl Pages {
    fn append(&mut self, path: &Path, name: &str, line: &Line) -> io::Result<()> {
        let log = match &mut self.log {
            Some(log) => log,
            None => {
                path.parent().map_or(Ok(()), fs::create_dir_all)?;
                let mut log = OpenOptions::new().append(true).create(true).open(path)?;
                // What a crash has cut must not run into what follows.
                if log.metadata()?.len() > 0 {
                    log.write_all(b"\n")?;
                }
                self.log.insert(log)
            }
        };
        log.write_all(&line.written(name)?)
    }
}
