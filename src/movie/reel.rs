//! Frames on disk, read once per pass.

use std::{collections::BTreeMap, path::Path, sync::Arc};

use rayon::prelude::*;

use super::{MovieError, subject::Subject};
use crate::{
    cache::{Cache, CacheError, FrameState},
    render::Extent,
};

/// Frames in memory, by number.
pub(super) type States = BTreeMap<usize, Arc<FrameState>>;

/// The frames of a film.
#[derive(Debug)]
pub(super) struct Reel {
    cache: Cache,
    states: States,
}

impl Reel {
    pub fn open(folder: &Path) -> Result<Reel, CacheError> {
        Ok(Reel { cache: Cache::open(folder)?, states: BTreeMap::new() })
    }

    pub fn cache(&self) -> &Cache {
        &self.cache
    }

    /// Bytes of a frame in memory.
    pub fn frame_bytes(&self) -> usize {
        let counts = &self.cache.manifest().mesh;
        24 * counts.vertices + 25 * counts.edges + 32 * counts.faces
    }

    /// These frames (in order, each once), of which those of the last call are not read again. All others are let go.
    pub fn load(&mut self, frames: &[usize]) -> Result<States, CacheError> {
        self.states.retain(|frame, _| frames.contains(frame));
        let missing: Vec<usize> = frames.iter().copied().filter(|frame| !self.states.contains_key(frame)).collect();
        let read: Vec<_> = missing.par_iter().map(|&frame| self.cache.read_frame(frame)).collect();
        for (frame, state) in missing.into_iter().zip(read) {
            self.states.insert(frame, Arc::new(state?));
        }
        Ok(self.states.clone())
    }

    /// Extent of all frames up to the last one before which every frame is there and verifies, and its number; 0 if
    /// none is.
    pub fn extent(
        &self,
        subject: &Subject,
        at_a_time: usize,
        mut advance: impl FnMut(usize),
    ) -> Result<(usize, Extent), MovieError> {
        let mut whole = Extent::default();
        let frames: Vec<usize> = (1..=self.cache.manifest().frame_count).collect();
        for some in frames.chunks(at_a_time.max(1)) {
            let extent =
                |&frame: &usize| self.cache.read_frame(frame).map(|state| Extent::of(&subject.positions(&state)));
            let extents: Vec<_> = some.par_iter().map(extent).collect();
            for (&frame, extent) in some.iter().zip(extents) {
                match extent {
                    Ok(extent) => whole.merge(&extent),
                    Err(error @ CacheError::Io { .. }) => return Err(error.into()),
                    Err(_) => return Ok((frame - 1, whole)),
                }
                advance(frame);
            }
        }
        Ok((frames.len(), whole))
    }
}
