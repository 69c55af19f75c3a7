//! Spheres that a quarter turn with a reflection takes to themselves.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

use super::limits::{LEAST_SIDES, LEAST_SUBDIVISIONS, at_least, face_count, positive};
use crate::mesh::{MeshError, Surface};

/// An octahedron, or another bipyramid over a polygon of so many `sides`, whose edges are divided into `subdivisions` parts and
/// bent onto the sphere of this `radius`. Circles of latitude are as far apart as the poles allow, the one that is k away from a pole
/// has `sides · k` vertices, evenly spaced. So the mesh looks the same after a turn by one side about the z axis, and after the
/// reflection in the equator: `2 sides n²` faces, `sides n² + 2` vertices.
///
/// # Errors
/// [`MeshError::Shape`] for a radius that is not positive, no subdivisions, or fewer than 3 sides.
pub fn octasphere(radius: f64, subdivisions: usize, sides: usize) -> Result<Surface, MeshError> {
    positive("octasphere", "radius", radius)?;
    at_least("octasphere", "subdivisions", subdivisions, LEAST_SUBDIVISIONS)?;
    at_least("octasphere", "sides", sides, LEAST_SIDES)?;
    let faces = 2.0 * sides as f64 * (subdivisions as f64) * (subdivisions as f64);
    face_count("octasphere", "subdivisions", faces, "lower `subdivisions`")?;
    let rings = Rings { subdivisions, sides };
    let mut positions = Vec::with_capacity(sides * subdivisions * subdivisions + 2);
    for (is_south, ring) in (0..=subdivisions).map(|k| (false, k)).chain((0..subdivisions).map(|k| (true, k))) {
        let (sin, cos) = libm::sincos(FRAC_PI_2 * ring as f64 / subdivisions as f64);
        let height = if ring == subdivisions { 0.0 } else { cos };
        let count = rings.count(ring);
        positions.extend((0..count).map(|j| {
            let (y, x) = libm::sincos(TAU * j as f64 / count as f64);
            radius * DVec3::new(sin * x, sin * y, if is_south { -height } else { height })
        }));
    }
    let mut faces = Vec::with_capacity(2 * sides * subdivisions * subdivisions);
    for is_south in [false, true] {
        let mut add = |[a, b, c]: [u32; 3]| faces.push(if is_south { [a, c, b] } else { [a, b, c] });
        for (side, ring) in (0..sides).flat_map(|side| (0..subdivisions).map(move |ring| (side, ring))) {
            let inner = |i: usize| rings.vertex(is_south, ring, side * ring + i);
            let outer = |i: usize| rings.vertex(is_south, ring + 1, side * (ring + 1) + i);
            (0..=ring).for_each(|i| add([inner(i), outer(i), outer(i + 1)]));
            (0..ring).for_each(|i| add([inner(i), outer(i + 1), inner(i + 1)]));
        }
    }
    Surface::from_positions(positions, &faces)
}

/// How vertices are numbered: circle by circle from the north pole to the equator, then from the south pole.
struct Rings {
    subdivisions: usize,
    sides: usize,
}

impl Rings {
    /// Vertices on a circle.
    fn count(&self, ring: usize) -> usize {
        if ring == 0 { 1 } else { self.sides * ring }
    }

    /// Vertices on the circles before.
    fn before(&self, ring: usize) -> usize {
        if ring == 0 { 0 } else { 1 + self.sides * ring * (ring - 1) / 2 }
    }

    fn vertex(&self, is_south: bool, ring: usize, j: usize) -> u32 {
        let south = if is_south && ring < self.subdivisions { self.before(self.subdivisions + 1) } else { 0 };
        (south + self.before(ring) + j % self.count(ring)) as u32
    }
}
