//! Common factors of polynomials.

use crate::homotopy::polynomial::{common_factor, core, quotient, square_free};
use num_bigint::BigInt;

fn polynomial(values: &[i64]) -> Vec<BigInt> {
    values.iter().map(|&value| value.into()).collect()
}

fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut product = vec![BigInt::default(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// Up to a constant factor.
fn is_same(a: &[BigInt], b: &[BigInt]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(x, y)| x * &b[b.len() - 1] == y * &a[a.len() - 1])
}

#[test]
fn factors_are_found_and_divided_out() {
    let [p, q, r] = [polynomial(&[-1, 3]), polynomial(&[5, -2, 7]), polynomial(&[2, 9])];
    let (pq, pr) = (product(&p, &q), product(&p, &r));
    assert!(is_same(&common_factor(&pq, &pr), &p));
    assert!(is_same(&common_factor(&pr, &pq), &p));
    assert_eq!(common_factor(&q, &r).len(), 1);
    assert!(is_same(&quotient(&pq, &p), &q) && is_same(&quotient(&pq, &q), &p));
    let cube = product(&product(&p, &p), &product(&p, &r));
    assert!(is_same(&square_free(&cube), &pr));
    assert!(is_same(&square_free(&pq), &pq));
    assert!(is_same(&common_factor(&p, &[]), &p) && is_same(&common_factor(&[], &p), &p));
    assert_eq!(core(&polynomial(&[0, 0, 4, 0, 1, 0])), polynomial(&[4, 0, 1]));
    assert!(core(&polynomial(&[0, 0])).is_empty());
}
