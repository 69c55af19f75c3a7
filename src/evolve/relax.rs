//! The relaxation: phases, THE step, and when it ends.

use super::acceleration::Acceleration;
use super::relaxation::Relaxation;
use super::{Cursor, EvolveError, Observer, Phase, Progress};
use crate::algebra::SolveReport;
use crate::frames::{Shell, random_frames};
use crate::immersion::*;
use glam::{DQuat, DVec3};
use rayon::prelude::*;

/// How often frames are drawn anew at most.
pub const MAX_RESTARTS: usize = 8;

impl Relaxation {
    /// Lines 7 to 9 of Algorithm 2: relaxes the frames through all phases.
    pub(super) fn run_all_phases(&mut self, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        while self.cursor.phase < self.phases.len() {
            self.run_steps(usize::MAX, observer)?;
            self.draw_anew_if_tangled();
        }
        self.turn_the_right_side_out();
        Ok(())
    }

    /// Relaxes the frames by some steps, or until all phases are done.
    pub(super) fn run_steps(&mut self, steps: usize, observer: &mut dyn Observer) -> Result<(), EvolveError> {
        let mut left = steps;
        while left > 0
            && let Some(phase) = self.phases.get(self.cursor.phase).copied()
        {
            left -= self.run_phase(&phase, left, observer)?;
        }
        Ok(())
    }

    /// Takes the last phase up again if it is over.
    pub(super) fn stay_in_last_phase(&mut self) {
        if self.cursor.phase >= self.phases.len() {
            self.cursor = self.cursor.at_start_of(self.phases.len().saturating_sub(1));
        }
    }

    /// At most `left` steps of a phase; says how many were taken, and moves the cursor on when the phase is done.
    pub(super) fn run_phase(
        &mut self,
        phase: &Phase,
        left: usize,
        observer: &mut dyn Observer,
    ) -> Result<usize, EvolveError> {
        let mut acceleration = Acceleration::default();
        for taken in 1..=left {
            let before = self.face_frames.clone();
            let dt = if self.cursor.dt > 0.0 { self.cursor.dt } else { phase.step.dt };
            let (positions, solve) = self.step(phase, dt);
            self.cursor.step += 1;
            self.cursor.steps += 1;
            let turn = mean_turn(&self.parts.shell, &before, &self.face_frames);
            if !turn.is_finite() {
                return Err(EvolveError::Diverged { steps: self.cursor.steps, phase: self.cursor.phase });
            }
            let l2_length_error = l2_length_error(&self.component.mesh, &self.metric, &positions);
            let reached = self.is_accurate(l2_length_error, &positions);
            let settled = self.cursor.step >= phase.min_steps && turn < phase.tolerance_radians && phase.may_settle(dt);
            let max_steps = self.patience(phase, &positions);
            let progress = Progress {
                frame: self.frame,
                component: self.number,
                components: self.of,
                phase: self.cursor.phase,
                phases: self.phases.len(),
                restarts: self.cursor.restarts,
                step: self.cursor.step,
                max_steps,
                turn: turn.to_degrees(),
                tolerance: phase.tolerance_radians.to_degrees(),
                settled: settled || reached,
                l2_length_error,
                inner_iterations: solve.iterations,
            };
            if observer.after_step(&progress).is_break() {
                return Err(EvolveError::Stopped { steps: self.cursor.steps });
            }
            self.cursor.turn = turn;
            if reached {
                self.cursor = Cursor { settled: true, ..self.cursor.at_start_of(self.phases.len()) };
                return Ok(taken);
            }
            if settled || self.cursor.step >= max_steps {
                self.cursor = Cursor { settled, ..self.cursor.at_start_of(self.cursor.phase + 1) };
                return Ok(taken);
            }
            if phase.turn_radians.is_some() {
                self.cursor.dt = phase.next_dt(dt, turn);
            }
            if phase.accelerate {
                acceleration.correct(&before, &mut self.face_frames);
            }
        }
        Ok(left)
    }

    /// Whether these positions are as close to the metric as the scene asks for, without rims.
    fn is_accurate(&self, l2_length_error: f64, positions: &[DVec3]) -> bool {
        self.accuracy.is_some_and(|most| l2_length_error <= most) && self.rims_at(positions) == 0
    }

    /// How many steps the phase may take, from what is known now: more while there are rims.
    fn patience(&self, phase: &Phase, positions: &[DVec3]) -> usize {
        let longer = self.cursor.step >= phase.max_steps && phase.untangle_steps > 0 && self.rims_at(positions) > 0;
        if longer { phase.max_steps + phase.untangle_steps } else { phase.max_steps }
    }

    /// Rims that are left in the end do not resolve any more; other random frames may do without them. When all
    /// attempts are used up, the one with the fewest rims is kept.
    fn draw_anew_if_tangled(&mut self) {
        let Some(seed) = self.seed else { return };
        let tangles = self.rims_at(&self.integrate());
        if self.fewest_rims.as_ref().is_none_or(|(fewest, _)| tangles < *fewest) {
            self.fewest_rims = Some((tangles, self.face_frames.clone()));
        }
        if tangles > 0 && self.cursor.restarts < MAX_RESTARTS {
            self.cursor = Cursor { restarts: self.cursor.restarts + 1, ..self.cursor.at_start_of(0) };
            // Seeds of restarts are far from those that users write.
            self.face_frames =
                random_frames(self.component.mesh.face_count(), seed ^ (self.cursor.restarts as u64) << 32);
        } else if let Some((_, frames)) = self.fewest_rims.take() {
            self.face_frames = frames;
        }
    }

    /// The number of rims of the surface at these positions.
    fn rims_at(&self, positions: &[DVec3]) -> usize {
        let frames = frames_of_positions(&self.component.mesh, &self.metric, positions, &self.face_frames);
        rims(&self.parts.shell, &frames).len()
    }

    /// THE step (Alg. 8): frames along the gradient, the surface they integrate to, frames toward its own.
    /// Returns the positions of that surface, and what the linear solve took.
    fn step(&mut self, phase: &Phase, dt: f64) -> (Vec<DVec3>, SolveReport) {
        let is_on_the_way = self.cursor.phase + 1 < self.phases.len();
        let options = phase.options(dt, is_on_the_way, self.cursor.turn);
        let report = self.stepper.advance(&self.parts.shell, &options, &mut self.face_frames);
        self.remove_periods(phase.periods);
        let positions = self.integrate();
        let target = frames_of_positions(&self.component.mesh, &self.metric, &positions, &self.face_frames);
        blend(&self.parts.shell, &mut self.face_frames, &target, phase.feedback);
        (positions, report)
    }

    /// Moves frames toward those of their own edge vectors without the harmonic part.
    fn remove_periods(&mut self, amount: f64) {
        let periods = &self.parts.periods;
        if amount > 0.0 && !periods.is_empty() {
            let mut vectors = edge_vectors(&self.component.mesh, &self.metric, &self.face_frames);
            let harmonic = periods.harmonic_part(&self.component.mesh, &self.metric, &vectors);
            vectors.iter_mut().zip(harmonic).for_each(|(v, h)| *v -= h);
            let target = frames_of_edge_vectors(&self.component.mesh, &self.metric, &vectors, &self.face_frames);
            blend(&self.parts.shell, &mut self.face_frames, &target, amount);
        }
    }

    /// Algorithm 7: positions from the averaged edge vectors.
    pub(super) fn integrate(&self) -> Vec<DVec3> {
        let vectors = edge_vectors(&self.component.mesh, &self.metric, &self.face_frames);
        self.parts.poisson.solve(&self.component.mesh, &self.metric, &vectors, &self.places)
    }
}

/// λ ← normalize((1 − t) λ + t λ*) with 1 − t = (1 − amount)^(Ā/A), the `exp(−Δt/(a A))` of Alg. 8 with a chosen such
/// that a face of mean area Ā moves by `amount`.
fn blend(shell: &Shell, frames: &mut [DQuat], target: &[DQuat], amount: f64) {
    let rate = libm::log(1.0 - amount) * shell.mean_face_area();
    let faces = frames.par_iter_mut().with_min_len(1024).zip(target).zip(&shell.face_areas);
    faces.for_each(|((frame, target), area)| {
        let stay = libm::exp(rate / area);
        *frame = (*target + (*frame - *target) * stay).normalize();
    });
}
