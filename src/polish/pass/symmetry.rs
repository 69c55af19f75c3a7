//! What takes one way down from a pass to the other.

use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::fmt;

/// A motion of space that takes a halfway model to itself, and one way down from it to the other. Applied twice it takes each way to
/// itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange {
    /// Per vertex: the one that it goes to.
    image: Vec<usize>,
    motion: Motion,
    /// So often the motion takes every vertex to itself.
    order: usize,
}

/// A rotation about the z axis, and perhaps a reflection in the plane z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Cosine and sine of the rotation.
    turn: [f64; 2],
    mirrors: bool,
}

/// A mesh that the symmetry of a halfway model does not take to itself.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{domain} takes vertex {vertex} of the mesh to no vertex")]
pub struct NoSymmetry {
    /// What the vertices were moved by.
    pub domain: Motion,
    /// The first one.
    pub vertex: usize,
}

impl Exchange {
    /// On a mesh whose vertices lie at `places`, |V|, around the origin, no two at the same one: `domain` moves these, and takes the mesh to
    /// itself; `model` takes the halfway model to itself. The powers of both are the identity after `order` of them.
    ///
    /// # Errors
    /// [`NoSymmetry`]
    pub fn new(places: &[DVec3], domain: Motion, model: Motion, order: usize) -> Result<Exchange, NoSymmetry> {
        let radius = places.iter().map(|p| p.length()).fold(0.0, f64::max);
        // Neighbouring cells are looked at too, because rounding may lead across their walls.
        let cell = |p: DVec3| (p / (CELL * radius)).round().as_i64vec3();
        let at: HashMap<_, usize> = places.iter().enumerate().map(|(v, p)| (cell(*p), v)).collect();
        let image = |(v, p): (usize, &DVec3)| {
            let there = cell(domain.of(*p));
            let near = (-1..=1).flat_map(|x| (-1..=1).flat_map(move |y| (-1..=1).map(move |z| [x, y, z])));
            let mut found = near.filter_map(|shift| at.get(&(there + glam::I64Vec3::from_array(shift))));
            found.next().copied().ok_or(NoSymmetry { domain, vertex: v })
        };
        let image = places.iter().enumerate().map(image).collect::<Result<_, _>>()?;
        Ok(Exchange { image, motion: model, order })
    }

    /// That of a halfway model with so many lobes, on a sphere around the origin, |V|. It exchanges sides.
    ///
    /// # Errors
    /// [`NoSymmetry`]
    pub fn of_sphere(sphere: &[DVec3], lobes: usize) -> Result<Exchange, NoSymmetry> {
        let turn = |parts: usize| Motion::turn(PI * parts as f64 / lobes as f64);
        Exchange::new(sphere, turn(1).mirrored(), turn(lobes + 1), 2 * lobes)
    }

    /// That of a figure eight that lies, on a torus that does not meet itself, |V|: the reflection in the plane of its ring, z = 0.
    ///
    /// # Errors
    /// [`NoSymmetry`]
    pub fn of_ring(torus: &[DVec3]) -> Result<Exchange, NoSymmetry> {
        Exchange::new(torus, Motion::MIRROR, Motion::MIRROR, 2)
    }

    /// The surface on the other way, |V|.
    pub fn exchanged(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let mut other = vec![DVec3::ZERO; positions.len()];
        self.image.iter().zip(positions).for_each(|(v, p)| other[*v] = self.motion.of(*p));
        other
    }

    /// The mean over all powers: what they all take to itself.
    pub(super) fn make_symmetric(&self, vectors: &mut [DVec3]) {
        self.average(vectors, 1);
    }

    /// The mean over the powers that take each way to itself.
    pub(super) fn make_turn_symmetric(&self, vectors: &mut [DVec3]) {
        self.average(vectors, 2);
    }

    /// Over every so manieth power of the exchange. Each orbit is averaged once and carried around, so that it is symmetric to
    /// the last bits that rotations leave.
    fn average(&self, vectors: &mut [DVec3], every: usize) {
        let powers = self.order / every;
        let forth: Vec<Motion> = (0..powers).map(|k| self.motion.power(k * every)).collect();
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
            let back = |(motion, v): (&Motion, &usize)| motion.inverse().of(vectors[*v]);
            let mean = forth.iter().zip(&orbit).map(back).sum::<DVec3>() / powers as f64;
            // Vertices that some powers keep come several times.
            for (motion, v) in forth.iter().zip(&orbit) {
                if !is_done[*v] {
                    vectors[*v] = motion.of(mean);
                    is_done[*v] = true;
                }
            }
        }
    }
}

impl Motion {
    /// The reflection in the plane z = 0.
    pub const MIRROR: Motion = Motion { turn: [1.0, 0.0], mirrors: true };

    /// The rotation by this angle, exact for quarters of a turn.
    pub fn turn(angle: f64) -> Motion {
        let (sin, cos) = libm::sincos(angle);
        Motion { turn: [cos, sin].map(|x| if x.abs() < 1e-15 { 0.0 } else { x }), mirrors: false }
    }

    /// The motion, and the reflection.
    pub fn mirrored(self) -> Motion {
        Motion { mirrors: !self.mirrors, ..self }
    }

    fn of(self, p: DVec3) -> DVec3 {
        let [cos, sin] = self.turn;
        DVec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, if self.mirrors { -p.z } else { p.z })
    }

    fn inverse(self) -> Motion {
        let [cos, sin] = self.turn;
        Motion { turn: [cos, -sin], ..self }
    }

    fn power(self, times: usize) -> Motion {
        let [cos, sin] = self.turn;
        let turn = (0..times).fold([1.0, 0.0], |[c, s], _| [c * cos - s * sin, c * sin + s * cos]);
        Motion { turn, mirrors: self.mirrors && times % 2 == 1 }
    }
}

/// "the turn by 90° about the z axis, with a reflection in the plane z = 0,".
impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let degrees = libm::atan2(self.turn[1], self.turn[0]).to_degrees().round();
        match (self.mirrors, degrees == 0.0) {
            (true, true) => write!(f, "the reflection in the plane z = 0"),
            (true, false) => {
                write!(f, "the turn by {degrees}° about the z axis, with a reflection in the plane z = 0,")
            }
            (false, _) => write!(f, "the turn by {degrees}° about the z axis"),
        }
    }
}

/// Vertices that are nearer than this share of the radius count as one place; edges are longer.
const CELL: f64 = 1e-7;
