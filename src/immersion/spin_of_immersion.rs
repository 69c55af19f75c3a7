//! Frames and spin structure of given positions (Sec. 4.1.1, 4.1.2).

use super::polar::frames_of_positions;
use crate::algebra::Complex;
use crate::frames::Shell;
use crate::mesh::Mesh;
use crate::metric::Metric;
use crate::spin::{SpinError, SpinStructure};
use glam::{DQuat, DVec3};
use std::collections::VecDeque;

/// The spin structure in whose class the given map is (Sec. 4.1.2): signs of τ such that its frames have no rims.
///
/// # Errors
/// [`SpinError::NotAnImmersion`] if vertex stars are figure-8 under the map.
pub fn spin_of_immersion(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> Result<SpinStructure, SpinError> {
    let frames = frames_of_positions(mesh, metric, positions, &vec![DQuat::IDENTITY; mesh.face_count()]);
    let transports = mesh
        .edges()
        .map(|e| match mesh.edge_sides(e) {
            None => Complex::ONE,
            Some([h, twin]) => {
                let tau = metric.transport(h, twin);
                let agreement = frames[twin.face().index()].dot(tau * frames[h.face().index()]);
                if agreement < 0.0 { -tau } else { tau }
            }
        })
        .collect();
    let spin = SpinStructure::of_known(transports);
    match spin.figure_8_vertices(mesh, metric).len() {
        0 => Ok(spin),
        pinch_points => Err(SpinError::NotAnImmersion { pinch_points }),
    }
}

/// Frames of positions with signs such that no rims lie on a spanning tree of the faces (Sec. 4.1.1): none at all
/// if the map is in the class of the shell.
pub fn rimless_frames(mesh: &Mesh, metric: &Metric, shell: &Shell, positions: &[DVec3]) -> Vec<DQuat> {
    let mut frames = frames_of_positions(mesh, metric, positions, &vec![DQuat::IDENTITY; mesh.face_count()]);
    let mut seen = vec![false; frames.len()];
    for root in 0..frames.len() {
        if std::mem::replace(&mut seen[root], true) {
            continue;
        }
        let mut queue = VecDeque::from([root]);
        while let Some(f) = queue.pop_front() {
            for &(index, is_i) in shell.face_hinges()[f].iter().flatten() {
                let hinge = shell.hinges()[index as usize];
                let g = if is_i { hinge.j.index() } else { hinge.i.index() };
                if std::mem::replace(&mut seen[g], true) {
                    continue;
                }
                if hinge.is_rim(&frames) {
                    frames[g] = -frames[g];
                }
                queue.push_back(g);
            }
        }
    }
    frames
}
