//! What balls settle: that a hinge does not fold and a face does not vanish, which is nearly always so.

use super::ball::Ball;
use super::form::{common_sign, halves};
use super::motion::{Moving, agreement, normal, square, volume};
use glam::DVec3;
use std::array::from_fn;
use std::cmp::Ordering;

/// How often the time is halved before integers take over.
const HALVINGS: usize = 8;

/// Whether it is certain that a hinge does not fold, from the places of its vertices in the beginning and in the end.
pub(super) fn does_not_fold([a, b, c, d]: [[DVec3; 2]; 4]) -> bool {
    let [e, u, w] = [b, c, d].map(|place| difference(place, a));
    let m = normal(&e, &u);
    let agreement = agreement(&m, &normal(&w, &e));
    // Surfaces are smooth nearly everywhere.
    is_positive(&agreement) || stays_open(&volume(&m, &w), &agreement, HALVINGS)
}

/// Whether it is certain that a face does not vanish.
pub(super) fn does_not_vanish([a, b, c]: [[DVec3; 2]; 3]) -> bool {
    stays_positive(&square(&normal(&difference(b, a), &difference(c, a))), HALVINGS)
}

fn stays_open(volume: &[Ball], agreement: &[Ball], halvings: usize) -> bool {
    if common_sign(volume).is_some() || is_positive(agreement) {
        return true;
    }
    let Some(left) = halvings.checked_sub(1) else { return false };
    let [volumes, agreements] = [halves(volume), halves(agreement)];
    (0..2).all(|half| stays_open(&volumes[half], &agreements[half], left))
}

fn stays_positive(square: &[Ball], halvings: usize) -> bool {
    if is_positive(square) {
        return true;
    }
    let Some(left) = halvings.checked_sub(1) else { return false };
    halves(square).iter().all(|half| stays_positive(half, left))
}

fn is_positive(form: &[Ball]) -> bool {
    common_sign(form) == Some(Ordering::Greater)
}

/// a − b, as far as balls know it.
pub(super) fn difference(a: [DVec3; 2], b: [DVec3; 2]) -> Moving<Ball> {
    from_fn(|when| from_fn(|axis| Ball::of_difference(a[when][axis], b[when][axis])))
}
