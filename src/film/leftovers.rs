//! Pictures in the folder of a film that are not of it.

use std::{
    fs::{self, File},
    io::{self, Read, Seek, SeekFrom},
    path::Path,
};

use super::animation::file_name;
use super::certificate::{CERTIFICATE, is_stale};
use super::disk::FilmFolder;
use super::error::FilmError;
use super::ledger::{Ledger, PAGE, remove};
use super::pictures::{PREVIEW, SHEET};
use super::report::REPORT;
use crate::scene::{AnimationFormat, OutputSection};

/// What was found beside the pictures of a film, by name in order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Leftovers {
    /// Pictures of another film, such as a longer one, or of frames as they were before, which were removed.
    pub removed: Vec<String>,
    /// Pictures of formats that are not asked for now. They show frames of this film, perhaps from elsewhere.
    pub older: Vec<String>,
}

/// Removes pictures and curves from the folder of a film that show no frame of it, and finds those in formats that
/// `output` does not ask for. Only files with the names that this program gives are looked at, and only those are removed
/// that say of themselves that this program made them. Where a new page follows, the old one waits for it.
///
/// # Errors
/// [`FilmError::Disk`] if there is no film, [`FilmError::Render`] if a file cannot be removed.
pub fn clear_leftovers(
    folder: &Path,
    output: Option<&OutputSection>,
    page_follows: bool,
) -> Result<Leftovers, FilmError> {
    let film = FilmFolder::open(folder)?;
    let frames = film.manifest().frame_count;
    let (ledger, of_page) = (Ledger::open(folder)?, Ledger::of_page(folder)?);
    let of_all = film.all_contents()?;
    let mut leftovers = Leftovers::default();
    leftovers.removed.extend(film.remove_frames_beyond()?.into_iter().map(|name| format!("frames/{name}")));
    let has_curves = frames == 1 && is_table_of_curves(&folder.join("curves.csv"));
    for (name, made) in made_files(folder)? {
        let path = folder.join(&name);
        let known = if made == Made::Report { &of_page } else { &ledger };
        let shows = known.entry(&name).map(|entry| entry.shows);
        let is_stale = match made {
            Made::Curves => has_curves,
            Made::Certificate => is_stale(&film),
            // A frame that is not done shows nothing.
            Made::Frame(number, _) => shows.is_none() || film.state(number)? != shows,
            Made::Report if page_follows => false,
            Made::Film(_) | Made::Sheet | Made::Report => shows != Some(of_all),
        };
        if is_stale && (made == Made::Curves || is_ours(&path)) {
            remove(&path)?;
            leftovers.removed.push(name);
        } else if output.is_some_and(|output| !made.is_asked_for(output)) && is_ours(&path) {
            leftovers.older.push(name);
        }
    }
    ledger.close()?;
    of_page.close()?;
    Ok(leftovers)
}

/// Removes the frames of whatever film a folder holds, and forgets what its pictures and its page were made of, to begin anew. Pictures
/// are then made again, or go with [`clear_leftovers`]. Files that are not of a film stay.
///
/// # Errors
/// [`FilmError::Disk`] if the folder is a file or a frame cannot be removed, [`FilmError::Render`]
pub fn clear_film(folder: &Path) -> Result<(), FilmError> {
    FilmFolder::clear(folder)?;
    remove(&folder.join(PAGE))?;
    forget_pictures(folder)
}

/// Forgets what the pictures of a film were made of, so that all are made anew.
///
/// # Errors
/// [`FilmError::Render`] if the list cannot be removed.
pub fn forget_pictures(folder: &Path) -> Result<(), FilmError> {
    Ledger::forget(folder)
}

/// Removes the picture of the newest frame of an earlier run, which soon will show no frame of the film.
///
/// # Errors
/// [`FilmError::Render`] if it cannot be removed.
pub fn forget_preview(folder: &Path) -> Result<(), FilmError> {
    let path = folder.join(PREVIEW);
    if is_ours(&path) { remove(&path) } else { Ok(()) }
}

/// The files in a folder that have the names of pictures and curves, in order.
fn made_files(folder: &Path) -> Result<Vec<(String, Made)>, FilmError> {
    let failed = |error: io::Error| FilmError::read(folder, error);
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if entry.file_type().is_ok_and(|kind| kind.is_file())
            && let Ok(name) = entry.file_name().into_string()
            && let Some(made) = Made::of(&name)
        {
            files.push((name, made));
        }
    }
    files.sort_by(|(a, _), (b, _)| a.cmp(b));
    Ok(files)
}

/// Files that are made of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Made {
    /// Of a frame, as PNG or else EXR.
    Frame(usize, bool),
    Film(AnimationFormat),
    Sheet,
    Report,
    Curves,
    Certificate,
}

impl Made {
    fn of(name: &str) -> Option<Made> {
        let (stem, ending) = name.split_once('.')?;
        let is_number = stem.len() == 6 && stem.bytes().all(|b| b.is_ascii_digit());
        match (stem, ending) {
            (_, "png" | "exr") if is_number => Some(Made::Frame(stem.parse().ok()?, ending == "png")),
            _ if name == SHEET => Some(Made::Sheet),
            _ if name == REPORT => Some(Made::Report),
            _ if name == CERTIFICATE => Some(Made::Certificate),
            ("curves", "csv" | "svg") => Some(Made::Curves),
            _ => {
                let formats = [AnimationFormat::Gif, AnimationFormat::Apng, AnimationFormat::Mp4];
                formats.into_iter().find(|&format| file_name(format) == name).map(Made::Film)
            }
        }
    }

    fn is_asked_for(self, output: &OutputSection) -> bool {
        match self {
            Made::Frame(_, true) => output.png,
            Made::Frame(_, false) => output.exr,
            Made::Film(format) => output.animation.contains(&format),
            Made::Sheet => output.sheet > 0,
            Made::Report => output.report,
            Made::Curves | Made::Certificate => true,
        }
    }
}

/// Bytes from the start of a file, or its end, among which it says who made it.
const HEAD: u64 = 16 << 10;
const TAIL: i64 = 256;

/// Whether a file says of itself that this program made it.
fn is_ours(path: &Path) -> bool {
    let read = || {
        let mut head = Vec::new();
        let mut file = File::open(path)?;
        file.by_ref().take(HEAD).read_to_end(&mut head)?;
        if file.seek(SeekFrom::End(-TAIL)).is_ok() {
            file.read_to_end(&mut head)?;
        }
        Ok::<_, io::Error>(head)
    };
    const MARK: &[u8] = b"immerse ";
    read().is_ok_and(|head| head.windows(MARK.len()).any(|window| window == MARK))
}

/// Curves say nothing of who made them but what their columns are.
fn is_table_of_curves(path: &Path) -> bool {
    fs::read_to_string(path).is_ok_and(|table| table.starts_with("frame,time,l2_length_error,"))
}
