//! Algorithm 2: phases of steps until frames stand still.

use super::acceleration::Acceleration;
use super::control::Verdict;
use super::phase::Phase;
use super::relaxation::Relaxation;
use crate::evolve::error::EvolveError;
use crate::evolve::progress::Observer;

impl Relaxation {
    /// Lines 7 to 9 of Algorithm 2: relaxes the frames through all phases that are left. Where rims stay and the start
    /// was random, patches around them are mended, and if that does not help either, it goes on from other random frames.
    pub fn relax(&mut self, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        while self.is_on_the_way() {
            self.advance(usize::MAX, observer)?;
            if self.draws.is_some() {
                self.mend(observer)?;
                self.draw_anew_if_tangled();
            }
        }
        self.turn_the_right_side_out();
        Ok(())
    }

    /// Relaxes the frames by so many steps, or by fewer until all phases are done.
    pub fn advance(&mut self, steps: usize, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let mut left = steps;
        while left > 0
            && let Some(phase) = self.phases.get(self.cursor.phase).copied()
        {
            left -= self.run(&phase, left, observer)?;
        }
        Ok(())
    }

    /// As [`Relaxation::advance`], each step only so far as this share of what it is.
    pub fn advance_by_part(
        &mut self,
        steps: usize,
        share: f64,
        observer: &mut dyn Observer,
    ) -> Result<(), EvolveError> {
        self.share_of_step = share;
        let outcome = self.advance(steps, observer);
        self.share_of_step = 1.0;
        outcome
    }

    /// Takes steps of one phase until it ends, at most so many. Returns how many it took.
    pub(super) fn run(
        &mut self,
        phase: &Phase,
        most: usize,
        observer: &mut dyn Observer,
    ) -> Result<usize, EvolveError> {
        let mut acceleration = Acceleration::default();
        for taken in 1..=most {
            let step = self.step(phase);
            match self.judge(phase, &step, observer)? {
                Verdict::Again if phase.accelerate && self.share_of_step == 1.0 => {
                    acceleration.correct(&step.before, self.state.shell_and_frames().1);
                }
                Verdict::Again => {}
                Verdict::Next | Verdict::Done => return Ok(taken),
            }
        }
        Ok(most)
    }
}
