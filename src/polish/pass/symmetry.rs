//! The rotation that exchanges the sides of a surface.

use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;

/// A rotation about the z axis and where it takes each vertex. Applied twice it takes each side to itself.
#[derive(Clone, Debug, PartialEq)]
pub struct SideExchange {
    /// Per vertex: the one that it goes to.
    image: Vec<usize>,
    /// Cosine and sine of the rotation.
    turn: [f64; 2],
    /// So often the rotation takes every vertex to itself.
    order: usize,
}

/// A mesh that the symmetry of a halfway model does not take to itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the turn of the sphere by {degrees}° about the z axis, with a reflection in the equator, takes vertex {vertex} to no vertex"
)]
pub struct NoSymmetry {
    /// The first one.
    pub vertex: usize,
    /// The turn, rounded.
    pub degrees: usize,
}

impl SideExchange {
    /// That of a halfway model with so many lobes, on a sphere around the origin, |V|.
    ///
    /// # Errors
    /// [`NoSymmetry`]
    pub fn of_sphere(sphere: &[DVec3], lobes: usize) -> Result<SideExchange, NoSymmetry> {
        let radius = sphere.iter().map(|p| p.length()).fold(0.0, f64::max);
        // Neighbouring cells are looked at too, because rounding may lead across their walls.
        let cell = |p: DVec3| (p / (CELL * radius)).round().as_i64vec3();
        let at: HashMap<_, usize> = sphere.iter().enumerate().map(|(v, p)| (cell(*p), v)).collect();
        let around = |v: usize, p: DVec3| {
            let near = (-1..=1).flat_map(|x| (-1..=1).flat_map(move |y| (-1..=1).map(move |z| [x, y, z])));
            let mut found = near.filter_map(|shift| at.get(&(cell(p) + glam::I64Vec3::from_array(shift))));
            let degrees = 180 / lobes.max(1);
            found.next().copied().ok_or(NoSymmetry { vertex: v, degrees })
        };
        let part = turn_by(PI / lobes as f64);
        let images = sphere.iter().enumerate().map(|(v, p)| {
            let DVec3 { x, y, z } = turned(part, *p);
            around(v, DVec3::new(x, y, -z))
        });
        let turn = turn_by(PI * (lobes + 1) as f64 / lobes as f64);
        Ok(SideExchange { image: images.collect::<Result<_, _>>()?, turn, order: 2 * lobes })
    }

    /// The surface with its sides exchanged, |V|.
    pub fn exchanged(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let mut other = vec![DVec3::ZERO; positions.len()];
        self.image.iter().zip(positions).for_each(|(v, p)| other[*v] = turned(self.turn, *p));
        other
    }

    /// The mean over all rotations: what they take to itself, sides exchanged or not.
    pub(super) fn make_symmetric(&self, vectors: &mut [DVec3]) {
        self.average(vectors, 1);
    }

    /// The mean over the rotations that take each side to itself.
    pub(super) fn make_turn_symmetric(&self, vectors: &mut [DVec3]) {
        self.average(vectors, 2);
    }

    /// Over every so manieth power of the exchange. Each orbit is averaged once and carried around, so that it is symmetric to
    /// the last bits that rotations leave.
    fn average(&self, vectors: &mut [DVec3], every: usize) {
        let powers = self.order / every;
        let angle = |k: usize| turn_power(self.turn, k * every);
        let forth: Vec<[f64; 2]> = (0..powers).map(angle).collect();
        let mut is_done = vec![false; vectors.len()];
        for first in 0..vectors.len() {
            if is_done[first] {
                continue;
            }
            let mut orbit = Vec::with_capacity(powers);
            let mut v = first;
            for _ in 0..powers {
                orbit.push(v);
                (0..every).for_each(|_| v = self.image[v]);
            }
            let back = |([cos, sin], v): (&[f64; 2], &usize)| turned([*cos, -sin], vectors[*v]);
            let mean = forth.iter().zip(&orbit).map(back).sum::<DVec3>() / powers as f64;
            // Vertices on the axis come several times.
            for (turn, v) in forth.iter().zip(&orbit) {
                if !is_done[*v] {
                    vectors[*v] = turned(*turn, mean);
                    is_done[*v] = true;
                }
            }
        }
    }
}

/// Cosine and sine, exact for quarters of a turn.
fn turn_by(angle: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(angle);
    [cos, sin].map(|x| if x.abs() < 1e-15 { 0.0 } else { x })
}

/// The rotation by so many times the angle.
fn turn_power([cos, sin]: [f64; 2], times: usize) -> [f64; 2] {
    (0..times).fold([1.0, 0.0], |[c, s], _| [c * cos - s * sin, c * sin + s * cos])
}

fn turned([cos, sin]: [f64; 2], p: DVec3) -> DVec3 {
    DVec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z)
}

/// Vertices that are nearer than this share of the radius count as one place; edges are longer.
const CELL: f64 = 1e-7;
