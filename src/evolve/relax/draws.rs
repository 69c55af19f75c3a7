//! Random frames, drawn again and again.

use crate::frames::random_frames;
use glam::DQuat;

/// What frames are drawn with, and the best that came of it.
#[derive(Debug)]
pub(super) struct Draws {
    seed: u64,
    /// The number of rims of the best attempt so far, and its frames.
    fewest_rims: Option<(usize, Vec<DQuat>)>,
}

impl Draws {
    /// None yet.
    pub fn new(seed: u64) -> Draws {
        Draws { seed, fewest_rims: None }
    }

    /// The frames of an attempt, |F|; the first one is that of the seed itself.
    pub fn frames(&self, faces: usize, attempt: usize) -> Vec<DQuat> {
        // Seeds of restarts are far from those that users write.
        random_frames(faces, self.seed ^ (attempt as u64) << 32)
    }

    /// Takes note of an attempt that ended with so many rims.
    pub fn note(&mut self, rims: usize, frames: &[DQuat]) {
        if self.fewest_rims.as_ref().is_none_or(|(fewest, _)| rims < *fewest) {
            self.fewest_rims = Some((rims, frames.to_vec()));
        }
    }

    /// The frames of the attempt with the fewest rims, |F|; none twice.
    pub fn take_best(&mut self) -> Option<Vec<DQuat>> {
        self.fewest_rims.take().map(|(_, frames)| frames)
    }
}
