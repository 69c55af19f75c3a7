//! What frames alone say: where detail remains hidden, and how far they turn.

use super::TASK;
use crate::algebra::inner_product;
use crate::frames::Shell;
use crate::mesh::EdgeId;
use glam::DQuat;
use rayon::prelude::*;

/// Edges with rim bit 1 (Def. 4.1): frames in opposite hemispheres after transport.
pub fn rims(shell: &Shell, frames: &[DQuat]) -> Vec<EdgeId> {
    let hinges = shell.hinges().par_iter().with_min_len(TASK);
    hinges.filter(|hinge| hinge.is_rim(frames)).map(|hinge| hinge.edge).collect()
}

/// Mean turn between two fields of unit frames in radians, weighted by area.
pub fn mean_turn(shell: &Shell, before: &[DQuat], after: &[DQuat]) -> f64 {
    // |λ' − λ| = 2 sin(α/4), since quaternions turn by half the angle.
    let turn = |(a, b): (&DQuat, &DQuat)| 4.0 * libm::asin((0.5 * (*b - *a).length()).min(1.0));
    let turns: Vec<f64> = before.par_iter().with_min_len(TASK).zip(after).map(turn).collect();
    let total = inner_product(&turns, shell.face_areas(), |turn, area| turn * area);
    total / (shell.mean_face_area() * shell.face_count() as f64)
}
