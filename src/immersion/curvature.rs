//! Curvatures per vertex.

use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use glam::DVec3;

use super::bending_angles;

/// Gaussian curvature of a metric, |V|: angle defect over a third of the area of the faces around.
///
/// At the boundary angles tell how the boundary turns and nothing of the curvature inside. There the value is the
/// mean of those around, from the inside outward; where a component has no interior vertex it is 0.
pub fn gaussian_curvatures(mesh: &Mesh, metric: &Metric) -> Vec<f64> {
    let areas = metric.vertex_areas(mesh);
    let inside = |v: VertexId| (!mesh.is_boundary_vertex(v)).then(|| metric.curvature(mesh, v) / areas[v.index()]);
    let mut known: Vec<Option<f64>> = mesh.vertices().map(inside).collect();
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
            return known.into_iter().map(|value| value.unwrap_or(0.0)).collect();
        }
        found.into_iter().for_each(|(v, value)| known[v.index()] = Some(value));
    }
}

/// Mean curvature (half the sum of the principal ones) of a surface with vertices at `positions`, |V|: length times
/// bending angle over the edges around, a quarter of each, over a third of the area of the faces around. It is
/// positive where the surface bulges to the front, and 0 at vertices without area.
pub fn mean_curvatures(mesh: &Mesh, positions: &[DVec3]) -> Vec<f64> {
    let mut sums = vec![0.0; mesh.vertex_count()];
    for (e, angle) in mesh.edges().zip(bending_angles(mesh, positions)) {
        let ends = mesh.edge_vertices(e).map(VertexId::index);
        let quarter = 0.25 * angle * positions[ends[0]].distance(positions[ends[1]]);
        ends.into_iter().for_each(|v| sums[v] += quarter);
    }
    let mut areas = vec![0.0; mesh.vertex_count()];
    for f in mesh.faces() {
        let corners = mesh.corners(f).map(VertexId::index);
        let [a, b, c] = corners.map(|v| positions[v]);
        let third = (b - a).cross(c - a).length() / 6.0;
        corners.into_iter().for_each(|v| areas[v] += third);
    }
    sums.iter().zip(&areas).map(|(sum, area)| if *area > 0.0 { sum / area } else { 0.0 }).collect()
}
