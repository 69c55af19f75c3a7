//! Surfaces that move: what is found between two of them, and what becomes of it in a film.

mod intervals;
mod multiple_points;
mod rims;

use glam::DVec3;
use immerse::homotopy::{Event, events_between};
use immerse::mesh::Mesh;

/// Two faces at an edge: corners a, b, c and b, a, d.
fn hinge() -> Mesh {
    Mesh::from_faces(4, &[[0, 1, 2], [1, 0, 3]]).expect("a hinge")
}

fn points(all: &[[f64; 3]]) -> Vec<DVec3> {
    all.iter().map(|&place| DVec3::from_array(place)).collect()
}

/// A hinge along x whose second face is turned about it to this height and depth.
fn open_to(y: f64, z: f64) -> Vec<DVec3> {
    points(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.5, y, z]])
}

fn found(mesh: &Mesh, from: &[DVec3], to: &[DVec3]) -> Vec<Event> {
    events_between(mesh, from, to)
}
