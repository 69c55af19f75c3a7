//! Measures of a surface that did not come out of a simulation.

use glam::{DQuat, DVec3};
use immerse::Metric;
use immerse::evolve::{FrameReport, NO_CLASS};
use immerse::frames::Shell;
use immerse::immersion::{class_of_positions, length_error, pinch_points, rimless_frames};
use immerse::mesh::{EdgeId, Mesh};
use immerse::spin::{Homology, SpinStructure};

/// What positions are worth: lengths, pinch points, class, and the rims that they have in the class of a spin structure.
pub fn report_of(mesh: &Mesh, metric: &Metric, spin: &SpinStructure, positions: &[DVec3]) -> FrameReport {
    let error = length_error(mesh, metric, positions);
    let homology = Homology::new(mesh, metric);
    let class = class_of_positions(mesh, &homology, positions);
    let pinches = pinch_points(mesh, positions).len();
    FrameReport {
        l2_length_error: error.l2,
        max_length_error: error.max,
        median_length_error: error.median,
        p95_length_error: error.p95,
        rims: rims_of(mesh, metric, spin, positions).len(),
        pinch_points: pinches,
        spin_class: if pinches == 0 { class.to_string() } else { NO_CLASS.into() },
        ..FrameReport::default()
    }
}

/// Edges with rim bit 1 of positions in a spin structure. Signs of frames are free: they are chosen along a tree of faces, and
/// then face by face such that there are fewer rims.
pub fn rims_of(mesh: &Mesh, metric: &Metric, spin: &SpinStructure, positions: &[DVec3]) -> Vec<EdgeId> {
    let Ok(shell) = Shell::new(mesh, metric, spin, None) else { return Vec::new() };
    let mut frames = rimless_frames(mesh, metric, &shell, positions);
    shorten(&shell, &mut frames);
    shell.hinges().iter().filter(|hinge| hinge.is_rim(&frames)).map(|hinge| hinge.edge).collect()
}

/// Turns the sign of faces most of whose hinges are rims, until there is none.
fn shorten(shell: &Shell, frames: &mut [DQuat]) {
    let mut turned = true;
    while turned {
        turned = false;
        for face in 0..frames.len() {
            let hinges = || shell.face_hinges()[face].iter().flatten();
            let rims = hinges().filter(|(hinge, _)| shell.hinges()[*hinge as usize].is_rim(frames)).count();
            if 2 * rims > hinges().count() {
                frames[face] = -frames[face];
                turned = true;
            }
        }
    }
}
