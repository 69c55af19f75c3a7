//! Positions made isometric.

mod guarantees;
mod known_shapes;
mod over_a_pass;

use glam::DVec3;
use immerse::mesh::{Mesh, VertexId};
use immerse::metric::Metric;
use immerse::polish::{Polish, Polished};
use std::ops::ControlFlow;

/// Polished by the defaults, with nothing that watches.
fn polished(mesh: &Mesh, metric: &Metric, positions: &[DVec3], pinned: &[VertexId]) -> Polished {
    polished_by(&Polish::default(), mesh, metric, positions, pinned)
}

fn polished_by(polish: &Polish, mesh: &Mesh, metric: &Metric, positions: &[DVec3], pinned: &[VertexId]) -> Polished {
    polish.apply(mesh, metric, positions, None, pinned, &mut |_| ControlFlow::Continue(()))
}
