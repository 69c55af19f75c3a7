//! Roots between 0 and 1, and gates.

use crate::homotopy::polynomial::square_free;
use crate::homotopy::search::{Root, Search};
use num_bigint::BigInt;
use std::cmp::Ordering::{Greater, Less};

/// The form that is the product of (q t − p), for fractions p / q.
fn with_roots(fractions: &[[i64; 2]]) -> Vec<BigInt> {
    fractions.iter().fold(vec![1.into()], |form: Vec<BigInt>, [p, q]| {
        // q t − p (t + s)
        let [of_t, of_s] = [q - p, -p].map(BigInt::from);
        let mut product = vec![BigInt::default(); form.len() + 1];
        for (k, value) in form.iter().enumerate() {
            product[k] += value * &of_s;
            product[k + 1] += value * &of_t;
        }
        product
    })
}

fn roots(fractions: &[[i64; 2]], gate: &[[i64; 2]]) -> Vec<Root> {
    let form = with_roots(fractions);
    Search::new(square_free(&form), with_roots(gate), form).roots()
}

#[test]
fn every_root_has_a_bracket_and_signs_on_both_sides() {
    // t + 1 is positive at all times, t − 2 is negative.
    let (positive, negative): (&[[i64; 2]], &[[i64; 2]]) = (&[[-1, 1]], &[[2, 1]]);
    assert_eq!(roots(&[[3, 2], [-1, 5]], negative), []);
    assert_eq!(roots(&[[1, 3]], positive), []);
    let found = roots(&[[1, 3], [2, 3], [2, 3]], negative);
    assert_eq!(found.len(), 2);
    for (root, fraction) in found.iter().zip([1.0 / 3.0, 2.0 / 3.0]) {
        assert!(root.time[0] < fraction && fraction < root.time[1] && root.time[1] - root.time[0] <= 2e-9);
    }
    assert_eq!([found[0].sides, found[1].sides], [[Less, Greater], [Greater, Greater]]);
    // Halves and quarters are found exactly.
    let found = roots(&[[1, 2], [1, 4], [1, 4]], negative);
    assert_eq!(found, [Root::new([0.25; 2], [Less, Less]), Root::new([0.5; 2], [Less, Greater])]);
}

#[test]
fn roots_that_are_close_are_told_apart() {
    let n = 1_000_000_007;
    let found = roots(&[[333, n], [334, n]], &[[2, 1]]);
    assert_eq!(found.len(), 2);
    assert!(found[0].time[1] <= found[1].time[0]);
    // What is farther away than the gate allows does not count, however close.
    let found = roots(&[[333, n], [335, n]], &[[334, n]]);
    assert_eq!(found.len(), 1);
    assert!(found[0].time[0] <= 333.0 / n as f64 && 333.0 / n as f64 <= found[0].time[1]);
}
