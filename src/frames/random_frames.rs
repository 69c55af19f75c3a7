//! Random frames to start from.

use glam::DQuat;
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
