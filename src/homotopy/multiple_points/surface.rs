//! Double curves and triple points of a surface in general position.

use crate::algebra::{box_of, overlaps, share_a_vertex};
use crate::mesh::union_find::root;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How sheets of a surface pass through each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sheets {
    /// Curves in which two sheets cross; one that crosses itself or another counts as it is walked along its sheets.
    pub double_curves: usize,
    /// Pairs of triangles that cross.
    pub double_segments: usize,
    /// Points in which three sheets cross.
    pub triple_points: usize,
}

/// Where an edge, by its ends, goes through a triangle, by its number. A double curve goes from one such point to the next.
type Piercing = ([u32; 2], usize);

impl Sheets {
    /// Of triangles in general position.
    pub(super) fn of(triangles: &[[u32; 3]], positions: &[DVec3]) -> Sheets {
        let places = |index: usize| triangles[index].map(|v| positions[v as usize]);
        let boxes: Vec<_> = (0..triangles.len()).map(|index| box_of(places(index).into_iter())).collect();
        let crossings =
            overlaps(&boxes, |one, other| crossing(triangles, positions, one, other).map(|ends| ([one, other], ends)));
        let mut partners_of = vec![Vec::new(); triangles.len()];
        crossings.iter().for_each(|([one, other], _)| partners_of[*one].push(*other));
        let crosses = |one: usize, other: usize| partners_of[one].binary_search(&other).is_ok();
        let triple_points = (0..triangles.len())
            .map(|a| {
                let partners = &partners_of[a];
                let triples = partners
                    .iter()
                    .enumerate()
                    .flat_map(|(k, b)| partners[k + 1..].iter().filter(|c| crosses(*b, **c)).map(|c| [a, *b, *c]));
                triples.filter(|faces| meet(&faces.map(places))).count()
            })
            .sum();
        let segments: Vec<[Piercing; 2]> = crossings.into_iter().map(|(_, ends)| ends).collect();
        Sheets { double_curves: curves(&segments), double_segments: segments.len(), triple_points }
    }
}

/// The point that three planes through triangles have in common, and how far from parallel they are: the volume that
/// their unit normals span.
pub(super) fn common_point(faces: &[[DVec3; 3]; 3]) -> Option<(DVec3, f64)> {
    let origin = faces[0][0];
    let [l, m, n] = faces.map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero());
    let [q, r] = [m.dot(faces[1][0] - origin), n.dot(faces[2][0] - origin)];
    let volume = l.dot(m.cross(n));
    (volume != 0.0).then(|| (origin + (n.cross(l) * q + l.cross(m) * r) / volume, volume.abs()))
}

/// Whether a point of the plane of a triangle lies inside.
pub(super) fn is_inside([a, b, c]: [DVec3; 3], point: DVec3) -> bool {
    let normal = (b - a).cross(c - a);
    [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| (to - from).cross(point - from).dot(normal) > 0.0)
}

fn meet(faces: &[[DVec3; 3]; 3]) -> bool {
    common_point(faces).is_some_and(|(point, _)| faces.iter().all(|face| is_inside(*face, point)))
}

/// The ends of the segment in which two triangles cross, if they do.
fn crossing(triangles: &[[u32; 3]], positions: &[DVec3], one: usize, other: usize) -> Option<[Piercing; 2]> {
    if share_a_vertex(&triangles[one], &triangles[other]) {
        return None;
    }
    let through = |of: usize, face: usize| {
        let [a, b, c] = triangles[of];
        let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| [from.min(to), from.max(to)]);
        let goes_through = move |edge: &[u32; 2]| pierces(positions, *edge, triangles[face]);
        edges.into_iter().filter(goes_through).map(move |edge| (edge, face))
    };
    let mut ends = through(one, other).chain(through(other, one));
    Some([ends.next()?, ends.next()?])
}

/// Whether an edge goes through a triangle. The same edge and triangle give the same answer, whichever faces of the edge ask.
fn pierces(positions: &[DVec3], edge: [u32; 2], triangle: [u32; 3]) -> bool {
    let [p, q] = edge.map(|v| positions[v as usize]);
    let [a, b, c] = triangle.map(|v| positions[v as usize]);
    let normal = (b - a).cross(c - a);
    let is_above = |point: DVec3| (point - a).dot(normal) > 0.0;
    let is_left = |from: DVec3, to: DVec3| (from - p).cross(to - p).dot(q - p) > 0.0;
    let sides = [is_left(a, b), is_left(b, c), is_left(c, a)];
    is_above(p) != is_above(q) && (sides == [true; 3] || sides == [false; 3])
}

/// How many curves segments make whose ends are the same points.
fn curves(segments: &[[Piercing; 2]]) -> usize {
    let mut numbers: BTreeMap<Piercing, u32> = BTreeMap::new();
    for end in segments.iter().flatten() {
        let next = numbers.len() as u32;
        numbers.entry(*end).or_insert(next);
    }
    let mut parents: Vec<u32> = (0..numbers.len() as u32).collect();
    let mut curves = parents.len();
    for [one, other] in segments {
        let [one, other] = [one, other].map(|end| root(&mut parents, numbers[end]));
        if one != other {
            parents[other as usize] = one;
            curves -= 1;
        }
    }
    curves
}
