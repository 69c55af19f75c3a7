//! Edge flips of a triangulation under conformal scaling: to Delaunay, and back.

use super::triangulation::Triangulation;
use crate::metric::MetricError;
use crate::metric::triangle::angles;
use std::f64::consts::PI;

/// How far an edge must be from Delaunay, as a sum of two cosines, to be flipped.
const DELAUNAY_SLACK: f64 = 1e-10;
/// Flips per edge after which a Delaunay triangulation is not expected any more.
const FLIPS_PER_EDGE: usize = 100;
/// Flips per edge in one step after which scale factors are too far from those before.
const FLIPS_PER_STEP: usize = 20;

/// The two faces at an edge: `[a, b, c]` and `[b, a, d]` around edge `ab`.
struct Diamond {
    faces: [u32; 2],
    /// c, d.
    opposite: [u32; 2],
    /// a, b.
    ends: [u32; 2],
    /// bc, ca, ad, db: edge, and face and place that know it now.
    rim: [(u32, (u32, u8)); 4],
}

impl Triangulation {
    /// Flips edges until the metric scaled by `u` is Delaunay, and appends them to `log`.
    ///
    /// Ptolemy's relation gives the lengths of new edges, so that the decorated ideal hyperbolic surface, and
    /// with it the discrete conformal class, stays what it is (Gu, Luo, Sun and Wu 2018; Springborn 2020; Gillespie,
    /// Springborn and Crane 2021). Triangle inequalities may fail before; afterwards they hold, except
    /// at the boundary, whose edges do not flip.
    pub fn flip_to_delaunay(&mut self, u: &[f64], log: &mut Vec<u32>) -> Result<(), MetricError> {
        let limit = log.len() + FLIPS_PER_STEP * self.sides.len();
        self.flip_while_not_delaunay(u, log, limit, |triangulation, e, diamond| {
            let [bc, ca, ad, db] = diamond.rim.map(|(edge, _)| triangulation.lengths[edge as usize]);
            (ad * bc + ca * db) / triangulation.lengths[e as usize]
        })
    }

    /// Flips edges of the metric as it is until it is Delaunay. Nothing but the triangulation changes.
    pub fn flip_to_intrinsic_delaunay(&mut self, log: &mut Vec<u32>) -> Result<(), MetricError> {
        let limit = log.len() + FLIPS_PER_EDGE * self.sides.len();
        let unscaled = vec![0.0; self.vertex_count()];
        self.flip_while_not_delaunay(&unscaled, log, limit, |triangulation, e, diamond| {
            triangulation.other_diagonal(e, diamond).0
        })
    }

    /// Takes flips back, the last one first, without changing the metric.
    ///
    /// # Errors
    /// [`MetricError::NotStraight`] where an edge would have to bend around a vertex.
    pub fn unflip(&mut self, log: &[u32]) -> Result<(), MetricError> {
        for &e in log.iter().rev() {
            let Some(diamond) = self.diamond(e) else { continue };
            let (length, widest) = self.other_diagonal(e, &diamond);
            if widest >= PI {
                return Err(MetricError::NotStraight { edge: e as usize, vertices: diamond.opposite });
            }
            self.flip(e, &diamond, length);
        }
        Ok(())
    }

    fn flip_while_not_delaunay(
        &mut self,
        u: &[f64],
        log: &mut Vec<u32>,
        limit: usize,
        new_length: impl Fn(&Triangulation, u32, &Diamond) -> f64,
    ) -> Result<(), MetricError> {
        let factors: Vec<f64> = u.iter().map(|u| libm::exp(0.5 * u)).collect();
        let mut waiting: Vec<u32> = (0..self.sides.len() as u32).rev().collect();
        let mut is_waiting = vec![true; self.sides.len()];
        while let Some(e) = waiting.pop() {
            is_waiting[e as usize] = false;
            let Some(diamond) = self.diamond(e) else { continue };
            if self.delaunay(e, &diamond, &factors) >= -DELAUNAY_SLACK {
                continue;
            }
            let length = new_length(self, e, &diamond);
            self.flip(e, &diamond, length);
            log.push(e);
            if log.len() > limit {
                return Err(MetricError::TooManyFlips { flips: log.len() });
            }
            for (edge, _) in diamond.rim {
                if !std::mem::replace(&mut is_waiting[edge as usize], true) {
                    waiting.push(edge);
                }
            }
        }
        Ok(())
    }

    /// `None` on the boundary and where a face meets itself, whose edge is always Delaunay.
    fn diamond(&self, e: u32) -> Option<Diamond> {
        let [Some((f, k)), Some((g, m))] = self.sides[e as usize] else { return None };
        let at = |face: u32, place: u8, step: u8| {
            let place = (place + step) % 3;
            (self.edges[face as usize][place as usize], (face, place))
        };
        let corner = |face: u32, place: u8| self.corners[face as usize][(place % 3) as usize];
        (f != g).then(|| Diamond {
            faces: [f, g],
            opposite: [corner(f, k + 2), corner(g, m + 2)],
            ends: [corner(f, k), corner(f, k + 1)],
            rim: [at(f, k, 1), at(f, k, 2), at(g, m, 1), at(g, m, 2)],
        })
    }

    /// Twice the sum of the cosines facing an edge; not negative where the edge is Delaunay. Makes sense
    /// without triangle inequalities.
    fn delaunay(&self, e: u32, diamond: &Diamond, factors: &[f64]) -> f64 {
        let [a, b] = diamond.ends.map(|v| factors[v as usize]);
        let [c, d] = diamond.opposite.map(|v| factors[v as usize]);
        let rim = diamond.rim.map(|(edge, _)| self.lengths[edge as usize]);
        let [bc, ca, ad, db] = [rim[0] * b * c, rim[1] * c * a, rim[2] * a * d, rim[3] * d * b];
        let ab = self.lengths[e as usize] * a * b;
        (bc * bc + ca * ca - ab * ab) / (bc * ca) + (ad * ad + db * db - ab * ab) / (ad * db)
    }

    /// Length of the edge cd that would replace ab, and the larger of the angles of the diamond at a and b.
    fn other_diagonal(&self, e: u32, diamond: &Diamond) -> (f64, f64) {
        let [bc, ca, ad, db] = diamond.rim.map(|(edge, _)| self.lengths[edge as usize]);
        let ab = self.lengths[e as usize];
        let (upper, lower) = (angles([ab, bc, ca]), angles([ab, ad, db]));
        let (at_a, at_b) = (upper[0] + lower[1], upper[1] + lower[0]);
        // |cd|² = (bc − db)² + 4 bc db sin²(½ angle at b), free of cancellation.
        let sine = libm::sin(0.5 * at_b);
        (((bc - db) * (bc - db) + 4.0 * bc * db * sine * sine).sqrt(), at_a.max(at_b))
    }

    /// Replaces ab by cd.
    fn flip(&mut self, e: u32, diamond: &Diamond, length: f64) {
        let ([f, g], [a, b], [c, d]) = (diamond.faces, diamond.ends, diamond.opposite);
        let [bc, ca, ad, db] = diamond.rim.map(|(edge, _)| edge);
        let places = diamond.rim.map(|(edge, known)| {
            let sides = &self.sides[edge as usize];
            (edge as usize, usize::from(sides[0] != Some(known)))
        });
        for ((edge, side), now) in places.into_iter().zip([(g, 2), (f, 1), (f, 2), (g, 1)]) {
            self.sides[edge][side] = Some(now);
        }
        self.sides[e as usize] = [Some((f, 0)), Some((g, 0))];
        self.corners[f as usize] = [d, c, a];
        self.edges[f as usize] = [e, ca, ad];
        self.corners[g as usize] = [c, d, b];
        self.edges[g as usize] = [e, db, bc];
        self.lengths[e as usize] = length;
    }
}
