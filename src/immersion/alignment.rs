//! Where a surface lies in space: a metric leaves a rigid motion open, and random frames choose one at random.

use crate::algebra::{principal_axes, quaternion, upright_sign};
use glam::{DMat3, DQuat, DVec3};
use nalgebra::{Matrix4, Vector4};

/// An orientation-preserving isometry of space, `p ↦ R p + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    rotation: DQuat,
    translation: DVec3,
}

impl RigidMotion {
    /// The motion that brings `positions` closest to `reference` in the weighted least-squares sense (Horn's
    /// quaternions). All slices are |V| long; weights are positive. Of several that are as close, as onto the mirror image
    /// of something round, it is the one that turns least.
    pub fn onto(reference: &[DVec3], positions: &[DVec3], weights: &[f64]) -> RigidMotion {
        let (from, to) = (mean(positions, weights), mean(reference, weights));
        // Σ w p qᵀ, whose best rotation is the top eigenvector of a symmetric matrix of its entries.
        let s = positions.iter().zip(reference).zip(weights).fold(DMat3::ZERO, |sum, ((&p, &q), &w)| {
            let (p, q) = (p - from, w * (q - to));
            sum + DMat3::from_cols(p * q.x, p * q.y, p * q.z)
        });
        let [x, y, z] = [s.x_axis, s.y_axis, s.z_axis]; // s.column(b)[a] = Σ w p_a q_b
        #[rustfmt::skip]
        let horn = Matrix4::new(
            x.x + y.y + z.z, z.y - y.z,       x.z - z.x,        y.x - x.y,
            z.y - y.z,       x.x - y.y - z.z, y.x + x.y,        x.z + z.x,
            x.z - z.x,       y.x + x.y,       y.y - x.x - z.z,  z.y + y.z,
            y.x - x.y,       x.z + z.x,       z.y + y.z,        z.z - x.x - y.y,
        );
        let rotation = if horn.iter().all(|entry| entry.is_finite()) {
            let eigen = horn.symmetric_eigen();
            let largest = eigen.eigenvalues.max();
            let spread = largest - eigen.eigenvalues.min();
            let best: Vec<Vector4<f64>> = (0..4)
                .filter(|&k| largest - eigen.eigenvalues[k] <= TIE * spread)
                .map(|k| eigen.eigenvectors.column(k).into_owned())
                .collect();
            let [w, x, y, z] = nearest_to_none(&best).into();
            upward(DQuat::from_xyzw(x, y, z, w))
        } else {
            DQuat::IDENTITY
        };
        RigidMotion { rotation, translation: to - rotation * from }
    }

    /// The motion that brings the centroid to the origin and the principal axes to those of space: x along the
    /// longest, z along the shortest. Of each axis the side that reaches further is positive, but for the most
    /// balanced one, whose sign makes the motion proper. So the result does not depend on where the positions lay,
    /// unless something is as long along two axes: there rounding would choose, so the axes nearest to those of space
    /// are taken, and the larger coordinate tells sides apart that reach as far.
    pub fn to_principal_axes(positions: &[DVec3], weights: &[f64]) -> RigidMotion {
        let center = mean(positions, weights);
        let total: f64 = weights.iter().sum();
        let moments = positions.iter().zip(weights).fold(DMat3::ZERO, |sum, (&p, &w)| {
            let (p, q) = (p - center, (w / total) * (p - center));
            sum + DMat3::from_cols(p * q.x, p * q.y, p * q.z)
        });
        if !moments.is_finite() {
            return RigidMotion { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };
        }
        // Third moments tell the sides of an axis apart.
        let sides = principal_axes(moments, TIE, DVec3::AXES).map(|(axis, variance)| {
            let unit = 1.0 / variance.sqrt();
            let cubes = positions.iter().zip(weights).map(|(&p, &w)| {
                let x = (p - center).dot(axis) * unit;
                (w / total) * x * x * x
            });
            let skewness = if unit.is_finite() { cubes.sum::<f64>() } else { 0.0 };
            if skewness.abs() > TIE { (axis * skewness.signum(), skewness) } else { (axis * upright_sign(axis), 0.0) }
        });
        let mut axes = sides.map(|(axis, _)| axis);
        if DMat3::from_cols(axes[0], axes[1], axes[2]).determinant() < 0.0 {
            let balance = |k: &usize| sides[*k].1.abs();
            let balanced = (0..3).min_by(|a, b| balance(a).total_cmp(&balance(b))).unwrap_or(1);
            axes[balanced] = -axes[balanced];
        }
        let rotation = upward(DQuat::from_mat3(&DMat3::from_cols(axes[0], axes[1], axes[2]).transpose()));
        RigidMotion { rotation, translation: -(rotation * center) }
    }

    /// This motion, turned toward the goal by at most an angle. The point `pivot`, before the motion, goes where it went.
    pub fn toward(&self, goal: &RigidMotion, largest_turn_radians: f64, pivot: DVec3) -> RigidMotion {
        let turn = upward(goal.rotation * self.rotation.conjugate());
        let (sine, axis) = (turn.xyz().length(), turn.xyz().normalize_or_zero());
        let half = libm::atan2(sine, turn.w).min(0.5 * largest_turn_radians);
        let rotation = upward(quaternion::exp(half, axis) * self.rotation);
        RigidMotion { rotation, translation: self.point(pivot) - rotation * pivot }
    }

    /// Where a point goes.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// What a frame becomes, so that the normal `conj(λ) i λ` turns with the surface: `λ r` with `R w = conj(r) w r`.
    pub fn frame(&self, frame: DQuat) -> DQuat {
        frame * self.rotation.conjugate()
    }
}

/// Relative differences of moments below which they are equal up to rounding.
const TIE: f64 = 1e-9;

/// The rotation closest to none, as w, x, y, z, among those spanned by some orthonormal ones, all of which are as good:
/// rounding must not choose. If all of them are half turns, the one nearest to that about x, y or z.
fn nearest_to_none(best: &[Vector4<f64>]) -> Vector4<f64> {
    if let [only] = best {
        return *only;
    }
    let projected = |k: usize| best.iter().map(|v| v * v[k]).sum::<Vector4<f64>>();
    (0..4).map(projected).find(|v| v.norm() > 1e-3).unwrap_or_else(Vector4::x)
}

/// Of the two quaternions of a rotation the one nearer to 1.
fn upward(rotation: DQuat) -> DQuat {
    let rotation = rotation.normalize();
    if rotation.w < 0.0 { -rotation } else { rotation }
}

fn mean(points: &[DVec3], weights: &[f64]) -> DVec3 {
    let total: f64 = weights.iter().sum();
    points.iter().zip(weights).map(|(&p, &w)| w * p).sum::<DVec3>() / total
}
