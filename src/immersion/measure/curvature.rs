//! Curvatures per vertex.

use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use glam::{DVec2, DVec3};
use nalgebra::Matrix2;
use std::collections::BTreeSet;

use super::bending_angles;

/// Gaussian curvature of a metric, |V|: angle defect over a third of the area of the faces around. Defects that
/// rounding makes are 0.
///
/// At the boundary angles tell how the boundary turns (its geodesic curvature) and nothing of the curvature inside.
/// There the value is the mean of those around, from the inside outward; where a component has no interior vertex it is
/// 0.
pub fn gaussian_curvatures(mesh: &Mesh, metric: &Metric) -> Vec<f64> {
    let areas = metric.vertex_areas(mesh);
    let inside = |v: VertexId| {
        let defect = metric.curvature(mesh, v);
        let defect = if defect.abs() < ROUNDING { 0.0 } else { defect };
        (!mesh.is_boundary_vertex(v)).then(|| defect / areas[v.index()])
    };
    let known = extended(mesh, mesh.vertices().map(inside).collect());
    known.into_iter().map(|value| value.unwrap_or(0.0)).collect()
}

/// Angles in radians that are the rounding of 0.
const ROUNDING: f64 = 1e-13;

/// Values that are known inside, passed on outward as means; `None` stays where a component has none.
fn extended(mesh: &Mesh, mut known: Vec<Option<f64>>) -> Vec<Option<f64>> {
    loop {
        let mean_around = |v: VertexId| {
            let corners = mesh.outgoing(v).flat_map(|h| mesh.corners(h.face()));
            let (sum, count) = corners
                .filter_map(|corner| known[corner.index()])
                .fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
            (count > 0).then(|| (v, sum / f64::from(count)))
        };
        let found: Vec<(VertexId, f64)> =
            mesh.vertices().filter(|v| known[v.index()].is_none()).filter_map(mean_around).collect();
        if found.is_empty() {
            return known;
        }
        found.into_iter().for_each(|(v, value)| known[v.index()] = Some(value));
    }
}

/// Mean curvature (half the sum of the principal ones) of a surface with vertices at `positions`, |V|: length times
/// bending angle over the edges around, a quarter of each, over a third of the area of the faces around. It is
/// positive where the surface bulges to the front, and 0 at vertices without area.
///
/// Nothing is known of the bending across the boundary, and edges that bend are not half of those around there. So the
/// values inside are extended to it, linearly where those within three edges say how they change and as their mean
/// otherwise; where a component has no interior vertex, the edges around are all there is.
pub fn mean_curvatures(mesh: &Mesh, positions: &[DVec3]) -> Vec<f64> {
    let mut sums = vec![0.0; mesh.vertex_count()];
    for (e, angle) in mesh.edges().zip(bending_angles(mesh, positions)) {
        let ends = mesh.edge_vertices(e).map(VertexId::index);
        let angle = if angle.abs() < ROUNDING { 0.0 } else { angle };
        let quarter = 0.25 * angle * positions[ends[0]].distance(positions[ends[1]]);
        ends.into_iter().for_each(|v| sums[v] += quarter);
    }
    let mut normals = vec![DVec3::ZERO; mesh.vertex_count()];
    let mut areas = vec![0.0; mesh.vertex_count()];
    for f in mesh.faces() {
        let corners = mesh.corners(f).map(VertexId::index);
        let [a, b, c] = corners.map(|v| positions[v]);
        let normal = (b - a).cross(c - a);
        corners.into_iter().for_each(|v| {
            normals[v] += normal;
            areas[v] += normal.length() / 6.0;
        });
    }
    let over_area = |v: usize| if areas[v] > 0.0 { sums[v] / areas[v] } else { 0.0 };
    let inside: Vec<Option<f64>> =
        mesh.vertices().map(|v| (!mesh.is_boundary_vertex(v)).then(|| over_area(v.index()))).collect();
    let means = extended(mesh, inside.clone());
    let value = |v: VertexId| match inside[v.index()] {
        Some(value) => value,
        None => extrapolated(mesh, positions, normals[v.index()], &inside, v)
            .or(means[v.index()])
            .unwrap_or_else(|| over_area(v.index())),
    };
    mesh.vertices().map(value).collect()
}

/// Edges from a vertex of the boundary to those whose values are extended to it.
const REACH: usize = 3;
/// Values are extended along a direction at most this many standard deviations from their middle; farther, rounding
/// and noise would be.
const FARTHEST: f64 = 3.3;

/// The value at a vertex of the linear function, in its tangent plane, that is closest to the values around, weighted
/// by the inverse square of the distance. `None` if there are none, or no plane.
fn extrapolated(mesh: &Mesh, positions: &[DVec3], normal: DVec3, values: &[Option<f64>], v: VertexId) -> Option<f64> {
    let normal = normal.try_normalize()?;
    let across = normal.any_orthonormal_vector();
    let axes = [across, normal.cross(across)];
    let here = positions[v.index()];
    let sample = |w: VertexId| {
        let offset = positions[w.index()] - here;
        let weight = 1.0 / offset.length_squared();
        let place = DVec2::from_array(axes.map(|axis| axis.dot(offset)));
        values[w.index()].filter(|_| weight.is_finite()).map(|value| (place, value, weight))
    };
    let samples: Vec<(DVec2, f64, f64)> = around(mesh, v, REACH).into_iter().filter_map(sample).collect();
    let total: f64 = samples.iter().map(|(.., weight)| weight).sum();
    if samples.is_empty() {
        return None;
    }
    let mean = |of: &dyn Fn(DVec2, f64) -> f64| samples.iter().map(|&(p, x, w)| w * of(p, x)).sum::<f64>() / total;
    let (middle, value) = (DVec2::new(mean(&|p, _| p.x), mean(&|p, _| p.y)), mean(&|_, x| x));
    let spread = |a: usize, b: usize| mean(&|p, _| (p - middle)[a] * (p - middle)[b]);
    let eigen = Matrix2::new(spread(0, 0), spread(0, 1), spread(0, 1), spread(1, 1)).symmetric_eigen();
    // Along each principal direction of where the samples are, as far as they say how the values change.
    let slope = |k: usize| {
        let axis = DVec2::new(eigen.eigenvectors[(0, k)], eigen.eigenvectors[(1, k)]);
        let (variance, distance) = (eigen.eigenvalues[k], -middle.dot(axis));
        let change = mean(&|p, x| (p - middle).dot(axis) * (x - value));
        let is_near = distance * distance <= FARTHEST * FARTHEST * variance;
        if is_near && variance > 0.0 { change / variance * distance } else { 0.0 }
    };
    Some(value + slope(0) + slope(1))
}

/// The vertices that are at most so many edges away, in order.
fn around(mesh: &Mesh, v: VertexId, edges: usize) -> BTreeSet<VertexId> {
    let mut found = BTreeSet::from([v]);
    for _ in 0..edges {
        let corners = |v: &VertexId| mesh.outgoing(*v).flat_map(|h| mesh.corners(h.face())).collect::<Vec<_>>();
        let next: Vec<VertexId> = found.iter().flat_map(corners).collect();
        found.extend(next);
    }
    found
}
