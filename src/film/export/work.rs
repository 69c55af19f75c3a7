//! Exports a film.

use std::path::Path;

use super::layout::{Layout, Mark, file_of_frame};
use super::spool::Spools;
use super::subject::Subject;
use super::view::View;
use crate::digest::{Digest, Key};
use crate::evolve::Frame;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::ledger::Ledger;
use crate::film::pictures::{Arrivals, Event, Watch, at_a_time, in_order};
use crate::scene::ExportFormat;
use crate::whole_file;

/// Counts the ways in which films have been exported, so that no folder mixes two.
pub const EXPORTER: u32 = 2;

/// What was done about an export.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exported {
    /// Files that were written.
    pub made: usize,
    /// Files that were there.
    pub kept: usize,
    /// Files of frames that the film does not have any more, which were removed.
    pub removed: Vec<String>,
}

/// Exports frames of a film, given by number in order, into a folder: a file of each, or one of all. Files that are there,
/// whole, and made of the same frames are kept, unless it is to begin anew.
///
/// # Errors
/// [`FilmError::NoSuchFrame`] if a frame is not there; files that are finished stay, and none is left unfinished.
pub fn export(
    folder: &Path,
    format: ExportFormat,
    frames: &[usize],
    to: &Path,
    restart: bool,
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<Exported, FilmError> {
    let film = FilmFolder::open(folder)?;
    let (frames, wants) = (thinned(frames, format, watch), format.wants());
    let view = if wants.view { View::of(&film, &frames, arrivals, watch)? } else { View::default() };
    let key = key_of_all(&film, format, &view);
    let subject = Subject::of(&film, &frames, view, wants)?;
    whole_file::create_folder(to).map_err(|error| FilmError::write(to, error))?;
    let ledger = Ledger::of_exports(to)?;
    let work = Work { film: &film, subject: &subject, layout: &*format.layout(&subject), to, ledger: &ledger, restart };
    let mut exported = work.write(key, &frames, arrivals, watch)?;
    exported.removed = work.clear()?;
    ledger.close()?;
    Ok(exported)
}

/// No more frames than a file of the format has.
fn thinned(frames: &[usize], format: ExportFormat, watch: &mut Watch) -> Vec<usize> {
    let Some(most) = format.most_frames().filter(|&most| frames.len() > most) else { return frames.to_vec() };
    let (count, name) = (frames.len(), format.name());
    watch(Event::Note(format!("{name} has {most} of the {count} frames, evenly spread; choose others with --frames")));
    (0..most).map(|k| frames[k * (count - 1) / (most - 1)]).collect()
}

/// Of all that an export is made of beside the frames.
fn key_of_all(film: &FilmFolder, format: ExportFormat, view: &View) -> Key {
    Digest::of("export")
        .count(EXPORTER as usize)
        .text(env!("CARGO_PKG_VERSION"))
        .text(format.name())
        .text(&film.manifest().scene)
        .key(film.manifest().mesh_sha256)
        .shown(&view.frame_rate)
        .shown(&view.key)
        .finish()
}

/// An export under way.
struct Work<'a> {
    film: &'a FilmFolder,
    subject: &'a Subject,
    layout: &'a dyn Layout,
    to: &'a Path,
    ledger: &'a Ledger,
    restart: bool,
}

/// A frame that is exported.
#[derive(Clone, Copy)]
struct Shown {
    /// Its place among them, from 0.
    place: usize,
    /// Of its state, and of that of the first frame of the film, which fields are measured against.
    key: Key,
    mark: Mark,
}

impl Work<'_> {
    fn write(&self, key: Key, frames: &[usize], arrivals: &Arrivals, watch: &mut Watch) -> Result<Exported, FilmError> {
        let missing = |frame| FilmError::NoSuchFrame { folder: self.film.folder().to_owned(), frame };
        let contents = |frame| self.film.contents(frame).map_err(|_| missing(frame));
        let first = contents(1)?.0;
        let mut states = Vec::new();
        for (place, &number) in frames.iter().enumerate() {
            let (state, report) = contents(number)?;
            let camera = self.subject.camera.poses.get(place).map(|pose| pose.world_from_eye);
            let of_frame = Digest::of("frame").key(key).key(first).key(state).shown(&camera).finish();
            states.push(Shown { place, key: of_frame, mark: Mark { number, time: report.time } });
        }
        let of_all = states.iter().fold(Digest::of("frames").key(key), |digest, state| digest.key(state.key)).finish();
        watch(Event::Begin("export", frames.len()));
        let is_fresh = |file: &str, key| !self.restart && self.ledger.is_fresh(file, key);
        let marks: Vec<Mark> = states.iter().map(|state| state.mark).collect();
        let mut exported = Exported::default();
        let mut spools = Spools::new(self.to);
        // One file of each frame: only those that are missing or stale. One of all: all frames, or nothing.
        let ending = self.layout.ending();
        let whole: Vec<&str> = self.layout.end(&marks, &[]).into_iter().map(|(name, _)| name).collect();
        let has_all = whole.iter().all(|name| is_fresh(name, of_all));
        let wanted: Vec<Shown> = match ending {
            Some(ending) => {
                let is_stale = |state: &Shown| !is_fresh(&file_of_frame(state.mark.number, ending), state.key);
                states.into_iter().filter(is_stale).collect()
            }
            None if has_all => Vec::new(),
            None => states,
        };
        if ending.is_some() {
            exported.kept += frames.len() - wanted.len();
        }
        let mut done = frames.len() - wanted.len();
        watch(Event::Done(done));
        in_order(
            wanted.len(),
            at_a_time(self.bytes_of_frame()),
            |wave| {
                wave.map(|k| Ok((k, self.film.read_frame(wanted[k].mark.number)?)))
                    .collect::<Result<Vec<_>, FilmError>>()
            },
            |wave: &Vec<(usize, Frame)>, k| {
                if arrivals.is_stopped() {
                    return Err(FilmError::Stopped);
                }
                let frame = &wave[k - wave[0].0].1;
                let pieces = self.layout.frame(&self.subject.moment(wanted[k].place, frame)?);
                Ok((k, pieces.map_err(|reason| FilmError::write(self.to, reason))?))
            },
            |(k, pieces)| {
                let Shown { key, mark: Mark { number, .. }, .. } = wanted[k];
                if let Some(ending) = ending {
                    let (name, bytes) = (file_of_frame(number, ending), pieces.concat());
                    let path = self.to.join(&name);
                    whole_file::write(&path, &bytes).map_err(|error| FilmError::write(&path, error))?;
                    self.ledger.enter(&name, key, key)?;
                    exported.made += 1;
                } else {
                    spools.push(&pieces).map_err(|error| FilmError::write(self.to, error))?;
                }
                done += 1;
                watch(Event::Done(done));
                Ok(())
            },
        )?;
        if has_all {
            exported.kept += whole.len();
            return Ok(exported);
        }
        for (name, parts) in self.layout.end(&marks, spools.lengths()) {
            let path = self.to.join(name);
            spools.write(&path, &parts).map_err(|error| FilmError::write(&path, error))?;
            self.ledger.enter(name, of_all, of_all)?;
            exported.made += 1;
        }
        Ok(exported)
    }

    /// Bytes of a frame while it is written, about.
    fn bytes_of_frame(&self) -> usize {
        400 * self.subject.vertices + 800 * self.subject.triangles.len()
    }

    /// Removes files of frames that the film does not have, if they were exported from here.
    fn clear(&self) -> Result<Vec<String>, FilmError> {
        let Some(ending) = self.layout.ending() else { return Ok(Vec::new()) };
        let number = |name: &str| -> Option<usize> {
            name.strip_prefix("film.")?.strip_suffix(ending)?.strip_suffix('.')?.parse().ok()
        };
        let beyond = |name: &String| number(name).is_some_and(|number| number > self.film.manifest().frame_count);
        let old: Vec<String> = self.ledger.files().into_iter().filter(beyond).collect();
        for name in &old {
            let path = self.to.join(name);
            whole_file::remove(&path).map_err(|error| FilmError::write(&path, error))?;
        }
        Ok(old)
    }
}
