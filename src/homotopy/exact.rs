//! Decided in integers: when a hinge folds, and when a face vanishes.
//!
//! Floating point numbers are integers times a power of two, so that all polynomials of a motion have integer coefficients
//! up to a common factor, and their roots are isolated without any rounding.

use super::form::{sign_after_start, sign_before_end};
use super::motion::{Moving, agreement, normal, volume};
use super::number::Number;
use super::polynomial::{common_factor, core, quotient, square_free};
use super::search::{Root, Search};
use glam::DVec3;
use num_bigint::BigInt;
use std::array::from_fn;
use std::cmp::Ordering;

/// When a hinge folds, in order, from the places of its vertices in the beginning and in the end.
pub(super) fn folds(corners: [[DVec3; 2]; 4]) -> Vec<Root> {
    let [a, b, c, d] = integer_places(corners);
    let [e, u, w] = [b, c, d].map(|place| difference(&place, &a));
    let m = normal(&e, &u);
    let volume = volume(&m, &w);
    let agreement = agreement(&m, &normal(&w, &e));
    if core(&volume).is_empty() {
        return stays_folded(&agreement);
    }
    let mut roots = Vec::new();
    let is_fold = |volume: &BigInt, agreement: &BigInt| {
        (volume.sign_of(), agreement.sign_of()) == (Ordering::Equal, Ordering::Less)
    };
    if is_fold(&volume[0], &agreement[0]) {
        roots.push(Root::new([0.0; 2], [Ordering::Equal, sign_after_start(&volume)]));
    }
    // Where both are zero a face vanishes.
    let once = square_free(core(&volume));
    let once = quotient(&once, &common_factor(&once, &agreement));
    roots.extend(Search::new(once, agreement.to_vec(), volume.to_vec()).roots());
    if is_fold(&volume[3], &agreement[4]) {
        roots.push(Root::new([1.0; 2], [sign_before_end(&volume), Ordering::Equal]));
    }
    roots
}

/// When a face vanishes, in order.
pub(super) fn vanishings(corners: [[DVec3; 2]; 3]) -> Vec<Root> {
    let [a, b, c] = integer_places(corners);
    let normal = normal(&difference(&b, &a), &difference(&c, &a));
    let components: [[BigInt; 3]; 3] = from_fn(|axis| from_fn(|k| normal[k][axis].clone()));
    let all_zero = |k: usize| components.iter().all(|form| form[k].sign_of().is_eq());
    let sides = [Ordering::Equal; 2];
    if (0..3).all(all_zero) {
        return vec![Root::lasting([0.0, 1.0])];
    }
    let common = components.iter().fold(Vec::new(), |common, form| common_factor(&common, form));
    let mut roots = Vec::new();
    roots.extend(all_zero(0).then_some(Root::new([0.0; 2], sides)));
    roots.extend(Search::new(square_free(&common), vec![(-1).into()], Vec::new()).roots());
    roots.extend(all_zero(2).then_some(Root::new([1.0; 2], sides)));
    roots
}

/// The stretches of time in which a hinge that stays in a plane is folded: where its normals are opposite.
fn stays_folded(agreement: &[BigInt]) -> Vec<Root> {
    let once = square_free(core(agreement));
    let zeros = Search::new(once, vec![(-1).into()], agreement.to_vec()).roots();
    let begins = zeros.iter().map(|root| (root.time[0], root.sides[1]));
    let ends = zeros.iter().map(|root| root.time[1]).chain([1.0]);
    let stretches = std::iter::once((0.0, sign_after_start(agreement))).chain(begins).zip(ends);
    let folded = stretches.filter(|((_, sign), _)| sign.is_lt());
    folded.map(|((begin, _), end)| Root::lasting([begin, end])).collect()
}

fn difference(a: &Moving<BigInt>, b: &Moving<BigInt>) -> Moving<BigInt> {
    from_fn(|when| from_fn(|axis| a[when][axis].minus(&b[when][axis])))
}

/// Places as integers, up to a common factor.
fn integer_places<const N: usize>(corners: [[DVec3; 2]; N]) -> [Moving<BigInt>; N] {
    let coordinates: [f64; 24] = from_fn(|k| corners.get(k / 6).map_or(0.0, |places| places[k % 6 / 3][k % 3]));
    let (integers, _) = integers(&coordinates);
    from_fn(|corner| from_fn(|when| from_fn(|axis| integers[6 * corner + 3 * when + axis].clone())))
}

/// Integers and the power of two that they are to be multiplied with to be these finite numbers.
pub(super) fn integers<const N: usize>(numbers: &[f64; N]) -> ([BigInt; N], i32) {
    // Subnormal numbers have the exponent of the smallest normal ones, and no leading digit beyond their bits.
    let parts = numbers.map(|number| {
        let bits = number.to_bits();
        let (exponent, digits) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
        let digits = if exponent == 0 { digits } else { digits | 1 << 52 };
        (if number.is_sign_negative() { -digits } else { digits }, exponent.max(1) - 1075)
    });
    let smallest = parts.iter().filter(|(digits, _)| *digits != 0).map(|(_, exponent)| *exponent).min().unwrap_or(0);
    (parts.map(|(digits, exponent)| BigInt::from(digits) << (exponent - smallest).max(0)), smallest)
}

/// An integer's sign is always known.
trait KnownSign {
    fn sign_of(&self) -> Ordering;
}

impl KnownSign for BigInt {
    fn sign_of(&self) -> Ordering {
        Number::sign(self).unwrap_or(Ordering::Equal)
    }
}
