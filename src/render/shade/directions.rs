//! Directions around a normal, spread evenly.

use glam::Vec3A;

/// The normal on one side (0 front, 1 back).
pub fn side_normal(normal: Vec3A, side: usize) -> Vec3A {
    if side == 0 { normal } else { -normal }
}

/// Two unit vectors that make a right-handed frame with a unit normal (Duff et al. 2017).
pub fn tangents(normal: Vec3A) -> [Vec3A; 2] {
    let sign = 1.0_f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    [
        Vec3A::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vec3A::new(b, sign + normal.y * normal.y * a, -normal.y),
    ]
}

/// Points spread evenly over the unit disk along a spiral.
pub fn disk_points(count: usize) -> Vec<[f32; 2]> {
    (0..count)
        .map(|index| {
            let radius = ((index as f32 + 0.5) / count as f32).sqrt();
            let angle = index as f32 * std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
            [radius * libm::cosf(angle), radius * libm::sinf(angle)]
        })
        .collect()
}

/// Cosine and sine of an angle that differs from vertex to vertex without any pattern.
pub fn scrambled_turn(seed: u32) -> [f32; 2] {
    let mut hash = seed.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B;
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x7FEB_352D);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x846C_A68B);
    let angle = (hash ^ (hash >> 16)) as f32 / u32::MAX as f32 * std::f32::consts::TAU;
    [libm::cosf(angle), libm::sinf(angle)]
}

/// Turns a point of the disk.
pub fn turned([x, y]: [f32; 2], [cos, sin]: [f32; 2]) -> [f32; 2] {
    [x * cos - y * sin, x * sin + y * cos]
}
