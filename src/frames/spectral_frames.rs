//! Frames to start from that are the lowest modes of the connection Laplacian.

use super::energy::strains;
use super::random_frames::random_frames;
use super::shell::Shell;
use super::system::{self, State, System};
use crate::algebra::{BlockVector, Complex, ConjugateGradient, IncompleteCholesky, quaternion};
use glam::{DMat4, DQuat, DVec4};

/// The two lowest modes a, b of the connection Laplacian (Eq. 12) as λ = a + b j, made unit in every face.
///
/// The Laplacian is complex linear, so a quaternion field carries two of its modes. They have to be different ones:
/// frames made of one mode alone have one normal everywhere. On a sphere they are the round immersion. With target
/// bending angles the Laplacian is quaternionic and its lowest mode serves as it is.
pub fn spectral_frames(shell: &Shell) -> Vec<DQuat> {
    // Inverse iteration. In the gauge of frames that are all 1 the matrix is that of Eq. 12 itself, and with
    // ε = (1, 1, 1, 1) it does not depend on midframes.
    let gauge = vec![DQuat::IDENTITY; shell.face_count()];
    let dt = INVERSE_SHIFT * shell.mean_face_area();
    let state = State { shell, stiffness: [1.0; 4], crease: 0.0, dt, frames: &gauge, lengths: None };
    let pattern = system::pattern(shell);
    let mut system = System::<DMat4>::default();
    system.assemble(&pattern, &state);
    let mut factor = IncompleteCholesky::default();
    factor.factorize(&pattern, &system.matrix);
    let mut solver = ConjugateGradient::default();
    let (mut weighted, mut solution) = (BlockVector::default(), BlockVector::default());
    let is_complex = shell.hinges().iter().all(|hinge| hinge.transport == hinge.spin.quaternion());
    let mut mode: Vec<DVec4> = random_frames(shell.face_count(), 0).into_iter().map(DVec4::from).collect();
    for _ in 0..INVERSE_STEPS {
        weighted.set(&pattern, |face| mode[face] * shell.face_areas()[face]);
        // From zero, not from the mode: the residual of the mode is larger than the right side by far.
        solver.solve(&pattern, &system.matrix, &factor, &weighted, &mut solution, 1e-8, 5000);
        let mut next: Vec<DVec4> = (0..mode.len()).map(|face| solution.at(&pattern, face)).collect();
        if is_complex {
            separate(&mut next, shell.face_areas());
        }
        let norm = (next.iter().map(|x| x.length_squared()).sum::<f64>() / next.len() as f64).sqrt();
        next.iter_mut().for_each(|x| *x /= norm);
        let change = mode.iter().zip(&next).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / next.len() as f64;
        mode = next;
        if change < 1e-12 {
            break;
        }
    }
    let mut frames: Vec<DQuat> =
        mode.into_iter().map(|x| quaternion::normalized(DQuat::from_vec4(x)).unwrap_or(DQuat::IDENTITY)).collect();
    if is_complex {
        turn_torsion_into_bending(shell, &mut frames);
    }
    frames
}

/// Modes are known up to a phase, λ ↦ exp(iθ) λ, which turns every face in its plane and takes bending and torsion
/// ζ + iσ to exp(2iθ) (ζ + iσ). The phase of least torsion is taken, and of its two the one of positive bending,
/// which faces outward on a sphere.
fn turn_torsion_into_bending(shell: &Shell, frames: &mut [DQuat]) {
    let weighted: Vec<(f64, Complex)> = strains(shell, frames)
        .into_iter()
        .zip(shell.hinges())
        .map(|([bending, _, torsion], hinge)| (hinge.weight, Complex { re: bending, im: torsion }))
        .collect();
    let sum = |value: &dyn Fn(Complex) -> f64| weighted.iter().map(|(w, strain)| w * value(*strain)).sum::<f64>();
    let squares = Complex { re: sum(&|z| (z * z).re), im: sum(&|z| (z * z).im) };
    let double = Complex::from_angle(-0.5 * squares.angle());
    let double = if sum(&|z| (double * z).re) < 0.0 { -double } else { double };
    let phase = Complex::from_angle(0.5 * double.angle());
    frames.iter_mut().for_each(|frame| *frame = phase * *frame);
}

/// Makes a and b of λ = a + b j orthogonal, with respect to face areas, and of equal norm.
fn separate(mode: &mut [DVec4], areas: &[f64]) {
    let parts = |x: DVec4| (Complex { re: x.w, im: x.x }, Complex { re: x.y, im: x.z });
    let (mut aa, mut ab_re, mut ab_im) = (0.0, 0.0, 0.0);
    for (x, area) in mode.iter().zip(areas) {
        let (a, b) = parts(*x);
        let product = a.conjugate() * b;
        aa += area * a.length_squared();
        ab_re += area * product.re;
        ab_im += area * product.im;
    }
    let along = Complex { re: ab_re / aa, im: ab_im / aa };
    let mut bb = 0.0;
    for (x, area) in mode.iter_mut().zip(areas) {
        let excess = along * parts(*x).0;
        x.y -= excess.re;
        x.z -= excess.im;
        bb += area * (x.y * x.y + x.z * x.z);
    }
    let scale = (aa / bb).sqrt();
    for x in mode {
        x.y *= scale;
        x.z *= scale;
    }
}

/// Inverse of the shift in units of the mean face area: far above the diameter of any mesh squared.
const INVERSE_SHIFT: f64 = 1e8;
const INVERSE_STEPS: usize = 60;
