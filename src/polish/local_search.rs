//! Where polish stops short of the lengths, small patches hold most of the error: each is caught at a fold of the map from
//! shapes to lengths. A patch is disturbed and polished alone, all around it held, many times over; where that ends with less
//! strain, it is put back.

use super::descent::Descent;
use super::energy::Energy;
use super::newton::NewtonSystem;
use super::settings::Polish;
use crate::tuning::{
    DISTURBANCE, DISTURBED_RINGS, LARGEST_HINGE_TURN, RINGS_OF_A_TRY, SHARE_OF_A_TRY, STEPS_OF_A_TRY,
    STIFFNESS_OF_A_TRY, TRIES,
};
use glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use rayon::prelude::*;
use std::collections::HashMap;
use std::ops::ControlFlow;

/// A surface as its vertices see it.
#[derive(Debug)]
pub(super) struct Patches<'a> {
    energy: &'a Energy,
    is_pinned: &'a [bool],
    /// Per vertex: its edges, and the vertices at their other ends.
    edges: Vec<Vec<(usize, usize)>>,
    /// Per vertex: the hinges that have it as a corner.
    hinges: Vec<Vec<usize>>,
    /// Per vertex: its faces.
    faces: Vec<Vec<usize>>,
}

/// A patch that has found less strain: vertices and where they are now.
type Moved = Vec<(usize, DVec3)>;

impl<'a> Patches<'a> {
    pub fn new(energy: &'a Energy, is_pinned: &'a [bool]) -> Patches<'a> {
        let count = is_pinned.len();
        let mut edges = vec![Vec::new(); count];
        for (e, [a, b]) in energy.ends.iter().enumerate() {
            edges[*a].push((e, *b));
            edges[*b].push((e, *a));
        }
        let mut hinges = vec![Vec::new(); count];
        for (h, hinge) in energy.hinges.iter().enumerate() {
            hinge.corners.iter().for_each(|v| hinges[*v].push(h));
        }
        let mut faces = vec![Vec::new(); count];
        for (f, face) in energy.faces.iter().enumerate() {
            face.iter().for_each(|v| faces[*v as usize].push(f));
        }
        Patches { energy, is_pinned, edges, hinges, faces }
    }

    /// One round: the patches that hold most of the error, each tried on its own; what has become better, in place. `None`
    /// if nothing has.
    pub fn round(&self, positions: &[DVec3], round: usize, least_barrier: f64) -> Option<Vec<DVec3>> {
        let centers = self.centers(positions);
        let moved: Vec<Moved> =
            centers.par_iter().filter_map(|center| self.tried(*center, positions, round, least_barrier)).collect();
        let mut next = positions.to_vec();
        moved.iter().flatten().for_each(|(v, place)| next[*v] = *place);
        (!moved.is_empty()).then_some(next)
    }

    /// The vertices with most of the squared strain around them, so far from each other that what is done to one patch is not
    /// felt in another.
    fn centers(&self, positions: &[DVec3]) -> Vec<usize> {
        let squares: Vec<f64> = self.energy.strains(positions).iter().map(|s| s * s).collect();
        let total: f64 = squares.iter().sum();
        let held = |edges: &Vec<(usize, usize)>| edges.iter().map(|(e, _)| squares[*e]).sum::<f64>();
        let mut worst: Vec<(f64, usize)> = self.edges.iter().map(held).zip(0..).collect();
        worst.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut is_taken = vec![false; positions.len()];
        let mut centers = Vec::new();
        for (held, v) in worst {
            if held < SHARE_OF_A_TRY * total {
                break;
            }
            if !is_taken[v] && !self.ball(v, RINGS_OF_A_TRY + 2).iter().any(|u| is_taken[*u]) {
                self.ball(v, RINGS_OF_A_TRY).iter().for_each(|u| is_taken[*u] = true);
                centers.push(v);
            }
        }
        centers
    }

    /// The vertices within so many rings around one, which is the first; those near it before those farther off.
    fn ball(&self, center: usize, rings: usize) -> Vec<usize> {
        let mut ring_of = HashMap::from([(center, 0)]);
        let mut ball = vec![center];
        let mut at = 0;
        while let Some(v) = ball.get(at) {
            let ring = ring_of[v];
            at += 1;
            if ring == rings {
                break;
            }
            for (_, u) in &self.edges[*v] {
                if !ring_of.contains_key(u) {
                    ring_of.insert(*u, ring + 1);
                    ball.push(*u);
                }
            }
        }
        ball
    }

    /// The patch around a vertex after all its tries, if one of them was worth it. What is drawn at random depends on the
    /// vertex and the round alone.
    fn tried(&self, center: usize, positions: &[DVec3], round: usize, least_barrier: f64) -> Option<Moved> {
        let ball = self.ball(center, RINGS_OF_A_TRY);
        let inner = self.ball(center, DISTURBED_RINGS).len();
        let (energy, vertices) = self.patch(&ball);
        let is_held: Vec<bool> =
            vertices.iter().enumerate().map(|(k, v)| k >= ball.len() || self.is_pinned[*v]).collect();
        let mut system = NewtonSystem::new(&energy, &is_held).ok()?;
        let mut random = ChaCha8Rng::seed_from_u64(((round as u64) << 40) | center as u64);
        let mut unit = move || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let begin: Vec<DVec3> = vertices.iter().map(|v| positions[*v]).collect();
        let (mut best, first) = (begin.clone(), energy.l2_strain(&begin));
        let mut least = first;
        for _ in 0..TRIES {
            let amount = DISTURBANCE * unit();
            let mut way = vec![DVec3::ZERO; best.len()];
            for (way, _) in way.iter_mut().zip(&is_held).take(inner).filter(|(_, held)| !**held) {
                *way = DVec3::from_array(std::array::from_fn(|_| amount * (2.0 * unit() - 1.0)));
            }
            let (low, high) = STIFFNESS_OF_A_TRY;
            let stiffness = low * libm::pow(high / low, unit());
            let Some(disturbed) = disturbed(&energy, &best, &way) else { continue };
            let polish = Polish {
                stiffness,
                least_barrier,
                max_bending_growth: f64::INFINITY,
                max_steps: STEPS_OF_A_TRY,
                ..Polish::default()
            };
            let mut descent = Descent::new(&energy, &mut system, disturbed, &polish);
            descent.run(&mut |_| ControlFlow::Continue(()));
            if descent.best_strain < WORTH_IT * least {
                (least, best) = (descent.best_strain, descent.best);
            }
        }
        (least < first).then(|| ball.iter().copied().zip(best).collect())
    }

    /// The energy of all that these vertices take part in, and the vertices of this energy: these, then those around them.
    fn patch(&self, ball: &[usize]) -> (Energy, Vec<usize>) {
        let mut vertices = ball.to_vec();
        let mut own: HashMap<usize, usize> = ball.iter().copied().zip(0..).collect();
        let mut own = |v: usize| {
            *own.entry(v).or_insert_with(|| {
                vertices.push(v);
                vertices.len() - 1
            })
        };
        let edges = of_all(ball.iter().flat_map(|v| self.edges[*v].iter().map(|(e, _)| *e)));
        let hinges = of_all(ball.iter().flat_map(|v| self.hinges[*v].iter().copied()));
        let faces = of_all(ball.iter().flat_map(|v| self.faces[*v].iter().copied()));
        let energy = self.energy.part(&edges, &hinges, &faces, &mut own);
        (energy, vertices)
    }
}

/// Sorted, each once.
fn of_all(items: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut items: Vec<usize> = items.collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// Positions moved along a way, or part of it, so that no hinge folds over and no face collapses.
fn disturbed(energy: &Energy, positions: &[DVec3], way: &[DVec3]) -> Option<Vec<DVec3>> {
    let angles = energy.angles(positions);
    [1.0, 0.5, 0.25, 0.125].into_iter().find_map(|share| {
        let next: Vec<DVec3> = positions.iter().zip(way).map(|(p, x)| *p + *x * share).collect();
        let is_regular = energy.is_regular((positions, &angles), (&next, &energy.angles(&next)), LARGEST_HINGE_TURN);
        is_regular.then_some(next)
    })
}

/// A try counts if it leaves no more than this share of the strain.
const WORTH_IT: f64 = 0.95;
