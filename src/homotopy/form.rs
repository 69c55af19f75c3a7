//! Polynomials in time as forms in t and s = 1 − t: coefficient k of a form of degree n belongs to tᵏ sⁿ⁻ᵏ.
//!
//! They are Bernstein polynomials times binomial numbers, so that a product is a convolution and no coefficient is ever divided.
//! From 0 to 1 both t and s are positive: where no two coefficients have opposite signs, there is no root between; and if
//! the signs change once along the coefficients, there is exactly one (Descartes).

use super::number::Number;
use std::cmp::Ordering;

/// The form on the first half of the time and on the second, each again from 0 to 1, times 2 to its degree.
pub(super) fn halves<T: Number>(form: &[T]) -> [Vec<T>; 2] {
    let backwards: Vec<T> = form.iter().rev().cloned().collect();
    let mut second = first_half(backwards.clone(), form.len());
    second.reverse();
    [first_half(form.to_vec(), form.len()), second]
}

/// The same with t = t'/2 and s = s' + t'/2.
fn first_half<T: Number>(mut form: Vec<T>, count: usize) -> Vec<T> {
    // With x = s'/t' that is a shift by one of the polynomial whose coefficients are those of the form from the last to the first.
    for round in 0..count {
        for k in 1..count - round {
            form[k] = form[k].plus(&form[k - 1]);
        }
    }
    form.iter().enumerate().map(|(k, value)| value.doubled(count - 1 - k)).collect()
}

/// The sign that all coefficients have, if they have.
pub(super) fn common_sign<T: Number>(form: &[T]) -> Option<Ordering> {
    let first = form.first()?.sign().filter(|sign| sign.is_ne())?;
    form.iter().all(|value| value.sign() == Some(first)).then_some(first)
}

/// The sign between 0 and 1 if no two coefficients have opposite ones: then it is the same at all times.
pub(super) fn sign_between<T: Number>(form: &[T]) -> Option<Ordering> {
    let first = sign_after_start(form);
    let agrees = |value: &T| value.sign().is_some_and(|sign| sign.is_eq() || sign == first);
    (first.is_ne() && form.iter().all(agrees)).then_some(first)
}

/// How often the sign changes along the coefficients, zeros left out.
pub(super) fn variations<T: Number>(form: &[T]) -> usize {
    let signs: Vec<Ordering> = form.iter().filter_map(T::sign).filter(|sign| sign.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The sign right after time 0; `Equal` if the form is zero.
pub(super) fn sign_after_start<T: Number>(form: &[T]) -> Ordering {
    form.iter().filter_map(T::sign).find(|sign| sign.is_ne()).unwrap_or(Ordering::Equal)
}

/// The sign right before time 1; `Equal` if the form is zero.
pub(super) fn sign_before_end<T: Number>(form: &[T]) -> Ordering {
    form.iter().rev().filter_map(T::sign).find(|sign| sign.is_ne()).unwrap_or(Ordering::Equal)
}
