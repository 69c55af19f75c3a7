//! No folds that the metric does not ask for.
//!
//! With the ε₁ of the last phase, which is nearly nothing, a dent or a pleat costs next to no energy. Where a program
//! asks for no folds, the frames of a film are therefore settled twice: first with as large an ε₁ as their lengths allow,
//! which smooths out what the metric does not ask for, then with that of the phase, which takes out the length error
//! that stiffness makes. A film begins at the largest ε₁ and comes down when a frame would not have its lengths
//! otherwise, to stay there: what can be smooth is smooth, and what must crumple is soon where it would be without.
//! A surface of convex metric that has dents all the same is ironed.

use super::phase::Phase;
use super::relaxation::Relaxation;
use crate::evolve::error::EvolveError;
use crate::evolve::pace::Settling;
use crate::evolve::progress::Observer;
use crate::immersion::{is_convex, largest_dent};
use crate::tuning::{DENT_DEPTH, IRONING_BENDING, STEPS_ON_THE_WAY, STIFF_LENGTH_ERROR, STIFFER_BENDING};
use glam::DVec3;

impl Relaxation {
    /// Steps at the time of a frame until it has settled, as stiff as it may be at first.
    pub fn settle(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        self.come_down(settling, observer)?;
        if self.is_dented() {
            self.iron(settling, observer)?;
        }
        Ok(())
    }

    /// As after all phases: takes out what dents a convex metric does not ask for.
    pub fn take_out_dents(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let cursor = self.cursor;
        if self.is_dented() {
            self.iron(settling, observer)?;
            self.cursor.level = cursor.level;
        }
        Ok(())
    }

    /// A few steps at a time that is only passed.
    pub fn pass(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let phases_done = self.phases.len();
        self.cursor = self.cursor.at_start_of(phases_done);
        self.run(&self.following_phase(settling), STEPS_ON_THE_WAY, observer)?;
        self.cursor = self.cursor.at_start_of(phases_done);
        Ok(())
    }

    /// The phase that a film is in now.
    fn following_phase(&self, settling: &Settling) -> Phase {
        let mut phase = settling.phase(&self.phases);
        if self.is_smooth {
            let own = phase.stiffness[1];
            phase.stiffness[1] = STIFFER_BENDING.get(self.cursor.level).map_or(own, |stiffer| own.max(*stiffer));
        }
        phase
    }

    fn come_down(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        while self.is_smooth && self.cursor.level < STIFFER_BENDING.len() {
            let before = self.state.face_frames().to_vec();
            self.run_to_rest(&self.following_phase(settling), settling, observer)?;
            if self.length_error_now() <= STIFF_LENGTH_ERROR {
                break;
            }
            // What a surface has of folds that its metric asks for would not come back the same.
            self.state.set_face_frames(before);
            self.cursor.level += 1;
        }
        self.run_to_rest(&settling.phase(&self.phases), settling, observer)
    }

    fn iron(&mut self, settling: &Settling, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let mut phase = settling.phase(&self.phases);
        phase.stiffness[1] = IRONING_BENDING;
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
        self.run(phase, settling.max_steps(), observer)?;
        self.cursor = self.cursor.at_start_of(phases_done);
        Ok(())
    }

    fn length_error_now(&self) -> f64 {
        self.state.length_error_at(&self.state.integrate())
    }

    /// Whether the metric is convex and the surface is not.
    fn is_dented(&self) -> bool {
        let radius = (self.state.metric().total_area() / (4.0 * std::f64::consts::PI)).sqrt();
        self.is_smooth && self.dent(&self.state.integrate()).is_some_and(|depth| depth > DENT_DEPTH * radius)
    }

    /// Depth of the largest inward dent of a convex metric.
    pub fn dent(&self, positions: &[DVec3]) -> Option<f64> {
        is_convex(self.state.mesh(), self.state.metric()).then(|| largest_dent(positions))
    }
}
