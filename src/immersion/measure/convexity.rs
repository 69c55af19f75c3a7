//! Convex metrics: closed, of genus 0, nowhere of negative curvature. Such a metric has one convex shape and no other
//! (Alexandrov 1942, Pogorelov), and infinitely many with dents, each a part of it mirrored inward.

use crate::mesh::Mesh;
use crate::metric::Metric;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Whether a metric on a connected mesh is convex, up to a tenth of the curvature that a vertex has in the mean.
pub fn is_convex(mesh: &Mesh, metric: &Metric) -> bool {
    let is_sphere = mesh.euler_characteristic() == 2 && mesh.edges().all(|e| !mesh.is_boundary_edge(e));
    let least = -NEGLIGIBLE * 4.0 * PI / mesh.vertex_count() as f64;
    is_sphere && mesh.vertices().all(|v| metric.curvature(mesh, v) >= least)
}

/// How far the deepest vertex lies inside the convex hull of all: the depth of the largest inward dent. Directions are
/// sampled, so up to 0.05 % of the radius of the surface may be too much.
pub fn largest_dent(positions: &[DVec3]) -> f64 {
    // The distance from the hull is the least one from its support planes.
    let planes: Vec<(DVec3, f64)> = (0..DIRECTIONS)
        .into_par_iter()
        .map(|k| {
            let direction = spiral(k);
            (direction, positions.iter().map(|p| direction.dot(*p)).fold(f64::MIN, f64::max))
        })
        .collect();
    let depth = |p: &DVec3| planes.iter().map(|(n, height)| height - n.dot(*p)).fold(f64::MAX, f64::min);
    let depths: Vec<f64> = positions.par_iter().with_min_len(64).map(depth).collect();
    depths.into_iter().fold(0.0, f64::max)
}

/// Directions spread evenly over the sphere, on a spiral from pole to pole (Fibonacci's).
fn spiral(k: usize) -> DVec3 {
    let z = 1.0 - (2 * k + 1) as f64 / DIRECTIONS as f64;
    let angle = k as f64 * PI * (3.0 - 5.0_f64.sqrt());
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z)
}

const DIRECTIONS: usize = 4000;
const NEGLIGIBLE: f64 = 0.1;
