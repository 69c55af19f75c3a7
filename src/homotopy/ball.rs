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

#[cfg(test)]
mod tests {
    use super::Ball;
    use crate::homotopy::exact::integers;
    use crate::homotopy::number::Number;
    use num_bigint::BigInt;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    /// The exponent of the unit that exact values are counted in: no product of eight numbers has a finer one.
    const FINE: i32 = 16 * 1074;

    /// A floating point number in that unit.
    fn exact(x: f64) -> BigInt {
        let ([value], exponent) = integers(&[x]);
        value << (exponent + FINE)
    }

    /// Whether a ball contains a value that is given in units of 2^−(2^depth · 1074).
    fn contains(ball: &Ball, value: &BigInt) -> bool {
        ball.radius.is_infinite() || ball.radius.is_nan() || {
            let off = exact(ball.middle) - value;
            let radius = exact(ball.radius);
            -&radius <= off && off <= radius
        }
    }

    /// Sums and products of random numbers of all sizes, tiny and subnormal ones included, lie in their balls.
    #[test]
    fn balls_contain_what_is_computed_exactly() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut checked = 0;
        for round in 0..4000 {
            let mut number = || {
                let (mantissa, kind) = (random.next_u64(), random.next_u64());
                let spread = [0, 3, 40, 600][round % 4];
                let exponent =
                    1023 - if spread == 0 { 0 } else { (kind % spread) as i64 * if round % 8 < 4 { 1 } else { -1 } };
                let exponent = if round % 16 == 15 { exponent - 500 } else { exponent };
                let bits = (mantissa & 0x800f_ffff_ffff_ffff) | ((exponent.clamp(0, 2000) as u64) << 52);
                f64::from_bits(bits)
            };
            let [a, b, c, d] = [number(), number(), number(), number()];
            let one = BigInt::from(1) << FINE;
            let (x, y) = (Ball::of_difference(a, b), Ball::of_difference(c, d));
            let (u, w) = (exact(a) - exact(b), exact(c) - exact(d));
            let product = (&u * &w) >> FINE;
            assert_eq!(&product << FINE, &u * &w, "the unit is fine enough");
            let cases = [
                (x, u.clone()),
                (x.plus(&y), &u + &w),
                (x.minus(&y), &u - &w),
                (x.times(&y), product.clone()),
                (x.times(&y).plus(&x), &product + &u),
                (x.times(&y).times(&x).minus(&y), ((&product * &u) >> FINE) - &w),
                (x.doubled(4), &u << 4),
            ];
            for (ball, value) in cases {
                assert!(contains(&ball, &value), "{ball:?} from {a:e} {b:e} {c:e} {d:e}, one is {one:?}");
                checked += usize::from(ball.radius.is_finite());
                let sign = Number::sign(&value);
                assert!(ball.sign().is_none_or(|known| Some(known) == sign), "{ball:?}");
            }
        }
        assert!(checked > 25_000, "only {checked} balls were finite");
    }

    #[test]
    fn what_overflows_has_no_sign() {
        let large = Ball::of_difference(1e200, -1e200);
        assert!(large.sign().is_some());
        assert_eq!(large.times(&large).sign(), None);
        assert_eq!(large.times(&large).minus(&large.times(&large)).sign(), None);
    }
}
