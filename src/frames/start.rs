//! Frames to start from.

use super::Shell;
use super::system::{self, System};
use crate::algebra::{ConjugateGradient, quaternion};
use glam::{DQuat, DVec4};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Independent frames, uniform on the unit sphere of the quaternions, the same for the same seed everywhere.
pub fn random_frames(count: usize, seed: u64) -> Vec<DQuat> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    // Marsaglia's method: two points in the unit disk give a point on the 3-sphere.
    let mut disk_point = move || loop {
        let mut coordinate = || (rng.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
        let (x, y) = (coordinate(), coordinate());
        let s = x * x + y * y;
        if s < 1.0 && s > 0.0 {
            return (x, y, s);
        }
    };
    (0..count)
        .map(|_| {
            let (x, y, s) = disk_point();
            let (u, v, t) = disk_point();
            let scale = ((1.0 - s) / t).sqrt();
            DQuat::from_xyzw(x, y, u * scale, v * scale)
        })
        .collect()
}

/// The lowest mode of the connection Laplacian (Eq. 12), made unit in every face.
///
/// On a sphere it is the round immersion. On a flat surface whose class admits a constant frame it is that
/// frame, which collapses the surface to its periods; random frames are the better start there.
pub fn spectral_frames(shell: &Shell) -> Vec<DQuat> {
    // Inverse iteration. In the gauge of frames that are all 1 the matrix is that of Eq. 12 itself, and with
    // ε = (1, 1, 1, 1) it does not depend on midframes.
    let gauge = vec![DQuat::IDENTITY; shell.face_count()];
    let mut system = System::default();
    system.assemble(shell, [1.0; 4], 0.0, INVERSE_SHIFT * shell.mean_face_area(), &gauge);
    let pattern = system::pattern(shell);
    let mut solver = ConjugateGradient::default();
    let mut mode: Vec<DVec4> = random_frames(shell.face_count(), 0).into_iter().map(DVec4::from).collect();
    for _ in 0..INVERSE_STEPS {
        let weighted: Vec<DVec4> = mode.iter().zip(&shell.face_areas).map(|(x, area)| *x * *area).collect();
        let mut next = mode.clone();
        solver.solve(&pattern, &system.matrix, &weighted, &mut next, 1e-8, 5000);
        let norm = (next.iter().map(|x| x.length_squared()).sum::<f64>() / next.len() as f64).sqrt();
        next.iter_mut().for_each(|x| *x /= norm);
        let change = mode.iter().zip(&next).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / next.len() as f64;
        mode = next;
        if change < 1e-12 {
            break;
        }
    }
    mode.into_iter().map(|x| quaternion::normalized(DQuat::from_vec4(x)).unwrap_or(DQuat::IDENTITY)).collect()
}

/// Inverse of the shift in units of the mean face area: far above the diameter of any mesh squared.
const INVERSE_SHIFT: f64 = 1e8;
const INVERSE_STEPS: usize = 60;
