//! Where a surface passes through itself.

use glam::DVec3;
use rayon::prelude::*;

use crate::algebra::{box_of, overlaps, share_a_vertex};
use crate::render::Plane;

/// Where two triangles cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Ends of the segment they have in common.
    pub ends: [DVec3; 2],
    /// Sine of the angle between their planes.
    pub sine: f64,
    /// The triangles.
    pub triangles: [usize; 2],
}

/// Segments in which the triangles are cut by a plane, in their order. All corners must be finite.
pub fn cuts(triangles: &[[u32; 3]], positions: &[DVec3], plane: Plane) -> Vec<[DVec3; 2]> {
    let through = plane.normal * plane.offset;
    let segment = |corners: &[u32; 3]| cut(corners.map(|vertex| positions[vertex as usize]), through, plane.normal);
    triangles.par_iter().filter_map(segment).collect()
}

/// Crossings of triangles that share no vertex, ordered by the triangles.
///
/// Triangles that lie in one plane cross nowhere. All corners must be finite.
pub fn self_intersections(triangles: &[[u32; 3]], positions: &[DVec3]) -> Vec<Crossing> {
    let corners = |index: usize| triangles[index].map(|vertex| positions[vertex as usize]);
    let boxes: Vec<_> = (0..triangles.len()).into_par_iter().map(|index| box_of(corners(index).into_iter())).collect();
    overlaps(&boxes, |index, other| {
        if share_a_vertex(&triangles[index], &triangles[other]) {
            return None;
        }
        let (ends, sine) = crossing(corners(index), corners(other))?;
        Some(Crossing { ends, sine, triangles: [index, other] })
    })
}

/// The segment two triangles have in common, if they cross (Möller 1997).
fn crossing(one: [DVec3; 3], other: [DVec3; 3]) -> Option<([DVec3; 2], f64)> {
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    let (plane_one, plane_other) = (normal(one), normal(other));
    let [p, q] = cut(one, other[0], plane_other)?;
    let [r, s] = cut(other, one[0], plane_one)?;
    // Both cuts lie on the line the planes share; keep what they have in common.
    let across = plane_one.cross(plane_other);
    let line = across.try_normalize()?;
    let sine = across.length() / (plane_one.length() * plane_other.length());
    let ordered = |[a, b]: [DVec3; 2]| if a.dot(line) <= b.dot(line) { [a, b] } else { [b, a] };
    let ([p, q], [r, s]) = (ordered([p, q]), ordered([r, s]));
    let from = if p.dot(line) >= r.dot(line) { p } else { r };
    let to = if q.dot(line) <= s.dot(line) { q } else { s };
    (from.dot(line) < to.dot(line)).then_some(([from, to], sine))
}

/// Where a plane cuts the edges of a triangle.
fn cut(triangle: [DVec3; 3], point: DVec3, normal: DVec3) -> Option<[DVec3; 2]> {
    let heights = triangle.map(|corner| (corner - point).dot(normal));
    let mut ends = (0..3).filter_map(|k| {
        let next = (k + 1) % 3;
        let crosses = (heights[k] < 0.0) != (heights[next] < 0.0);
        crosses.then(|| triangle[k].lerp(triangle[next], heights[k] / (heights[k] - heights[next])))
    });
    Some([ends.next()?, ends.next()?])
}
