//! THE step, Algorithm 8: frames along the gradient, the surface they integrate to, frames toward its own.

use super::phase::Phase;
use super::relaxation::Relaxation;
use crate::algebra::SolveReport;
use crate::frames::Shell;
use crate::immersion::{edge_vectors, frames_of_edge_vectors, mean_turn, rims};
use glam::{DQuat, DVec3};
use rayon::prelude::*;

/// What a step did.
pub(super) struct Step {
    /// The frames it began at, |F|.
    pub before: Vec<DQuat>,
    /// The surface that the new frames integrated to before they were moved toward its own, |V|.
    pub positions: Vec<DVec3>,
    /// Rims of that surface.
    pub rims: usize,
    /// Its Δt in mean face areas.
    pub dt: f64,
    /// Mean turn of the frames in radians.
    pub turn: f64,
    /// What the linear solve took.
    pub solve: SolveReport,
}

impl Relaxation {
    /// One step of a phase.
    pub(super) fn step(&mut self, phase: &Phase) -> Step {
        let before = self.state.face_frames().to_vec();
        let dt = if self.cursor.dt > 0.0 { self.cursor.dt } else { self.dt_of(phase) };
        let is_on_the_way = self.cursor.phase + 1 < self.phases.len();
        let options =
            if is_on_the_way { phase.rough_step_options(dt, self.cursor.turn) } else { phase.step_options(dt) };
        let (shell, frames) = self.state.shell_and_frames();
        let solve = self.stepper.advance(shell, &options, frames);
        self.remove_periods(phase.periods);
        let positions = self.state.integrate();
        let target = self.state.frames_at(&positions);
        let (shell, frames) = self.state.shell_and_frames();
        blend(shell, frames, &target, phase.feedback);
        let rims = rims(shell, &target).len();
        // Whether frames stand still is asked of the whole step.
        let turn = mean_turn(shell, &before, frames);
        if self.share_of_step < 1.0 {
            go_a_part(frames, &before, self.share_of_step);
        }
        Step { before, positions, rims, dt, turn, solve }
    }

    /// Moves frames toward those of their own edge vectors without the harmonic part.
    fn remove_periods(&mut self, amount: f64) {
        if amount == 0.0 {
            return;
        }
        let state = &self.state;
        let mut vectors = edge_vectors(state.mesh(), state.metric(), state.face_frames());
        let Some(harmonic) = state.harmonic_part(&vectors) else { return };
        vectors.iter_mut().zip(harmonic).for_each(|(v, h)| *v -= h);
        let target = frames_of_edge_vectors(state.mesh(), state.metric(), &vectors, state.face_frames());
        let (shell, frames) = self.state.shell_and_frames();
        blend(shell, frames, &target, amount);
    }

    /// Δt of the first step of a phase in mean face areas.
    fn dt_of(&self, phase: &Phase) -> f64 {
        phase.dt.in_face_areas(self.state.mesh().face_count())
    }
}

/// Goes back so far that this share is left of the way from where frames were before.
fn go_a_part(frames: &mut [DQuat], before: &[DQuat], share: f64) {
    let faces = frames.par_iter_mut().with_min_len(1024).zip(before);
    faces.for_each(|(frame, before)| *frame = (*before + (*frame - *before) * share).normalize());
}

/// λ ← normalize((1 − t) λ + t λ*) with 1 − t = (1 − amount)^(Ā/A), the `exp(−Δt/(a A))` of Alg. 8 with a chosen such
/// that a face of mean area Ā moves by `amount`.
fn blend(shell: &Shell, frames: &mut [DQuat], target: &[DQuat], amount: f64) {
    let rate = libm::log(1.0 - amount) * shell.mean_face_area();
    let faces = frames.par_iter_mut().with_min_len(1024).zip(target).zip(shell.face_areas());
    faces.for_each(|((frame, target), area)| {
        let stay = libm::exp(rate / area);
        *frame = (*target + (*frame - *target) * stay).normalize();
    });
}
