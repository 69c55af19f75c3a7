//! Frames on disk, read once per pass.

use std::{collections::BTreeMap, path::Path, sync::Arc};

use rayon::prelude::*;

use super::{MovieError, Plan, quantities::Spreads, subject::Subject};
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

    /// Passes over all frames up to the last one before which every frame is there and verifies, and returns its
    /// number (0 if none is), the extent of them all and how their values are spread.
    pub fn pass(
        &self,
        plan: &Plan,
        subject: &Subject,
        at_a_time: usize,
        mut advance: impl FnMut(usize),
    ) -> Result<(usize, Extent, Spreads), MovieError> {
        let (mut whole, mut spreads) = (Extent::default(), Spreads::default());
        let frames: Vec<usize> = (1..=self.cache.manifest().frame_count).collect();
        for some in frames.chunks(at_a_time.max(1)) {
            let look_at = |&frame: &usize| -> Result<(Extent, Spreads), MovieError> {
                let state = self.cache.read_frame(frame)?;
                Ok((Extent::of(&subject.positions(&state)), subject.spreads(plan, &state)?))
            };
            let seen: Vec<_> = some.par_iter().map(look_at).collect();
            for (&frame, seen) in some.iter().zip(seen) {
                match seen {
                    Ok((extent, of_frame)) => {
                        whole.merge(&extent);
                        spreads.merge(&of_frame);
                    }
                    Err(MovieError::Cache(error)) if !matches!(error, CacheError::Io { .. }) => {
                        return Ok((frame - 1, whole, spreads));
                    }
                    Err(error) => return Err(error),
                }
                advance(frame);
            }
        }
        Ok((frames.len(), whole, spreads))
    }
}
