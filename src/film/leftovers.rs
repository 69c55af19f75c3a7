//! Pictures in the folder of a film that are not of it.

use std::{
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::Path,
};

use super::disk::FilmFolder;
use super::error::FilmError;
use crate::scene::{AnimationFormat, OutputSection};

/// What was found beside the pictures of a film, by name in order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Leftovers {
    /// Pictures of another film, such as a longer one, which were removed.
    pub removed: Vec<String>,
    /// Pictures of formats that are not asked for now. They may be of this film as it was.
    pub older: Vec<String>,
}

/// Removes pictures and curves from the folder of a film that are of another one, and finds those in formats that
/// `output` does not ask for. Only files with the names that this program gives are looked at, and only those are removed
/// that say of themselves that this program made them.
///
/// # Errors
/// [`FilmError::Disk`] if there is no film, [`FilmError::Render`] if a file cannot be removed.
pub fn clear_leftovers(folder: &Path, output: Option<&OutputSection>) -> Result<Leftovers, FilmError> {
    let film = FilmFolder::open(folder)?;
    let (hash, frames) = (film.manifest().fingerprint, film.manifest().frame_count);
    let mut leftovers = Leftovers::default();
    let failed = |error: io::Error| FilmError::write(folder, error);
    let mut names: Vec<String> = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.file_type().is_ok_and(|kind| kind.is_file()) {
            names.extend(entry.file_name().into_string());
        }
    }
    names.sort();
    leftovers.removed.extend(film.remove_frames_beyond()?.into_iter().map(|name| format!("frames/{name}")));
    let has_curves = frames == 1 && is_table_of_curves(&folder.join("curves.csv"));
    for name in names {
        let path = folder.join(&name);
        let Some(picture) = Made::of(&name) else { continue };
        let is_stale = match picture {
            Made::Curves => has_curves,
            Made::Frame(number, _) if !(1..=frames).contains(&number) => made_for(&path).is_some(),
            _ => made_for(&path).flatten().is_some_and(|made_for| made_for != hash),
        };
        if is_stale {
            fs::remove_file(&path).map_err(|error| FilmError::write(&path, error))?;
            leftovers.removed.push(name);
        } else if output.is_some_and(|output| !picture.is_asked_for(output)) && made_for(&path).is_some() {
            leftovers.older.push(name);
        }
    }
    Ok(leftovers)
}

/// Files that are made of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Made {
    /// Of a frame, as PNG or else EXR.
    Frame(usize, bool),
    Film(AnimationFormat),
    Sheet,
    Curves,
}

impl Made {
    fn of(name: &str) -> Option<Made> {
        let (stem, ending) = name.split_once('.')?;
        let is_number = stem.len() == 6 && stem.bytes().all(|b| b.is_ascii_digit());
        match (stem, ending) {
            (_, "png" | "exr") if is_number => Some(Made::Frame(stem.parse().ok()?, ending == "png")),
            ("film", "gif") => Some(Made::Film(AnimationFormat::Gif)),
            ("film", "apng") => Some(Made::Film(AnimationFormat::Apng)),
            ("film", "mp4") => Some(Made::Film(AnimationFormat::Mp4)),
            ("sheet", "png") => Some(Made::Sheet),
            ("curves", "csv" | "svg") => Some(Made::Curves),
            _ => None,
        }
    }

    fn is_asked_for(self, output: &OutputSection) -> bool {
        match self {
            Made::Frame(_, true) => output.png,
            Made::Frame(_, false) => output.exr,
            Made::Film(format) => output.animation.contains(&format),
            Made::Sheet => output.sheet > 0,
            Made::Curves => true,
        }
    }
}

/// Bytes from the start of a file, or its end, among which it says who made it.
const HEAD: u64 = 16 << 10;
const TAIL: i64 = 256;

/// The fingerprint of the film that a file is of, if it says so; `None` if this program did not make it.
fn made_for(path: &Path) -> Option<Option<u32>> {
    let mut head = Vec::new();
    let mut file = File::open(path).ok()?;
    file.by_ref().take(HEAD).read_to_end(&mut head).ok()?;
    if file.seek(SeekFrom::End(-TAIL)).is_ok() {
        file.read_to_end(&mut head).ok()?;
    }
    let after = |word: &[u8]| head.windows(word.len()).position(|window| window == word).map(|at| at + word.len());
    after(b"immerse ")?;
    let hash = [&b"Scene hash"[..], b"sceneHash"].into_iter().find_map(after).and_then(|start| {
        // What stands between a key and its text depends on the format, and has no eight digits in a row.
        let near = head.get(start..)?;
        let digits = near[..near.len().min(48)].windows(8).find(|digits| digits.iter().all(u8::is_ascii_hexdigit))?;
        u32::from_str_radix(str::from_utf8(digits).ok()?, 16).ok()
    });
    Some(hash)
}

/// Curves say nothing of who made them but what their columns are.
fn is_table_of_curves(path: &Path) -> bool {
    fs::read_to_string(path).is_ok_and(|table| table.starts_with("frame,time,l2_length_error,"))
}
