//! Spheres: icospheres and meridians with parallels.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::limits::{LEAST_MERIDIANS, LEAST_PARALLELS, LEAST_SUBDIVISIONS, at_least, face_count, positive};
use super::polyhedra::{icosahedron, subdivide};
use crate::mesh::{MeshError, Surface};

/// An icosahedron whose edges are divided into `subdivisions` parts, projected to the sphere:
/// `10 n² + 2` vertices, `20 n²` faces.
///
/// # Errors
/// [`MeshError::Shape`] for a radius that is not positive, or no subdivisions.
pub fn sphere(radius: f64, subdivisions: usize) -> Result<Surface, MeshError> {
    positive("sphere", "radius", radius)?;
    at_least("sphere", "subdivisions", subdivisions, LEAST_SUBDIVISIONS)?;
    face_count("sphere", "subdivisions", 20.0 * (subdivisions as f64) * (subdivisions as f64), "lower `subdivisions`")?;
    let (corners, triangles) = icosahedron();
    let (mut positions, faces) = subdivide(&corners, &triangles, subdivisions);
    for p in &mut positions {
        *p *= radius / p.length();
    }
    Surface::from_positions(positions, &faces)
}

/// A sphere of `meridians` half circles and `parallels` circles between the poles, which are the first and
/// the last vertex: `meridians * parallels + 2` vertices, `2 * meridians * parallels` faces.
///
/// # Errors
/// [`MeshError::Shape`] for a radius that is not positive, fewer than 3 meridians or no parallels.
pub fn uv_sphere(radius: f64, meridians: usize, parallels: usize) -> Result<Surface, MeshError> {
    positive("uv_sphere", "radius", radius)?;
    at_least("uv_sphere", "meridians", meridians, LEAST_MERIDIANS)?;
    at_least("uv_sphere", "parallels", parallels, LEAST_PARALLELS)?;
    face_count(
        "uv_sphere",
        "meridians",
        2.0 * meridians as f64 * parallels as f64,
        "lower `meridians` or `parallels`",
    )?;
    let mut positions = vec![DVec3::new(0.0, 0.0, -radius)];
    for j in 1..=parallels {
        let (sin_polar, cos_polar) = libm::sincos(PI * j as f64 / (parallels + 1) as f64);
        for i in 0..meridians {
            let (sin, cos) = libm::sincos(TAU * i as f64 / meridians as f64);
            positions.push(radius * DVec3::new(sin_polar * cos, sin_polar * sin, -cos_polar));
        }
    }
    let north = positions.len() as u32;
    positions.push(DVec3::new(0.0, 0.0, radius));
    let vertex = |i: usize, j: usize| (1 + j * meridians + i % meridians) as u32;
    let mut faces = Vec::with_capacity(2 * meridians * parallels);
    for i in 0..meridians {
        faces.push([0, vertex(i + 1, 0), vertex(i, 0)]);
        for j in 0..parallels - 1 {
            let (a, b, c, d) = (vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
            faces.extend([[a, b, c], [a, c, d]]);
        }
        faces.push([vertex(i, parallels - 1), vertex(i + 1, parallels - 1), north]);
    }
    Surface::from_positions(positions, &faces)
}
