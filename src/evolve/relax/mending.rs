//! Frames of patches around rims anew, where rims do not resolve.
//!
//! What is left of rims in the end are short arcs, mostly of a single edge, with a pinch point at each end: folds that closed
//! beyond 180° while bending became nearly free. To open them again costs a surface more energy than it gains, so that
//! steps do not do it. But little is needed, a patch of a few faces whose frames forget the fold.

use super::phase::Phase;
use super::relaxation::Relaxation;
use crate::evolve::error::EvolveError;
use crate::evolve::progress::Observer;
use crate::frames::{flip_along_rims, smooth_patch};
use crate::mesh::EdgeId;
use crate::tuning::{MENDING_STEPS, PATCH_RINGS};

impl Relaxation {
    /// After all phases: while there are rims, turns signs along them, makes patches around them smooth, each larger than
    /// the one before, and takes some steps of the last phase. What does not lead to fewer or shorter rims is taken back.
    pub(super) fn mend(&mut self, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let Some((last, _)) = self.phases.split_last() else { return Ok(()) };
        let most = MENDING_STEPS.clamp(last.min_steps, last.max_steps);
        let phase = Phase { max_steps: most, untangle_steps: 0, ..*last };
        let mut rims = self.rims_now();
        for rings in PATCH_RINGS {
            if rims.is_empty() {
                break;
            }
            let (before, was_settled) = (self.state.face_frames().to_vec(), self.cursor.settled);
            self.forget_folds(&rims, rings);
            self.cursor = self.cursor.at_start_of(self.phases.len() - 1);
            self.run(&phase, most, observer)?;
            self.cursor = self.cursor.at_start_of(self.phases.len());
            let now = self.rims_now();
            if self.weight(&now) < self.weight(&rims) {
                rims = now;
            } else {
                self.state.set_face_frames(before);
                self.cursor.settled = was_settled;
            }
        }
        Ok(())
    }

    fn forget_folds(&mut self, rims: &[EdgeId], rings: usize) {
        let metric = self.state.metric().clone();
        let (shell, frames) = self.state.shell_and_frames();
        flip_along_rims(shell, metric.edge_lengths(), frames);
        smooth_patch(shell, rims, rings, frames);
    }

    /// Rims of the surface as it is, in order.
    pub(super) fn rims_now(&self) -> Vec<EdgeId> {
        self.state.rims_at(&self.state.integrate())
    }

    /// How many rims, and how long they are in all.
    fn weight(&self, rims: &[EdgeId]) -> (usize, f64) {
        (rims.len(), rims.iter().map(|rim| self.state.metric().length(*rim)).sum())
    }
}
