//! Flat disks.

use std::f64::consts::TAU;

use glam::DVec3;

use super::limits::{LEAST_RINGS, at_least, face_count, positive};
use crate::mesh::{MeshError, Surface};

/// A disk in the xy plane: a centre and `rings` rings, ring `k` with `6 k` vertices at distance
/// `k / rings * radius`; `6 rings²` faces, connected like a hexagon of the triangular lattice.
///
/// # Errors
/// [`MeshError::Shape`] for a radius that is not positive, or no rings.
pub fn disk(radius: f64, rings: usize) -> Result<Surface, MeshError> {
    positive("disk", "radius", radius)?;
    at_least("disk", "rings", rings, LEAST_RINGS)?;
    face_count("disk", "rings", 6.0 * (rings as f64) * (rings as f64), "lower `rings`")?;
    let mut positions = vec![DVec3::ZERO];
    for k in 1..=rings {
        let r = radius * k as f64 / rings as f64;
        for m in 0..6 * k {
            let (sin, cos) = libm::sincos(TAU * m as f64 / (6 * k) as f64);
            positions.push(DVec3::new(r * cos, r * sin, 0.0));
        }
    }
    // Rings 1 to k − 1 have 3 k (k − 1) vertices together.
    let vertex = |k: usize, m: usize| if k == 0 { 0 } else { (1 + 3 * k * (k - 1) + m % (6 * k)) as u32 };
    let mut faces = Vec::with_capacity(6 * rings * rings);
    for k in 1..=rings {
        for sector in 0..6 {
            for t in 0..k {
                let outer = |t: usize| vertex(k, sector * k + t);
                let inner = |t: usize| vertex(k - 1, sector * (k - 1) + t);
                faces.push([inner(t), outer(t), outer(t + 1)]);
                if t + 1 < k {
                    faces.push([inner(t), outer(t + 1), inner(t + 1)]);
                }
            }
        }
    }
    Surface::from_positions(positions, &faces)
}
