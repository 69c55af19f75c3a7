//! Other random frames, where rims do not resolve.

use super::cursor::Cursor;
use super::relaxation::Relaxation;
use crate::tuning::MAX_RESTARTS;

impl Relaxation {
    /// Rims that are left in the end do not resolve any more; other random frames may do without them. When all
    /// attempts are used up, the one with the fewest rims is kept.
    pub(super) fn draw_anew_if_tangled(&mut self) {
        let rims = self.rims_now().len();
        let Some(draws) = &mut self.draws else { return };
        draws.note(rims, self.state.face_frames());
        if rims > 0 && self.cursor.restarts < MAX_RESTARTS {
            self.cursor = Cursor { restarts: self.cursor.restarts + 1, ..self.cursor.at_start_of(0) };
            let frames = draws.frames(self.state.mesh().face_count(), self.cursor.restarts);
            self.state.set_face_frames(frames);
        } else if let Some(frames) = draws.take_best() {
            self.state.set_face_frames(frames);
        }
    }
}
