//! Other random frames, where rims do not resolve.

use super::cursor::Cursor;
use super::relaxation::Relaxation;
use crate::frames::random_frames;
use crate::tuning::MAX_RESTARTS;
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
    fn frames(&self, faces: usize, attempt: usize) -> Vec<DQuat> {
        // Seeds of restarts are far from those that users write.
        random_frames(faces, self.seed ^ (attempt as u64) << 32)
    }
}

impl Relaxation {
    /// Rims that are left in the end do not resolve any more; other random frames may do without them. When all
    /// attempts are used up, the one with the fewest rims is kept.
    pub(super) fn draw_anew_if_tangled(&mut self) {
        let Some(draws) = &mut self.draws else { return };
        let rims = self.state.rims_at(&self.state.integrate()).len();
        if draws.fewest_rims.as_ref().is_none_or(|(fewest, _)| rims < *fewest) {
            draws.fewest_rims = Some((rims, self.state.face_frames().to_vec()));
        }
        if rims > 0 && self.cursor.restarts < MAX_RESTARTS {
            self.cursor = Cursor { restarts: self.cursor.restarts + 1, ..self.cursor.at_start_of(0) };
            let frames = draws.frames(self.state.mesh().face_count(), self.cursor.restarts);
            self.state.set_face_frames(frames);
        } else if let Some((_, frames)) = draws.fewest_rims.take() {
            self.state.set_face_frames(frames);
        }
    }
}
