//! Frames on disk, read once per pass.

use std::{collections::BTreeMap, path::Path, sync::Arc};

use rayon::prelude::*;

use super::arrivals::Arrivals;
use crate::{
    digest::Key,
    evolve::{Frame, FrameReport},
    film::{
        disk::{DiskError, FilmFolder},
        error::FilmError,
        pictures::{plan::Plan, quantities::Spreads, subject::Subject},
    },
    render::Extent,
};

/// Frames in memory, by number.
pub(in crate::film::pictures) type Frames = BTreeMap<usize, Arc<Frame>>;

/// What was seen of frames that were passed over.
#[derive(Debug, Default)]
pub(in crate::film::pictures) struct Passed {
    /// How many frames were there, from the first on.
    pub frames: usize,
    /// Why the one after them is not.
    pub ended_by: Option<FilmError>,
    /// Where they all are.
    pub extent: Extent,
    /// How their values are spread.
    pub spreads: Spreads,
}

/// The frames of a film.
#[derive(Debug)]
pub(in crate::film::pictures) struct Reel<'a> {
    film: FilmFolder,
    frames: Frames,
    arrivals: &'a Arrivals,
}

impl<'a> Reel<'a> {
    /// Opens a film when its first frame is there.
    ///
    /// # Errors
    /// [`FilmError::NoSuchFrame`] if none comes, [`FilmError::Disk`] if there is no film.
    pub fn open(folder: &Path, arrivals: &'a Arrivals) -> Result<Reel<'a>, FilmError> {
        if !arrivals.wait_for(1) {
            return Err(FilmError::NoSuchFrame { folder: folder.to_owned(), frame: 1 });
        }
        Ok(Reel { film: FilmFolder::open(folder)?, frames: BTreeMap::new(), arrivals })
    }

    /// Whether these frames (in order) are all there by now.
    pub fn has(&self, frames: &[usize]) -> bool {
        frames.last().is_none_or(|&frame| self.arrivals.has(frame))
    }

    /// The checksum of the state of a frame that is there, and its report.
    ///
    /// # Errors
    /// [`FilmError::NoSuchFrame`] if it is not there, [`FilmError::Disk`] if it is not what was written.
    pub fn contents(&self, frame: usize) -> Result<(Key, FrameReport), FilmError> {
        self.film.contents(frame).map_err(|error| self.lost(frame, error))
    }

    /// What gives [`FilmError::Stopped`] as soon as nobody wants pictures any more.
    pub fn watch(&self) -> impl Fn() -> Result<(), FilmError> + Sync + use<'a> {
        let arrivals = self.arrivals;
        move || if arrivals.is_stopped() { Err(FilmError::Stopped) } else { Ok(()) }
    }

    /// Waits for the last of these frames.
    ///
    /// # Errors
    /// [`FilmError::NoSuchFrame`] if no more will come.
    pub fn wait_for(&self, frames: &[usize]) -> Result<(), FilmError> {
        self.watch()()?;
        match frames.last() {
            Some(&frame) if !self.arrivals.wait_for(frame) => Err(self.no_such(frame)),
            _ => Ok(()),
        }
    }

    fn no_such(&self, frame: usize) -> FilmError {
        FilmError::NoSuchFrame { folder: self.film.folder().to_owned(), frame }
    }

    fn lost(&self, frame: usize, error: DiskError) -> FilmError {
        match error {
            DiskError::Missing { .. } => self.no_such(frame),
            error => error.into(),
        }
    }

    pub fn film(&self) -> &FilmFolder {
        &self.film
    }

    /// Bytes of a frame in memory.
    pub fn frame_bytes(&self) -> usize {
        let counts = &self.film.manifest().mesh;
        24 * counts.vertices + 25 * counts.edges + 32 * counts.faces
    }

    /// These frames (in order, each once) when they are there, of which those of the last call are not read again. All
    /// others are let go.
    ///
    /// # Errors
    /// [`FilmError::NoSuchFrame`] if no more will come.
    pub fn load(&mut self, frames: &[usize]) -> Result<Frames, FilmError> {
        self.wait_for(frames)?;
        self.frames.retain(|frame, _| frames.contains(frame));
        let missing: Vec<usize> = frames.iter().copied().filter(|frame| !self.frames.contains_key(frame)).collect();
        let read: Vec<_> = missing.par_iter().map(|&frame| self.film.read_frame(frame)).collect();
        for (number, frame) in missing.into_iter().zip(read) {
            let frame = frame.map_err(|error| self.lost(number, error))?;
            self.frames.insert(number, Arc::new(frame));
        }
        Ok(self.frames.clone())
    }

    /// Passes over so many frames as they come, up to the last one before which every frame is there and verifies.
    pub fn pass(
        &self,
        plan: &Plan,
        subject: &Subject,
        count: usize,
        at_a_time: usize,
        mut advance: impl FnMut(usize),
    ) -> Result<Passed, FilmError> {
        let mut passed = Passed::default();
        let frames: Vec<usize> = (1..=count).collect();
        for some in frames.chunks(at_a_time.max(1)) {
            self.wait_for(some)?;
            let look_at = |&frame: &usize| -> Result<(Extent, Spreads), FilmError> {
                let frame = self.film.read_frame(frame)?;
                Ok((subject.extent(&frame), subject.spreads(plan, &frame)?))
            };
            let seen: Vec<_> = some.par_iter().map(look_at).collect();
            for (&frame, seen) in some.iter().zip(seen) {
                match seen {
                    Ok((extent, of_frame)) => {
                        passed.extent.merge(&extent);
                        passed.spreads.merge(&of_frame);
                    }
                    Err(FilmError::Disk(error)) if !matches!(error, DiskError::Io { .. }) => {
                        passed.ended_by = Some(self.lost(frame, error));
                        return Ok(passed);
                    }
                    Err(error) => return Err(error),
                }
                passed.frames = frame;
                advance(frame);
            }
        }
        Ok(passed)
    }
}
