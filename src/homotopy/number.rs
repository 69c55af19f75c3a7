//! What numbers have to do for the polynomials of a motion: balls, which are fast, and integers, which are exact.

use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

/// Numbers that are added and multiplied.
pub(super) trait Number: Clone {
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// Times 2 to this power.
    fn doubled(&self, times: usize) -> Self;
    /// How it compares with zero, if that is known.
    fn sign(&self) -> Option<Ordering>;
}

impl Number for BigInt {
    fn plus(&self, other: &BigInt) -> BigInt {
        self + other
    }

    fn minus(&self, other: &BigInt) -> BigInt {
        self - other
    }

    fn times(&self, other: &BigInt) -> BigInt {
        self * other
    }

    fn doubled(&self, times: usize) -> BigInt {
        self << times
    }

    fn sign(&self) -> Option<Ordering> {
        Some(match BigInt::sign(self) {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        })
    }
}
