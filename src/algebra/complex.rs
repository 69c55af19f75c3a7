//! Unit complex numbers, the values of the connections (Eq. 6, 7).

use glam::DQuat;
use std::ops::{Mul, Neg};

/// A complex number `re + im i`, embedded in the quaternions as `re + im i + 0 j + 0 k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// The number 1.
    pub const ONE: Complex = Complex { re: 1.0, im: 0.0 };

    /// `exp(i θ)`.
    #[inline]
    pub fn from_angle(radians: f64) -> Self {
        let (im, re) = libm::sincos(radians);
        Complex { re, im }
    }
    /// The argument in (−π, π].
    #[inline]
    pub fn angle(self) -> f64 {
        libm::atan2(self.im, self.re)
    }
    /// `re − im i`.
    #[inline]
    pub fn conjugate(self) -> Self {
        Complex { re: self.re, im: -self.im }
    }
    /// `re² + im²`.
    #[inline]
    pub fn length_squared(self) -> f64 {
        self.re * self.re + self.im * self.im
    }
    /// As a quaternion in span(1, i).
    #[inline]
    pub fn quaternion(self) -> DQuat {
        DQuat::from_xyzw(self.im, 0.0, 0.0, self.re)
    }
    /// `z j` as a quaternion in span(j, k): a tangent vector of a face in its own frame (Sec. 3).
    #[inline]
    pub fn times_j(self) -> DQuat {
        DQuat::from_xyzw(0.0, self.re, self.im, 0.0)
    }
}

impl From<f64> for Complex {
    #[inline]
    fn from(re: f64) -> Complex {
        Complex { re, im: 0.0 }
    }
}

impl Mul for Complex {
    type Output = Complex;
    #[inline]
    fn mul(self, b: Complex) -> Complex {
        Complex { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}

impl Mul<DQuat> for Complex {
    type Output = DQuat;
    /// `(re + im i) q`.
    #[inline]
    fn mul(self, q: DQuat) -> DQuat {
        DQuat::from_xyzw(
            self.re * q.x + self.im * q.w,
            self.re * q.y - self.im * q.z,
            self.re * q.z + self.im * q.y,
            self.re * q.w - self.im * q.x,
        )
    }
}

impl Neg for Complex {
    type Output = Complex;
    #[inline]
    fn neg(self) -> Complex {
        Complex { re: -self.re, im: -self.im }
    }
}
