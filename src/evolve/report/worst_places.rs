//! Where a frame is worst, for those who have to mend it.

use super::frame_report::{BendingError, Places};
use crate::evolve::state::State;
use crate::immersion::{bending_angles, length_errors};
use crate::mesh::{EdgeId, FaceId, Mesh, VertexId};
use crate::metric::Metric;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// So many rims and pinch points are named.
const NAMED: usize = 5;

/// The worst places of a surface.
pub(super) fn worst_places(
    mesh: &Mesh,
    metric: &Metric,
    positions: &[DVec3],
    rims: &[EdgeId],
    pinch_points: &[VertexId],
) -> Places {
    let ends = |e: EdgeId| mesh.edge_vertices(e).map(|v| mesh.file_vertex(v));
    let errors = length_errors(mesh, metric, positions);
    let size = |e: &EdgeId| errors[e.index()].abs();
    let worst = mesh.edges().max_by(|a, b| size(a).total_cmp(&size(b)));
    let thinness = |f: FaceId| {
        let longest = f.halfedges().map(|h| metric.length(mesh.edge(h))).into_iter().fold(0.0, f64::max);
        2.0 * metric.area(f) / (longest * longest)
    };
    let thinnest = mesh.faces().map(|f| (thinness(f), f)).min_by(|a, b| a.0.total_cmp(&b.0));
    let inner = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v));
    let curvatures = inner.map(|v| (metric.curvature(mesh, v), v));
    let sharpest = curvatures.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    Places {
        worst_edge: worst.map(ends).unwrap_or_default(),
        rims: rims.iter().take(NAMED).map(|&e| ends(e)).collect(),
        pinch_points: pinch_points.iter().take(NAMED).map(|&v| mesh.file_vertex(v)).collect(),
        thinnest_face: thinnest.map_or(0, |(_, f)| mesh.file_face(f)),
        thinness: thinnest.map_or(0.0, |(thinness, _)| thinness),
        sharpest_vertex: sharpest.map_or(0, |(_, v)| mesh.file_vertex(v)),
        sharpest_degrees: sharpest.map_or(0.0, |(curvature, _)| curvature.to_degrees()),
    }
}

/// Sums over the edges of a component that have a target bending angle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct BendingSums {
    squares: f64,
    lengths: f64,
    /// In radians, with the ends of its edge.
    largest: (f64, [usize; 2]),
}

impl BendingSums {
    /// `None` without targets. `positions` are those of the component.
    pub fn of(state: &State, positions: &[DVec3]) -> Option<BendingSums> {
        let mesh = state.mesh();
        let (targets, is_bent) = state.target_angles()?;
        let angles = bending_angles(mesh, positions);
        let mut sums = BendingSums::default();
        for e in mesh.interior_edges().filter(|e| is_bent[e.index()]) {
            // Angles are known up to full turns.
            let off = (angles[e.index()] - targets[e.index()] + PI).rem_euclid(TAU) - PI;
            let length = state.metric().length(e);
            sums.squares += length * off * off;
            sums.lengths += length;
            if off.abs() > sums.largest.0 || sums.largest == (0.0, [0; 2]) {
                sums.largest = (off.abs(), mesh.edge_vertices(e).map(|v| mesh.file_vertex(v)));
            }
        }
        (sums.lengths > 0.0).then_some(sums)
    }

    /// Of two components.
    pub fn with(self, other: BendingSums) -> BendingSums {
        let largest = if other.largest.0 > self.largest.0 { other.largest } else { self.largest };
        BendingSums { squares: self.squares + other.squares, lengths: self.lengths + other.lengths, largest }
    }

    pub fn error(&self) -> BendingError {
        let (max, edge) = self.largest;
        let rms = (self.squares / self.lengths).sqrt();
        BendingError { rms_degrees: rms.to_degrees(), max_degrees: max.to_degrees(), edge }
    }
}
