//! What decides after a step: the same phase again, the next one, or the end.

use super::cursor::Cursor;
use super::phase::Phase;
use super::relaxation::Relaxation;
use super::step::Step;
use crate::evolve::error::EvolveError;
use crate::evolve::progress::{Observer, Progress};
use crate::mesh::FaceId;
use glam::DVec3;

/// How a relaxation goes on after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// With another step of the phase.
    Again,
    /// With the next phase: frames stand still, or patience is at an end.
    Next,
    /// Not at all: the surface is as accurate as was asked for.
    Done,
}

impl Relaxation {
    /// Judges a step, tells the observer of it, and moves the cursor on.
    ///
    /// # Errors
    /// [`EvolveError::Diverged`] if frames are no longer finite, [`EvolveError::Stopped`] if the observer says so.
    pub(super) fn judge(
        &mut self,
        phase: &Phase,
        step: &Step,
        observer: &mut dyn Observer,
    ) -> Result<Verdict, EvolveError> {
        self.cursor.step += 1;
        self.cursor.steps += 1;
        self.cursor.inner_iterations += step.solve.iterations;
        if !step.turn.is_finite() {
            let (frames, mesh) = (self.state.face_frames(), self.state.mesh());
            let face = frames.iter().position(|frame| !frame.is_finite()).unwrap_or(0);
            return Err(EvolveError::Diverged {
                time: self.state.time(),
                face: mesh.file_face(FaceId::new(face)),
                steps: self.cursor.steps,
                phase: self.cursor.phase,
            });
        }
        let l2_length_error = self.state.length_error_at(&step.positions);
        let is_accurate = self.is_accurate(l2_length_error, &step.positions);
        let stands_still =
            self.cursor.step >= phase.min_steps && step.turn < phase.tolerance_radians && phase.may_settle(step.dt);
        let max_steps = self.patience(phase, &step.positions);
        let progress = Progress {
            frame: self.frame,
            component: self.among.number,
            components: self.among.of,
            phase: self.cursor.phase,
            phases: self.phases.len(),
            restarts: self.cursor.restarts,
            step: self.cursor.step,
            max_steps,
            turn: step.turn.to_degrees(),
            tolerance: phase.tolerance_radians.to_degrees(),
            settled: stands_still || is_accurate,
            l2_length_error,
            rims: step.rims,
            inner_iterations: step.solve.iterations,
        };
        if observer.after_step(&progress).is_break() {
            return Err(EvolveError::Stopped { steps: self.cursor.steps });
        }
        self.cursor.turn = step.turn;
        if is_accurate {
            self.cursor = Cursor { settled: true, ..self.cursor.at_start_of(self.phases.len()) };
            return Ok(Verdict::Done);
        }
        if stands_still || self.cursor.step >= max_steps {
            self.cursor = Cursor { settled: stands_still, ..self.cursor.at_start_of(self.cursor.phase + 1) };
            return Ok(Verdict::Next);
        }
        if phase.turn_radians.is_some() {
            self.cursor.dt = phase.next_dt(step.dt, step.turn);
        }
        Ok(Verdict::Again)
    }

    /// Whether these positions are as close to the metric as was asked for, without rims.
    fn is_accurate(&self, l2_length_error: f64, positions: &[DVec3]) -> bool {
        self.accuracy.is_some_and(|most| l2_length_error <= most) && self.state.rims_at(positions).is_empty()
    }

    /// How many steps the phase may take, from what is known now: more while there are rims.
    fn patience(&self, phase: &Phase, positions: &[DVec3]) -> usize {
        let is_late = self.cursor.step >= phase.max_steps && phase.untangle_steps > 0;
        let may_take_longer = is_late && !self.state.rims_at(positions).is_empty();
        if may_take_longer { phase.max_steps.saturating_add(phase.untangle_steps) } else { phase.max_steps }
    }
}
