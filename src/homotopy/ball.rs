//! Real numbers that are known up to a radius.
//!
//! A sum or product of floating point numbers is off by at most 2⁻⁵³ of its result, and by less than the smallest
//! normal number where it underflows. Both go into the radius. The radius itself is made of sums and products of numbers that are not
//! negative, none of which passes through more than six roundings; the last factor makes up for eight. What overflows is
//! not a number or has an infinite radius, and nothing is known of its sign.

use super::number::Number;
use std::cmp::Ordering;

/// All real numbers that are at most `radius` away from `middle`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    middle: f64,
    radius: f64,
}

/// The most that a result is off when it is rounded, relative to it: 2⁻⁵³.
const ROUNDING: f64 = 0.5 * f64::EPSILON;
/// Makes up for eight roundings.
const ROUNDED_UP: f64 = 1.0 + 8.0 * ROUNDING;
/// More than four underflows can be off.
const UNDERFLOW: f64 = f64::MIN_POSITIVE;

impl Ball {
    /// a − b.
    pub fn of_difference(a: f64, b: f64) -> Ball {
        let middle = a - b;
        Ball { middle, radius: (middle.abs() * ROUNDING + UNDERFLOW) * ROUNDED_UP }
    }

    #[cfg(test)]
    pub fn middle(&self) -> f64 {
        self.middle
    }

    #[cfg(test)]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    fn of_sum(middle: f64, a: &Ball, b: &Ball) -> Ball {
        Ball { middle, radius: (a.radius + b.radius + middle.abs() * ROUNDING) * ROUNDED_UP }
    }
}

impl Number for Ball {
    #[inline]
    fn plus(&self, other: &Ball) -> Ball {
        Ball::of_sum(self.middle + other.middle, self, other)
    }

    #[inline]
    fn minus(&self, other: &Ball) -> Ball {
        Ball::of_sum(self.middle - other.middle, self, other)
    }

    #[inline]
    fn times(&self, other: &Ball) -> Ball {
        let middle = self.middle * other.middle;
        let spread = self.middle.abs() * other.radius + self.radius * (other.middle.abs() + other.radius);
        Ball { middle, radius: (spread + middle.abs() * ROUNDING + UNDERFLOW) * ROUNDED_UP }
    }

    fn doubled(&self, times: usize) -> Ball {
        let factor = (1_u64 << times) as f64;
        Ball { middle: self.middle * factor, radius: self.radius * factor }
    }

    #[inline]
    fn sign(&self) -> Option<Ordering> {
        if self.middle > self.radius {
            Some(Ordering::Greater)
        } else if -self.middle > self.radius {
            Some(Ordering::Less)
        } else {
            None
        }
    }
}
