//! Polynomials with integer coefficients, the constant one first, up to a constant factor: only their roots matter.
//!
//! The coefficients of a form are those of a polynomial in x = t / s, which grows from 0 to infinity while t goes from 0 to 1.

use num_bigint::{BigInt, Sign};

/// Without factors t and s, whose roots are times 0 and 1.
pub(super) fn core(form: &[BigInt]) -> &[BigInt] {
    let is_zero = |value: &BigInt| value.sign() == Sign::NoSign;
    let Some(first) = form.iter().position(|value| !is_zero(value)) else { return &[] };
    let last = form.iter().rposition(|value| !is_zero(value)).unwrap_or(first);
    &form[first..=last]
}

/// With the same roots, each of them once. Neither the first nor the last coefficient is zero.
pub(super) fn square_free(polynomial: &[BigInt]) -> Vec<BigInt> {
    let derivative: Vec<BigInt> = polynomial.iter().enumerate().skip(1).map(|(k, value)| value * k).collect();
    quotient(polynomial, &common_factor(polynomial, &derivative))
}

/// The greatest common factor; of nothing and a polynomial it is that polynomial.
pub(super) fn common_factor(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let (mut a, mut b) = (core(a).to_vec(), core(b).to_vec());
    while !b.is_empty() {
        let mut rest = a;
        while rest.len() >= b.len() {
            reduce(&mut rest, &b);
        }
        // Factors x are no common ones: none of both has any.
        a = std::mem::replace(&mut b, core(&rest).to_vec());
    }
    a
}

/// What is left when a factor is divided out.
pub(super) fn quotient(polynomial: &[BigInt], factor: &[BigInt]) -> Vec<BigInt> {
    if factor.len() < 2 {
        // Nothing is divided out, as nearly always, and coefficients stay small.
        return polynomial.to_vec();
    }
    let mut rest = polynomial.to_vec();
    let mut quotient: Vec<BigInt> = Vec::new();
    while rest.len() >= factor.len() {
        let Some(scale) = factor.last() else { break };
        quotient.iter_mut().for_each(|value| *value *= scale);
        quotient.push(reduce(&mut rest, factor));
    }
    quotient.reverse();
    quotient
}

/// Takes out the leading coefficient, by scaling with that of the factor and subtracting a multiple of it. Returns the multiple.
fn reduce(rest: &mut Vec<BigInt>, factor: &[BigInt]) -> BigInt {
    let (Some(leading), Some(scale)) = (rest.pop(), factor.last()) else { return BigInt::default() };
    rest.iter_mut().for_each(|value| *value *= scale);
    let below = factor.len() - 1;
    let start = rest.len() - below;
    rest[start..].iter_mut().zip(factor).for_each(|(value, of_factor)| *value -= of_factor * &leading);
    leading
}
