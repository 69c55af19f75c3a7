//! Where a surface lies in space: a metric leaves a rigid motion open, and random frames choose one at random.

use crate::algebra::quaternion;
use glam::{DMat3, DQuat, DVec3};
use nalgebra::{Matrix3, Matrix4};

/// An orientation-preserving isometry of space, `p ↦ R p + t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    rotation: DQuat,
    translation: DVec3,
}

impl RigidMotion {
    /// The motion that brings `positions` closest to `reference` in the weighted least-squares sense (Horn's
    /// quaternions). All slices are |V| long; weights are positive.
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
            let [w, x, y, z] = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into();
            upward(DQuat::from_xyzw(x, y, z, w))
        } else {
            DQuat::IDENTITY
        };
        RigidMotion { rotation, translation: to - rotation * from }
    }

    /// The motion that brings the centroid to the origin and the principal axes to those of space: x along the
    /// longest, z along the shortest. Of each axis the side that reaches further is positive, but for the most
    /// balanced one, whose sign makes the motion proper. So the result does not depend on where the positions lay.
    pub fn to_principal_axes(positions: &[DVec3], weights: &[f64]) -> RigidMotion {
        let center = mean(positions, weights);
        let moments = positions.iter().zip(weights).fold(DMat3::ZERO, |sum, (&p, &w)| {
            let (p, q) = (p - center, w * (p - center));
            sum + DMat3::from_cols(p * q.x, p * q.y, p * q.z)
        });
        if !moments.is_finite() {
            return RigidMotion { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };
        }
        let eigen = Matrix3::from_column_slice(&moments.to_cols_array()).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let mut axes = order.map(|column| DVec3::from_slice(eigen.eigenvectors.column(column).as_slice()));
        // Third moments tell the sides of an axis apart.
        let skewness = axes.map(|axis| {
            let (cubes, squares) = positions.iter().zip(weights).fold((0.0, 0.0), |(cubes, squares), (&p, &w)| {
                let x = (p - center).dot(axis);
                (cubes + w * x * x * x, squares + w * x * x)
            });
            cubes / (squares * squares.sqrt()).max(f64::MIN_POSITIVE)
        });
        for (axis, skewness) in axes.iter_mut().zip(skewness) {
            if skewness < 0.0 {
                *axis = -*axis;
            }
        }
        if DMat3::from_cols(axes[0], axes[1], axes[2]).determinant() < 0.0 {
            let balanced = (0..3).min_by(|&a, &b| skewness[a].abs().total_cmp(&skewness[b].abs())).unwrap_or(1);
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

/// Of the two quaternions of a rotation the one nearer to 1.
fn upward(rotation: DQuat) -> DQuat {
    let rotation = rotation.normalize();
    if rotation.w < 0.0 { -rotation } else { rotation }
}

fn mean(points: &[DVec3], weights: &[f64]) -> DVec3 {
    let total: f64 = weights.iter().sum();
    points.iter().zip(weights).map(|(&p, &w)| w * p).sum::<DVec3>() / total
}
