//! When four triangles that move have a point in common.

use super::surface::{common_point, is_inside};
use crate::algebra::{Box3, box_of, common, overlaps, share_a_vertex};
use crate::homotopy::ball::Ball;
use crate::homotopy::exact::integers;
use crate::homotopy::form::{common_sign, halves, sign_after_start, sign_before_end, variations};
use crate::homotopy::motion::{Moving, normal, volume};
use crate::homotopy::number::Number;
use crate::homotopy::settled::difference;
use glam::DVec3;
use num_bigint::BigInt;
use rayon::prelude::*;
use std::array::from_fn;
use std::cmp::Ordering;

/// A moment between two surfaces.
pub(super) struct Moment {
    /// From 0 to 1.
    pub time: f64,
    pub faces: [usize; 4],
    pub place: DVec3,
}

/// Places of the corners of a triangle in the beginning and in the end.
type Corners = [[DVec3; 2]; 3];

/// How often the time is halved before integers take over.
const HALVINGS: usize = 4;
/// Times are known to less than this.
const SHORTEST: f64 = 1e-12;

/// All quadruple points while vertices move on straight lines between places in general position, in the order of their times.
pub(super) fn moments(triangles: &[[u32; 3]], from: &[DVec3], to: &[DVec3]) -> Vec<Moment> {
    let corners = |index: usize| triangles[index].map(|v| [from[v as usize], to[v as usize]]);
    let boxes: Vec<Box3> = (0..triangles.len()).map(|index| box_of(corners(index).into_iter().flatten())).collect();
    let near = overlaps(&boxes, |one, other| {
        let may_meet = !share_a_vertex(&triangles[one], &triangles[other])
            && !stay_apart(&corners(one), &corners(other))
            && !stay_apart(&corners(other), &corners(one));
        may_meet.then_some((one, other))
    });
    let mut partners_of = vec![Vec::new(); triangles.len()];
    near.into_iter().for_each(|(one, other)| partners_of[one].push(other));
    let is_near = |one: usize, other: usize| partners_of[one].binary_search(&other).is_ok();
    let of_first = |a: usize| {
        let partners: &[usize] = &partners_of[a];
        let mut found = Vec::new();
        for (k, &b) in partners.iter().enumerate() {
            let Some(two) = common(boxes[a], boxes[b]) else { continue };
            let rest: Vec<usize> = partners[k + 1..].iter().copied().filter(|c| is_near(b, *c)).collect();
            for (l, &c) in rest.iter().enumerate() {
                let Some(three) = common(two, boxes[c]) else { continue };
                let last = rest[l + 1..].iter().copied().filter(|d| is_near(c, *d));
                for d in last.filter(|d| common(three, boxes[*d]).is_some()) {
                    found.extend(moments_of([a, b, c, d], &[a, b, c, d].map(corners)));
                }
            }
        }
        found
    };
    let mut found: Vec<Moment> =
        (0..triangles.len()).into_par_iter().with_min_len(64).flat_map_iter(of_first).collect();
    found.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.faces.cmp(&b.faces)));
    found
}

/// Whether it is certain that a triangle is on one side of the plane of another all the time.
fn stay_apart(one: &Corners, [a, b, c]: &Corners) -> bool {
    let normal = normal(&difference(*b, *a), &difference(*c, *a));
    let mut sides = one.iter().map(|corner| common_sign(&volume(&normal, &difference(*corner, *a))));
    sides.next().flatten().is_some_and(|side| sides.all(|other| other == Some(side)))
}

fn moments_of(faces: [usize; 4], corners: &[Corners; 4]) -> Vec<Moment> {
    let [first, ..] = corners;
    let balls = |[a, b, c]: &Corners| [difference(*b, *a), difference(*c, *a), difference(*a, first[0])];
    if keeps_sign(&meeting(&corners.each_ref().map(balls)), HALVINGS) {
        return Vec::new();
    }
    let times = sign_changes(meeting(&integer_sides(corners)));
    let moment = |time: f64| {
        let now = corners.map(|places| places.map(|[from, to]| from.lerp(to, time)));
        let place = place_of(&now)?;
        now.iter().all(|face| is_inside(*face, place)).then_some(Moment { time, faces, place })
    };
    times.into_iter().filter_map(moment).collect()
}

/// When a form passes from one sign to the other, as near as halving comes to it. Roots that lie closer together count as one, or as none if they
/// are even in number.
fn sign_changes(form: Vec<BigInt>) -> Vec<f64> {
    let (mut found, mut open) = (Vec::new(), vec![(form, 0.0, 1.0_f64)]);
    while let Some((here, start, length)) = open.pop() {
        match variations(&here) {
            0 => {}
            changes if length < SHORTEST => found.extend((changes % 2 == 1).then_some(start + 0.5 * length)),
            _ => {
                let [first, second] = halves(&here);
                let middle = start + 0.5 * length;
                let is_zero_there = second.first().and_then(Number::sign) == Some(Ordering::Equal);
                if is_zero_there && sign_before_end(&first) != sign_after_start(&second) {
                    found.push(middle);
                }
                open.extend([(second, middle, 0.5 * length), (first, start, 0.5 * length)]);
            }
        }
    }
    found
}

/// The point in which four planes meet, from the three that are farthest from parallel.
fn place_of(faces: &[[DVec3; 3]; 4]) -> Option<DVec3> {
    let three = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].map(|three| common_point(&three.map(|k| faces[k])));
    three.into_iter().flatten().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(point, _)| point)
}

fn keeps_sign(form: &[Ball], halvings: usize) -> bool {
    if common_sign(form).is_some() {
        return true;
    }
    let Some(left) = halvings.checked_sub(1) else { return false };
    // Where the ends differ there is a root.
    let ends_differ = match (form.first().and_then(Number::sign), form.last().and_then(Number::sign)) {
        (Some(first), Some(last)) => first != last,
        _ => false,
    };
    !ends_differ && halves(form).iter().all(|half| keeps_sign(half, left))
}

/// The determinant of four planes n · x = d, zero when they have a point in common: a form of degree 9. Of each triangle it takes two
/// sides, and its first corner as seen from that of the first triangle, whose d is 0.
fn meeting<T: Number>(triangles: &[[Moving<T>; 3]; 4]) -> Vec<T> {
    let normals = triangles.each_ref().map(|[e, u, _]| normal(e, u));
    let term = |last: usize, three: [usize; 3]| {
        let [_, _, corner] = &triangles[last];
        product(&volume(&normals[last], corner), &determinant(three.map(|k| &normals[k])))
    };
    let [one, two, three] = [term(1, [0, 2, 3]), term(2, [0, 1, 3]), term(3, [0, 1, 2])];
    let sum = one.iter().zip(&two).map(|(one, two)| one.minus(two));
    sum.zip(&three).map(|(sum, three)| sum.plus(three)).collect()
}

/// The determinant of three normals, a form of degree 6.
fn determinant<T: Number>([l, m, n]: [&[[T; 3]; 3]; 3]) -> Vec<T> {
    let component = |normal: &[[T; 3]; 3], axis: usize| -> [T; 3] { from_fn(|k| normal[k][axis].clone()) };
    let term = |axis: usize| {
        let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
        let ahead = product(&component(m, i), &component(n, j));
        let behind = product(&component(m, j), &component(n, i));
        let cross: Vec<T> = ahead.iter().zip(&behind).map(|(a, b)| a.minus(b)).collect();
        product(&component(l, axis), &cross)
    };
    let [x, y, z] = [term(0), term(1), term(2)];
    x.iter().zip(&y).zip(&z).map(|((x, y), z)| x.plus(y).plus(z)).collect()
}

/// The product of two forms.
fn product<T: Number>(one: &[T], other: &[T]) -> Vec<T> {
    let coefficient = |k: usize| {
        let terms = (0..one.len()).filter(|i| *i <= k && k - i < other.len());
        terms.map(|i| one[i].times(&other[k - i])).reduce(|sum, term| sum.plus(&term))
    };
    (0..one.len() + other.len() - 1).filter_map(coefficient).collect()
}

/// As [`meeting`] takes them, in integers up to a common factor.
fn integer_sides(corners: &[Corners; 4]) -> [[Moving<BigInt>; 3]; 4] {
    let coordinates: [f64; 72] = from_fn(|k| corners[k / 18][k % 18 / 6][k % 6 / 3][k % 3]);
    let (integers, _) = integers(&coordinates);
    let between = |to: usize, from: usize| -> Moving<BigInt> {
        from_fn(|when| from_fn(|axis| &integers[6 * to + 3 * when + axis] - &integers[6 * from + 3 * when + axis]))
    };
    from_fn(|k| [between(3 * k + 1, 3 * k), between(3 * k + 2, 3 * k), between(3 * k, 0)])
}
