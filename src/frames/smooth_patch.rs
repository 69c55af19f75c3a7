//! Frames of a patch anew, as smooth as those around it allow.

use super::shell::{Hinge, Shell};
use crate::mesh::{EdgeId, FaceId};
use glam::{DQuat, DVec4};

/// Sweeps over a patch: its means travel one face a sweep, and have to get across it and back.
const LEAST_SWEEPS: usize = 4;

/// Gives all faces at most so many edges away from those at the edges `around` (in order) the means of the frames of their
/// neighbours, again and again, while frames outside of the patch stay. `frames` are all of the shell, |F|.
pub fn smooth_patch(shell: &Shell, around: &[EdgeId], rings: usize, frames: &mut [DQuat]) {
    let patch = faces_around(shell, around, rings);
    for _ in 0..(rings * rings).max(LEAST_SWEEPS) {
        for &face in &patch {
            let seen = neighbours(shell, face).map(|(hinge, is_i)| {
                let frame = match is_i {
                    true => hinge.transport.conjugate() * frames[hinge.j.index()],
                    false => hinge.transport * frames[hinge.i.index()],
                };
                frame * hinge.weight
            });
            let mean: DQuat = seen.fold(DQuat::from_vec4(DVec4::ZERO), |sum, frame| sum + frame);
            // Neighbours that are wholly at odds have none.
            if mean.length_squared() > f64::EPSILON {
                frames[face] = mean.normalize();
            }
        }
    }
}

/// Hinges of a face, and whether it is their side `i`.
fn neighbours(shell: &Shell, face: usize) -> impl Iterator<Item = (&Hinge, bool)> {
    shell.face_hinges()[face].iter().flatten().map(|&(hinge, is_i)| (&shell.hinges()[hinge as usize], is_i))
}

/// Faces at most so many edges away from those at the edges, nearest first.
fn faces_around(shell: &Shell, edges: &[EdgeId], rings: usize) -> Vec<usize> {
    let mut is_in = vec![false; shell.face_count()];
    let mut patch = Vec::new();
    let mut take = |face: FaceId, patch: &mut Vec<usize>| {
        if !std::mem::replace(&mut is_in[face.index()], true) {
            patch.push(face.index());
        }
    };
    let is_there = |hinge: &&Hinge| edges.binary_search(&hinge.edge).is_ok();
    shell.hinges().iter().filter(is_there).flat_map(|hinge| [hinge.i, hinge.j]).for_each(|face| take(face, &mut patch));
    let mut begin = 0;
    for _ in 0..rings {
        let end = patch.len();
        for k in begin..end {
            for (hinge, is_i) in neighbours(shell, patch[k]) {
                take(if is_i { hinge.j } else { hinge.i }, &mut patch);
            }
        }
        begin = end;
    }
    patch
}
