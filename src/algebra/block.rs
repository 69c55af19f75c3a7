//! 4×4 blocks in single or double precision.

use glam::{DMat4, DQuat, DVec4, Mat4, Vec4};
use std::convert::identity;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// A 4×4 block: [`Mat4`] in single precision, which has half the bytes and, with SSE2, twice the lanes, or [`DMat4`].
pub trait Block:
    Copy
    + Debug
    + Default
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
{
    /// A vector of four in the same precision.
    type Vector: Copy
        + Debug
        + Default
        + Send
        + Sync
        + Add<Output = Self::Vector>
        + AddAssign
        + Sub<Output = Self::Vector>
        + SubAssign;

    /// Relative rounding error.
    const EPSILON: f64;
    /// Reduction of a residual that is well above what rounding leaves of it.
    const ATTAINABLE: f64;

    /// Least pivot that is not rounding, relative to the largest entry of the block it came from.
    const LEAST_PIVOT: f64;

    /// No coupling.
    const ZERO: Self;
    /// Nearest block.
    fn round(m: DMat4) -> Self;
    /// The block in double precision.
    fn exact(&self) -> DMat4;
    /// Nearest vector.
    fn round_vector(v: DVec4) -> Self::Vector;
    /// The vector in double precision.
    fn exact_vector(v: Self::Vector) -> DVec4;
    /// The matrix of `x ↦ q x` on quaternions as glam stores them, (x, y, z, s).
    fn left_multiplication(q: DQuat) -> Self;
    /// `a bᵀ`.
    fn outer(a: Self::Vector, b: Self::Vector) -> Self;
    /// `M v`.
    fn times(&self, v: Self::Vector) -> Self::Vector;
    /// `Mᵀ v`.
    fn transpose_times(&self, v: Self::Vector) -> Self::Vector;
    /// `Mᵀ`.
    fn transposed(&self) -> Self;
    /// `factor v`, the factor rounded to the precision of the vector.
    fn scale(v: Self::Vector, factor: f64) -> Self::Vector;
    /// `a · b`.
    fn dot(a: Self::Vector, b: Self::Vector) -> f64;
}

macro_rules! block {
    ($matrix:ty, $vector:ty, $scalar:ty, $attainable:expr, $pivot:expr, $round:expr, $exact:expr, $round_vector:expr, $exact_vector:expr) => {
        impl Block for $matrix {
            type Vector = $vector;
            const EPSILON: f64 = <$scalar>::EPSILON as f64;
            const ATTAINABLE: f64 = $attainable;
            const LEAST_PIVOT: f64 = $pivot;
            const ZERO: Self = <$matrix>::ZERO;

            #[inline]
            fn round(m: DMat4) -> Self {
                $round(&m)
            }
            #[inline]
            fn exact(&self) -> DMat4 {
                $exact(self)
            }
            #[inline]
            fn round_vector(v: DVec4) -> $vector {
                $round_vector(v)
            }
            #[inline]
            fn exact_vector(v: $vector) -> DVec4 {
                $exact_vector(v)
            }
            #[inline]
            fn left_multiplication(q: DQuat) -> Self {
                let [x, y, z, w] = [q.x as $scalar, q.y as $scalar, q.z as $scalar, q.w as $scalar];
                <$matrix>::from_cols(
                    <$vector>::new(w, z, -y, -x),
                    <$vector>::new(-z, w, x, -y),
                    <$vector>::new(y, -x, w, -z),
                    <$vector>::new(x, y, z, w),
                )
            }
            #[inline]
            fn outer(a: $vector, b: $vector) -> Self {
                <$matrix>::from_cols(a * b.x, a * b.y, a * b.z, a * b.w)
            }
            #[inline]
            fn times(&self, v: $vector) -> $vector {
                *self * v
            }
            #[inline]
            fn transpose_times(&self, v: $vector) -> $vector {
                // Lane by lane and transposed at the end: four dot products take more shuffles.
                let products = <$matrix>::from_cols(self.x_axis * v, self.y_axis * v, self.z_axis * v, self.w_axis * v)
                    .transpose();
                (products.x_axis + products.y_axis) + (products.z_axis + products.w_axis)
            }
            #[inline]
            fn transposed(&self) -> Self {
                self.transpose()
            }
            #[inline]
            fn scale(v: $vector, factor: f64) -> $vector {
                v * factor as $scalar
            }
            #[inline]
            fn dot(a: $vector, b: $vector) -> f64 {
                f64::from(a.dot(b))
            }
        }
    };
}

block!(Mat4, Vec4, f32, 1e-5, 1e-6, DMat4::as_mat4, Mat4::as_dmat4, DVec4::as_vec4, Vec4::as_dvec4);
block!(DMat4, DVec4, f64, 1e-13, 1e-12, DMat4::clone, DMat4::clone, identity, identity);
