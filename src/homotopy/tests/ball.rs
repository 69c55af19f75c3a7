//! Sums and products of balls against integers.

use crate::homotopy::ball::Ball;
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
    ball.radius().is_infinite() || ball.radius().is_nan() || {
        let off = exact(ball.middle()) - value;
        let radius = exact(ball.radius());
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
            checked += usize::from(ball.radius().is_finite());
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
