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

/// `conj(q) j q` and `conj(q) k q`, which span the tangent plane, for a unit quaternion.
#[inline]
pub fn tangents(q: DQuat) -> [DVec3; 2] {
    let DQuat { x, y, z, w } = q;
    [
        DVec3::new(2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
        DVec3::new(2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
    ]
}

/// Of the two quaternions of [`from_frame`] the one with `⟨q, near⟩ ≥ 0`, for a unit quaternion `near`.
#[inline(always)]
pub fn from_frame_near(n: DVec3, t: DVec3, b: DVec3, near: DQuat) -> DQuat {
    // The entries of 4 q qᵀ are sums of those of the rotation; times `near` that is 4 ⟨q, near⟩ q.
    let (wx, wy, wz) = (b.y - t.z, n.z - b.x, t.x - n.y);
    let (xy, xz, yz) = (n.y + t.x, n.z + b.x, t.z + b.y);
    let DQuat { x, y, z, w } = near;
    let projected = DQuat::from_xyzw(
        (1.0 + n.x - t.y - b.z) * x + xy * y + xz * z + wx * w,
        xy * x + (1.0 - n.x + t.y - b.z) * y + yz * z + wy * w,
        xz * x + yz * y + (1.0 - n.x - t.y + b.z) * z + wz * w,
        wx * x + wy * y + wz * z + (1.0 + n.x + t.y + b.z) * w,
    );
    let length = projected.length();
    if length > 0.1 { projected * (1.0 / length) } else { far_from_frame(n, t, b, near) }
}

/// Where both are nearly orthogonal to `near`, too little is left of the projection.
#[cold]
fn far_from_frame(n: DVec3, t: DVec3, b: DVec3, near: DQuat) -> DQuat {
    let q = from_frame(n, t, b);
    if q.dot(near) < 0.0 { -q } else { q }
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
