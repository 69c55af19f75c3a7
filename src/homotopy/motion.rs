//! The polynomials of a hinge and of a face whose vertices move on straight lines.

use super::number::Number;
use std::array::from_fn;

/// A vector that changes linearly: as it is in the beginning and in the end.
pub(super) type Moving<T> = [[T; 3]; 2];

/// The normal e × u of a face with sides e and u, a form of degree 2.
pub(super) fn normal<T: Number>(e: &Moving<T>, u: &Moving<T>) -> [[T; 3]; 3] {
    let [first, second] = [cross(&e[0], &u[1]), cross(&e[1], &u[0])];
    [cross(&e[0], &u[0]), from_fn(|k| first[k].plus(&second[k])), cross(&e[1], &u[1])]
}

/// The square of a normal, a form of degree 4.
pub(super) fn square<T: Number>(normal: &[[T; 3]; 3]) -> [T; 5] {
    agreement(normal, normal)
}

/// The product of two normals, a form of degree 4.
pub(super) fn agreement<T: Number>(m: &[[T; 3]; 3], n: &[[T; 3]; 3]) -> [T; 5] {
    let [a, b] = [dot(&m[0], &n[1]), dot(&m[1], &n[0])];
    let [c, d, e] = [dot(&m[0], &n[2]), dot(&m[1], &n[1]), dot(&m[2], &n[0])];
    let [f, g] = [dot(&m[1], &n[2]), dot(&m[2], &n[1])];
    [dot(&m[0], &n[0]), a.plus(&b), c.plus(&d).plus(&e), f.plus(&g), dot(&m[2], &n[2])]
}

/// The volume det(e, u, w) = (e × u) · w, a form of degree 3.
pub(super) fn volume<T: Number>(normal: &[[T; 3]; 3], w: &Moving<T>) -> [T; 4] {
    let [a, b] = [dot(&normal[0], &w[1]), dot(&normal[1], &w[0])];
    let [c, d] = [dot(&normal[1], &w[1]), dot(&normal[2], &w[0])];
    [dot(&normal[0], &w[0]), a.plus(&b), c.plus(&d), dot(&normal[2], &w[1])]
}

fn cross<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    from_fn(|k| {
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        a[i].times(&b[j]).minus(&a[j].times(&b[i]))
    })
}

fn dot<T: Number>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}
