//! Cuts polygons into triangles.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// The outline of a polygon meets itself, so it has no inside that could be cut.
pub(super) struct CrossesItself;

/// Adds the triangles of a polygon whose corners are these vertices, in the orientation of the polygon.
///
/// Every corner stays a vertex of the triangles, also one on a straight side, since a neighbour may have an edge that
/// ends there. The polygon may be concave and a little bent: what is inside is decided in the plane that fits it best.
/// - A convex polygon is cut into the fan around its first corner. A bent one as well, if it is convex as seen along its
///   normal (that of its area vector), so neither half of a bent quadrilateral is turned over.
/// - Any other is given its constrained Delaunay triangulation. Cutting ears would do, were it not for straight corners,
///   which make flat ears or are left out; Delaunay triangles are the farthest from flat.
/// - Where there are no positions, or all lie on one line, there is no inside, and the fan is as good as any other, if no vertex is
///   visited twice.
///
/// # Errors
/// [`CrossesItself`], also if the outline only touches itself, or goes along a side again. It may visit a vertex twice, as it does
/// where a hole is joined to the outside by a cut, or a slit leads to a vertex inside: what is walked both ways has the inside
/// on both sides. So every side is one of exactly one triangle, and no corner is lost.
pub(super) fn cut(
    corners: &[u32],
    positions: Option<&[DVec3]>,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), CrossesItself> {
    let points: Option<Vec<DVec3>> = match positions {
        Some(all) if corners.len() > 3 => corners.iter().map(|&v| all.get(v as usize).copied()).collect(),
        _ => None,
    };
    let Some(points) = points else {
        if corners.len() > 3 && names_twice(corners) {
            return Err(CrossesItself);
        }
        triangles.extend(fan(corners.len()).map(|t| t.map(|k| corners[k])));
        return Ok(());
    };
    let (outline, flat) = distinct(&points);
    triangles.extend(flat.into_iter().map(|t| t.map(|k| corners[k])));
    let placed: Vec<DVec3> = outline.iter().map(|&k| points[k]).collect();
    let outline: Vec<u32> = outline.iter().map(|&k| corners[k]).collect();
    match in_plane(&placed) {
        Some(flattened) if outline.len() > 3 && !is_convex(&flattened) => {
            triangles.extend(delaunay(&outline, &flattened)?);
        }
        None if outline.len() > 3 && names_twice(&outline) => return Err(CrossesItself),
        _ => triangles.extend(fan(outline.len()).map(|t| t.map(|k| outline[k]))),
    }
    Ok(())
}

/// Whether a vertex is more than one of the corners, so that only places can tell how to cut.
fn names_twice(corners: &[u32]) -> bool {
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted.array_windows().any(|[a, b]| a == b)
}

fn fan(corners: usize) -> impl Iterator<Item = [usize; 3]> {
    (1..corners.saturating_sub(1)).map(|k| [0, k, k + 1])
}

/// The corners that do not lie where the one before them does. Those that do get a flat triangle each, which keeps
/// them connected: they may be joined later.
fn distinct(points: &[DVec3]) -> (Vec<usize>, Vec<[usize; 3]>) {
    let n = points.len();
    let (mut outline, mut flat): (Vec<usize>, Vec<[usize; 3]>) = (vec![0], Vec::new());
    for k in 1..n {
        let last = outline[outline.len() - 1];
        match (points[last] == points[k], points[k] == points[0]) {
            (true, _) if n - flat.len() > 3 => flat.push([last, k, (k + 1) % n]),
            (false, true) if k + 1 == n && n - flat.len() > 3 => flat.push([last, k, 0]),
            _ => outline.push(k),
        }
    }
    (outline, flat)
}

/// The polygon as seen along its normal, counterclockwise, and scaled to unit size. `None` if it lies on a line.
fn in_plane(points: &[DVec3]) -> Option<Vec<DVec2>> {
    /// Heights below this, compared with the size of the polygon, are rounding.
    const FLAT: f64 = 1e-12;
    let size = points.iter().map(|&p| (p - points[0]).abs().max_element()).fold(0.0, f64::max);
    if size == 0.0 || !size.is_finite() {
        return None;
    }
    let local: Vec<DVec3> = points.iter().map(|&p| (p - points[0]) / size).collect();
    let area_vector: DVec3 = local.windows(2).map(|side| side[0].cross(side[1])).sum();
    // A figure eight may have no area; it has a plane still.
    let farthest = |measure: &dyn Fn(DVec3) -> DVec3| {
        local.iter().map(|&p| measure(p)).max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
    };
    let normal = match area_vector.length() > FLAT {
        true => area_vector,
        false => farthest(&|p| p).and_then(|far| farthest(&|p| far.cross(p)))?,
    };
    if normal.length() <= FLAT {
        return None;
    }
    let (u, v) = normal.normalize().any_orthonormal_pair();
    // What is rounding only is zero: the triangulation takes no numbers that are nearly zero.
    let snap = |x: f64| if x.abs() < 1e-30 { 0.0 } else { x };
    Some(local.into_iter().map(|p| DVec2::new(snap(p.dot(u)), snap(p.dot(v)))).collect())
}

/// Whether an outline turns left at every corner, by more than rounding or a nearly straight corner would, and goes
/// around once.
fn is_convex(outline: &[DVec2]) -> bool {
    const STRAIGHT: f64 = 1e-3;
    let n = outline.len();
    let mut turned = 0.0;
    for k in 0..n {
        let [a, b, c] = [outline[k], outline[(k + 1) % n], outline[(k + 2) % n]];
        let (before, after) = (b - a, c - b);
        let (left, ahead) = (before.perp_dot(after), before.dot(after));
        if left <= STRAIGHT * before.length() * after.length() {
            return false;
        }
        turned += libm::atan2(left, ahead);
    }
    turned < 1.5 * TAU
}

/// The constrained Delaunay triangulation of what is inside a counterclockwise outline of these vertices.
fn delaunay(outline: &[u32], points: &[DVec2]) -> Result<Vec<[u32; 3]>, CrossesItself> {
    let mut all = ConstrainedDelaunayTriangulation::<Corner>::new();
    let mut places = Vec::with_capacity(outline.len());
    for (&vertex, p) in outline.iter().zip(points) {
        let corner = Corner { place: Point2::new(p.x, p.y), vertex };
        places.push(all.insert(corner).map_err(|_| CrossesItself)?);
    }
    // Two vertices in one place are one corner there, and it is that of the last of them.
    if outline.iter().zip(&places).any(|(&vertex, &place)| all.vertex(place).data().vertex != vertex) {
        return Err(CrossesItself);
    }
    let sides = || places.iter().zip(places.iter().cycle().skip(1)).map(|(&a, &b)| (a, b));
    for (a, b) in sides() {
        if a == b || !all.can_add_constraint(a, b) {
            return Err(CrossesItself);
        }
        all.add_constraint(a, b);
    }
    // How often the outline goes around a face: once more on the left of a side than on its right.
    let mut passes = vec![0; all.num_directed_edges()];
    let mut is_side = vec![false; all.num_directed_edges()];
    for (a, b) in sides() {
        // A side that leads through another corner is no edge.
        let edge = all.get_edge_from_neighbors(a, b).ok_or(CrossesItself)?;
        if std::mem::replace(&mut is_side[edge.fix().index()], true) {
            return Err(CrossesItself);
        }
        passes[edge.fix().index()] += 1;
        passes[edge.rev().fix().index()] -= 1;
    }
    let mut around: Vec<Option<i32>> = vec![None; all.num_all_faces()];
    around[all.outer_face().fix().index()] = Some(0);
    let mut crossed: VecDeque<_> = all.directed_edges().filter(|edge| edge.face().is_outer()).collect();
    while let Some(edge) = crossed.pop_front() {
        let (here, there) = (edge.face().fix().index(), edge.rev().face().fix().index());
        if around[there].is_some() {
            continue;
        }
        around[there] = around[here].map(|times| times + passes[edge.rev().fix().index()]);
        crossed.extend([edge.rev().next(), edge.rev().prev()]);
    }
    if around.iter().flatten().any(|times| !(0..=1).contains(times)) {
        return Err(CrossesItself);
    }
    // A side with the outside on its left leads out of the polygon and back again.
    if all.directed_edges().any(|edge| is_side[edge.fix().index()] && around[edge.face().fix().index()] != Some(1)) {
        return Err(CrossesItself);
    }
    let inside = all.inner_faces().filter(|face| around[face.fix().index()] == Some(1));
    let triangles: Vec<_> = inside.map(|face| face.vertices().map(|vertex| vertex.data().vertex)).collect();
    if triangles.is_empty() { Err(CrossesItself) } else { Ok(triangles) }
}

/// A corner in the plane.
struct Corner {
    place: Point2<f64>,
    vertex: u32,
}

impl HasPosition for Corner {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.place
    }
}
