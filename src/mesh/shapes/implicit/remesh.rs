//! Isotropic remeshing of a closed surface given as a zero set (Botsch and Kobbelt 2004): split long edges,
//! collapse short ones, flip, smooth along the surface, and put every vertex back onto it.

use std::f64::consts::PI;

use glam::DVec3;

use crate::mesh::shapes::editable::{Diamond, Editable};

/// Rounds with splits and collapses, and rounds of Delaunay flips and smoothing after them.
const ROUNDS: usize = 8;
const FINAL_ROUNDS: usize = 12;
/// Least cosine between a triangle's normal and the surface's at its corners.
const LEAST_COSINE: f64 = 0.3;

/// A mesh near the zero set of `field` on its way to edges of length `target`.
pub(super) struct Remesher<F> {
    field: F,
    target: f64,
    mesh: Editable,
    positions: Vec<DVec3>,
    /// Unit gradients of the field.
    normals: Vec<DVec3>,
}

impl<F: Fn(DVec3) -> f64> Remesher<F> {
    pub(super) fn new(field: F, target: f64, positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let mesh = Editable::new(positions.len(), triangles);
        let mut remesher = Self { field, target, mesh, positions: Vec::new(), normals: Vec::new() };
        for p in positions {
            let (p, normal) = remesher.projected(p);
            remesher.positions.push(p);
            remesher.normals.push(normal);
        }
        remesher
    }

    /// Positions and triangles; positions that no triangle names are left over from collapses.
    pub(super) fn run(mut self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        for _ in 0..ROUNDS {
            self.split_long_edges();
            self.collapse_short_edges();
            self.flip(Self::evens_degrees);
            self.smooth();
        }
        for _ in 0..FINAL_ROUNDS {
            self.flip(Self::is_not_delaunay);
            self.smooth();
        }
        self.flip(Self::is_not_delaunay);
        (self.positions, self.mesh.triangles())
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        let step = 1e-4 * self.target;
        // Differences along the diagonals of a cube: four evaluations instead of six.
        [[1.0, -1.0, -1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, 1.0, 1.0]]
            .map(|corner| DVec3::from(corner) * (self.field)(p + step * DVec3::from(corner)))
            .iter()
            .sum::<DVec3>()
            / (4.0 * step)
    }

    /// The point of the surface near `p` and the unit normal there.
    fn projected(&self, mut p: DVec3) -> (DVec3, DVec3) {
        const NEWTON_STEPS: usize = 6;
        let mut gradient = self.gradient(p);
        for _ in 0..NEWTON_STEPS {
            let value = (self.field)(p);
            if value.abs() < 1e-9 * self.target || gradient.length_squared() < 1e-12 {
                break;
            }
            p -= (value / gradient.length_squared() * gradient).clamp_length_max(self.target);
            gradient = self.gradient(p);
        }
        (p, gradient.normalize_or_zero())
    }

    fn at(&self, v: u32) -> DVec3 {
        self.positions[v as usize]
    }

    fn midpoint(&self, d: &Diamond) -> (DVec3, DVec3) {
        self.projected(0.5 * (self.at(d.ends[0]) + self.at(d.ends[1])))
    }

    fn split_long_edges(&mut self) {
        for [u, v] in self.mesh.edges() {
            if self.at(u).distance(self.at(v)) <= 4.0 / 3.0 * self.target {
                continue;
            }
            if let Some(diamond) = self.mesh.diamond(u, v) {
                let (p, normal) = self.midpoint(&diamond);
                self.mesh.split(&diamond);
                self.positions.push(p);
                self.normals.push(normal);
            }
        }
    }

    fn collapse_short_edges(&mut self) {
        for [u, v] in self.mesh.edges() {
            if self.at(u).distance(self.at(v)) >= 4.0 / 5.0 * self.target {
                continue;
            }
            let Some(diamond) = self.mesh.diamond(u, v) else { continue };
            let (p, normal) = self.midpoint(&diamond);
            if self.mesh.can_collapse(&diamond) && self.fits(&diamond, p, normal) {
                self.mesh.collapse(&diamond);
                self.positions[u as usize] = p;
                self.normals[u as usize] = normal;
            }
        }
    }

    /// Whether the triangles around the edge, with the edge drawn together to `p`, are neither too long
    /// nor turned away from the surface.
    fn fits(&self, d: &Diamond, p: DVec3, normal: DVec3) -> bool {
        let [u, v] = d.ends;
        self.mesh
            .star(u)
            .chain(self.mesh.star(v))
            .filter(|corners| !(corners.contains(&u) && corners.contains(&v)))
            .all(|corners| {
                let moved = corners.map(|w| if w == u || w == v { p } else { self.at(w) });
                let short = moved.iter().all(|q| q.distance(p) <= 4.0 / 3.0 * self.target);
                short && unit_normal(moved).dot(normal) > LEAST_COSINE
            })
    }

    fn flip(&mut self, wanted: impl Fn(&Self, &Diamond) -> bool) {
        for [u, v] in self.mesh.edges() {
            if let Some(diamond) = self.mesh.diamond(u, v)
                && wanted(self, &diamond)
                && self.mesh.can_flip(&diamond)
                && self.stays_on_surface(&diamond)
            {
                self.mesh.flip(&diamond);
            }
        }
    }

    fn evens_degrees(&self, d: &Diamond) -> bool {
        let excess = |v: u32, change: i64| (self.mesh.degree(v) as i64 + change - 6).abs();
        let total = |ends: i64, opposite: i64| {
            d.ends.iter().map(|&v| excess(v, ends)).sum::<i64>()
                + d.opposite.iter().map(|&v| excess(v, opposite)).sum::<i64>()
        };
        total(-1, 1) < total(0, 0)
    }

    fn is_not_delaunay(&self, d: &Diamond) -> bool {
        let [u, v] = d.ends.map(|w| self.at(w));
        let opposite = d.opposite.iter().map(|&w| angle(u - self.at(w), v - self.at(w)));
        opposite.sum::<f64>() > PI + 1e-6
    }

    fn stays_on_surface(&self, d: &Diamond) -> bool {
        let ([a, b], [c, e]) = (d.ends, d.opposite);
        [[c, a, e], [e, b, c]].iter().all(|corners| {
            let normal = unit_normal(corners.map(|v| self.at(v)));
            corners.iter().all(|&v| normal.dot(self.normals[v as usize]) > LEAST_COSINE)
        })
    }

    /// Moves every vertex along its tangent plane to the area-weighted mean of the centroids around it.
    fn smooth(&mut self) {
        for v in 0..self.positions.len() {
            let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
            for corners in self.mesh.star(v as u32) {
                let [a, b, c] = corners.map(|w| self.at(w));
                let area = (b - a).cross(c - a).length();
                sum += area / 3.0 * (a + b + c);
                weight += area;
            }
            if weight > 0.0 {
                let (p, normal) = (self.positions[v], self.normals[v]);
                let offset = sum / weight - p;
                let (p, normal) = self.projected(p + offset - offset.dot(normal) * normal);
                self.positions[v] = p;
                self.normals[v] = normal;
            }
        }
    }
}

fn unit_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

fn angle(v: DVec3, w: DVec3) -> f64 {
    libm::atan2(v.cross(w).length(), v.dot(w))
}
