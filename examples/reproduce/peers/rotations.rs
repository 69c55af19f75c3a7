//! Rotations in place of quaternions, as in Wang, Liu and Tong 2012: the same frames and the same energy, blind to signs.

use super::Given;
use crate::request::Outcome;
use glam::{DQuat, DVec3};
use immerse::evolve::Schedule;
use immerse::frames::{Shell, StepOptions, Stepper, random_frames};
use immerse::immersion::{Periods, Poisson, edge_vectors, frames_of_edge_vectors, frames_of_positions, mean_turn};
use immerse::spin::{Homology, SpinStructure};

/// From random frames through the default phases. Gives positions and the number of steps.
pub fn relax(given: &Given, seed: u64) -> Outcome<(Vec<DVec3>, usize)> {
    let Given { mesh, metric, .. } = given;
    let poisson = Poisson::new(mesh, metric, &[])?;
    let periods = Periods::new(mesh, metric, &Homology::new(mesh, metric), &poisson);
    let mut frames = random_frames(mesh.face_count(), seed);
    let mut stepper = Stepper::new(&blind_shell(given, &frames)?);
    let mut positions = Vec::new();
    let mut steps = 0;
    for phase in Schedule::default().phases() {
        let options = StepOptions {
            method: phase.method,
            stiffness: phase.stiffness,
            // Creases are no part of the paper's energy, and know signs.
            crease: 0.0,
            dt: phase.dt.in_face_areas(mesh.face_count()),
            solver_tolerance: phase.solver_tolerance,
        };
        for step in 1..=phase.max_steps {
            let shell = blind_shell(given, &frames)?;
            let before = frames.clone();
            stepper.advance(&shell, &options, &mut frames);
            let mut vectors = edge_vectors(mesh, metric, &frames);
            let harmonic = periods.harmonic_part(mesh, metric, &vectors);
            vectors.iter_mut().zip(harmonic).for_each(|(v, h)| *v -= h);
            let target = frames_of_edge_vectors(mesh, metric, &vectors, &frames);
            blend(&shell, &mut frames, &target, phase.periods);
            positions = poisson.solve(mesh, metric, &edge_vectors(mesh, metric, &frames), &[]);
            let target = frames_of_positions(mesh, metric, &positions, &frames);
            blend(&shell, &mut frames, &target, phase.feedback);
            steps += 1;
            if step >= phase.min_steps && mean_turn(&shell, &before, &frames) < phase.tolerance_radians {
                break;
            }
        }
    }
    Ok((positions, steps))
}

/// The shell whose τ has at each hinge the sign with which the frames agree better.
fn blind_shell(given: &Given, frames: &[DQuat]) -> Outcome<Shell> {
    let Given { mesh, metric, spin, .. } = given;
    let mut transports = spin.transports().to_vec();
    for e in mesh.interior_edges() {
        let Some([h, twin]) = mesh.edge_sides(e) else { continue };
        let tau = transports[e.index()];
        if frames[twin.face().index()].dot(tau * frames[h.face().index()]) < 0.0 {
            transports[e.index()] = -tau;
        }
    }
    Ok(Shell::new(mesh, metric, &SpinStructure::from_transports(mesh, transports)?, None)?)
}

/// Moves frames toward others as Algorithm 8 does; a face of mean area moves by `amount`.
fn blend(shell: &Shell, frames: &mut [DQuat], target: &[DQuat], amount: f64) {
    let rate = libm::log(1.0 - amount) * shell.mean_face_area();
    for ((frame, target), area) in frames.iter_mut().zip(target).zip(shell.face_areas()) {
        *frame = (*target + (*frame - *target) * libm::exp(rate / area)).normalize();
    }
}
