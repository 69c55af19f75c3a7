//! The roots of a polynomial between 0 and 1, each in a bracket of its own, by halving the time.

use super::form::{halves, sign_after_start, sign_before_end, sign_between, variations};
use super::number::Number;
use num_bigint::BigInt;
use std::cmp::Ordering;

/// A time at which something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    /// It is not before the first and not after the second; both are the same where it is known exactly.
    pub time: [f64; 2],
    /// The sign of the observed form right before and right after; `Equal` where there is none, or no such time.
    pub sides: [Ordering; 2],
    /// Whether it is no moment but all of that time.
    pub lasts: bool,
}

impl Root {
    /// A moment in a bracket.
    pub fn new(time: [f64; 2], sides: [Ordering; 2]) -> Root {
        Root { time, sides, lasts: false }
    }

    /// A stretch of time.
    pub fn lasting(time: [f64; 2]) -> Root {
        Root { time, sides: [Ordering::Equal; 2], lasts: true }
    }
}

/// How often the time is halved at least, so that brackets are no longer than 2⁻³⁰.
const FINE: u32 = 30;
/// Halvings that a floating point number tells apart, up to 1.
const DIGITS: u32 = 52;

/// Forms on a piece of the time that came of halving.
pub(super) struct Search {
    /// Has every root once, and none where the gate is zero.
    pub square_free: Vec<BigInt>,
    /// Only roots where this form is negative count.
    pub gate: Vec<BigInt>,
    /// The form whose signs before and after are asked for.
    pub observed: Vec<BigInt>,
    /// Which piece it is, counted from 0, of those with half of the time so many times.
    pub piece: BigInt,
    pub halvings: u32,
}

impl Search {
    /// Over the whole time.
    pub fn new(square_free: Vec<BigInt>, gate: Vec<BigInt>, observed: Vec<BigInt>) -> Search {
        Search { square_free, gate, observed, piece: BigInt::default(), halvings: 0 }
    }

    /// All roots after 0 and before 1, in order.
    pub fn roots(self) -> Vec<Root> {
        let (mut found, mut open) = (Vec::new(), vec![self]);
        while let Some(mut here) = open.pop() {
            here.take_root_at_start(&mut found);
            match variations(&here.square_free) {
                0 => {}
                1 if here.is_narrow() => {
                    let sides = [sign_after_start(&here.observed), sign_before_end(&here.observed)];
                    if sign_between(&here.gate) == Some(Ordering::Less) {
                        found.push(Root::new(here.ends(1), sides));
                    }
                }
                _ => {
                    let [first, second] = here.halves();
                    open.extend([second, first]);
                }
            }
        }
        found
    }

    /// Whether a single root in this piece needs no shorter one.
    fn is_narrow(&self) -> bool {
        self.halvings >= FINE && sign_between(&self.gate).is_some()
    }

    /// A root where the piece begins, and no longer one of the polynomial. Where the piece ends the next one begins.
    fn take_root_at_start(&mut self, found: &mut Vec<Root>) {
        let is_zero = |value: Option<&BigInt>| value.and_then(Number::sign) == Some(Ordering::Equal);
        if is_zero(self.square_free.first()) {
            self.square_free.remove(0);
            if self.gate.first().and_then(Number::sign) == Some(Ordering::Less) {
                let after = sign_after_start(&self.observed);
                let times = self.observed.iter().take_while(|value| is_zero(Some(value))).count();
                let before = if times.is_multiple_of(2) { after } else { after.reverse() };
                found.push(Root::new(self.ends(0), [before, after]));
            }
        }
        if is_zero(self.square_free.last()) {
            self.square_free.pop();
        }
    }

    fn halves(self) -> [Search; 2] {
        let [square_free, gate, observed] = [&self.square_free, &self.gate, &self.observed].map(|form| halves(form));
        let [[a, b], [c, d], [e, f]] = [square_free, gate, observed];
        let halvings = self.halvings + 1;
        let piece: BigInt = self.piece << 1;
        [
            Search { square_free: a, gate: c, observed: e, piece: piece.clone(), halvings },
            Search { square_free: b, gate: d, observed: f, piece: piece + 1, halvings },
        ]
    }

    /// When the piece begins, and when as many pieces later begins or ends, rounded outward.
    fn ends(&self, pieces: u64) -> [f64; 2] {
        let unknown = self.halvings.saturating_sub(DIGITS);
        let unit = 1.0 / (1_u64 << self.halvings.min(DIGITS)) as f64;
        let up: BigInt = (BigInt::from(1) << unknown) - 1;
        let [down, up]: [BigInt; 2] = [&self.piece >> unknown, (&self.piece + pieces + up) >> unknown];
        // No piece has a number that 2⁵² do not reach.
        [down, up].map(|number| u64::try_from(&number).map_or(1.0, |number| number as f64 * unit))
    }
}
