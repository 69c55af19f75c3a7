//! No folds that the metric does not ask for.
//!
//! With the ε₁ of the last phase, which is nearly nothing, a dent or a pleat costs next to no energy. Where the scene
//! asks for no folds, the frames of a film are therefore settled twice: first with as large an ε₁ as their lengths allow,
//! which smooths out what the metric does not ask for, then with that of the phase, which takes out the length error
//! that stiffness makes. A film begins at the largest ε₁ and comes down when a frame would not have its lengths
//! otherwise, to stay there: what can be smooth is smooth, and what must crumple is soon where it would be without.
//! A surface of convex metric that has dents all the same is ironed.

use super::relaxation::Relaxation;
use super::{EvolveError, Observer, Phase, Settling};
use crate::immersion::{is_convex, l2_length_error, largest_dent};

/// ε₁, one for each level; the level after the last one is that of the phase itself.
const STIFFER: [f64; 2] = [5e-3, 1e-3];
/// L2 length error up to which lengths are kept well enough to stay so stiff.
const FITS: f64 = 1e-3;
/// ε₁ that dents do not withstand.
const IRON: f64 = 0.1;
/// A dent is one from this depth on, as a share of the radius of the round sphere of the same area.
const DENTED: f64 = 0.01;

impl Relaxation {
    /// Steps at the time of a frame until it has settled, as stiff as it may be at first.
    pub(super) fn settle(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        self.come_down(settling, observer)?;
        if self.is_dented() {
            self.iron(settling, observer)?;
        }
        Ok(())
    }

    /// As after all phases: takes out what dents a convex metric does not ask for.
    pub(super) fn take_out_dents(
        &mut self,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let cursor = self.cursor;
        if self.is_dented() {
            self.iron(settling, observer)?;
            self.cursor.level = cursor.level;
        }
        Ok(())
    }

    /// The phase that a film is in now.
    pub(super) fn following_phase(&self, settling: &Settling) -> Phase {
        let mut phase = settling.phase(&self.phases);
        if self.is_smooth {
            let own = phase.step.stiffness[1];
            phase.step.stiffness[1] = STIFFER.get(self.cursor.level).map_or(own, |stiffer| own.max(*stiffer));
        }
        phase
    }

    fn come_down(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        while self.is_smooth && self.cursor.level < STIFFER.len() {
            let before = self.face_frames.clone();
            self.run_to_rest(&self.following_phase(settling), settling, observer)?;
            if self.length_error_now() <= FITS {
                break;
            }
            // What a surface has of folds that its metric asks for would not come back the same.
            self.face_frames = before;
            self.cursor.level += 1;
        }
        self.run_to_rest(&settling.phase(&self.phases), settling, observer)
    }

    fn iron(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let mut phase = settling.phase(&self.phases);
        phase.step.stiffness[1] = IRON;
        self.run_to_rest(&phase, settling, observer)?;
        self.cursor.level = 0;
        self.come_down(settling, observer)
    }

    fn run_to_rest(
        &mut self,
        phase: &Phase,
        settling: &Settling,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        let phases_done = self.phases.len();
        self.cursor = self.cursor.at_start_of(phases_done);
        self.run_phase(phase, settling.max_steps, observer)?;
        self.cursor = self.cursor.at_start_of(phases_done);
        Ok(())
    }

    fn length_error_now(&self) -> f64 {
        l2_length_error(&self.component.mesh, &self.metric, &self.integrate())
    }

    /// Whether the metric is convex and the surface is not.
    fn is_dented(&self) -> bool {
        let radius = (self.metric.total_area() / (4.0 * std::f64::consts::PI)).sqrt();
        self.is_smooth && self.dent(&self.integrate()).is_some_and(|depth| depth > DENTED * radius)
    }

    /// Depth of the largest inward dent of a convex metric.
    pub(super) fn dent(&self, positions: &[glam::DVec3]) -> Option<f64> {
        is_convex(&self.component.mesh, &self.metric).then(|| largest_dent(positions))
    }
}
