//! Quaternions as the paper uses them (Sec. 1.3), on glam's `DQuat`.
//!
//! `q = s + x i + y j + z k` is stored as `DQuat { x, y, z, w: s }`; the Hamilton product, sum,
//! scaling and dot product are glam's. A unit quaternion rotates by `w -> conj(q) w q`, which is the
//! inverse of glam's own convention, so rotations go through [`rotate`] and [`from_frame`] only.

use glam::{DMat3, DQuat, DVec3};

/// `conj(q) w q`: the rotation of a vector by a unit quaternion (Sec. 1.3).
#[inline]
pub fn rotate(q: DQuat, w: DVec3) -> DVec3 {
    // Rodrigues' form of conj(q) w q, with u the vector part of q: w − 2 s (u × w) + 2 u × (u × w).
    let u = DVec3::new(q.x, q.y, q.z);
    let t = 2.0 * u.cross(w);
    w - q.w * t + u.cross(t)
}

/// The unit quaternion, up to sign, with `conj(q) i q = n`, `conj(q) j q = t`, `conj(q) k q = b`
/// for a right-handed orthonormal frame `n, t, b`.
#[inline]
pub fn from_frame(n: DVec3, t: DVec3, b: DVec3) -> DQuat {
    DQuat::from_mat3(&DMat3::from_cols(n, t, b)).conjugate()
}

/// A vector as a purely imaginary quaternion.
#[inline]
pub fn imaginary(v: DVec3) -> DQuat {
    DQuat::from_xyzw(v.x, v.y, v.z, 0.0)
}

/// `exp(θ n)` for a unit vector `n`: `cos θ + sin θ n`.
#[inline]
pub fn exp(angle_radians: f64, axis: DVec3) -> DQuat {
    let (sin, cos) = libm::sincos(angle_radians);
    DQuat::from_xyzw(sin * axis.x, sin * axis.y, sin * axis.z, cos)
}

/// `q / |q|`, or `None` where `q` is too small to have a direction.
#[inline]
pub fn normalized(q: DQuat) -> Option<DQuat> {
    let length = q.length();
    (length > 1e-150 && length.is_finite()).then(|| q * (1.0 / length))
}
