//! The linear system of a step: Newton's, made positive definite.

use super::barrier::barrier;
use super::energy::{Crush, Energy, Stiffness};
use crate::algebra::{BlockCholesky, CholeskyError};
use crate::tuning::{BARRIER_WEIGHT, POLISH_ANCHOR};
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::collections::HashMap;

/// The Hessian of the energy with all that could make it indefinite left out: of strain, the stress of compressed edges;
/// of bending, the curvature of angles. Its order of elimination is kept for all steps.
#[derive(Debug)]
pub(super) struct NewtonSystem {
    factor: BlockCholesky,
    /// Per vertex: its unknown; `None` where it is pinned.
    unknowns: Vec<Option<usize>>,
    /// Per edge: the pair of unknowns that it couples, if both of its ends are free.
    edge_pairs: Vec<Option<Coupling>>,
    /// Per hinge: those of its corners, (1, 0), (2, 0), (2, 1), (3, 0), (3, 1), (3, 2).
    hinge_pairs: Vec<[Option<Coupling>; 6]>,
    /// Per face: those of its corners, (1, 0), (2, 0), (2, 1).
    face_pairs: Vec<[Option<Coupling>; 3]>,
    sums: Sums,
}

/// The numbers of the system.
#[derive(Debug)]
struct Sums {
    diagonal: Vec<DMat3>,
    pairs: Vec<DMat3>,
    gradient: Vec<DVec3>,
}

/// What a surface moves against, and what drives it besides its energy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag<'a> {
    /// Per vertex.
    pub masses: &'a [f64],
    /// What resists moves of a vertex, per mass.
    pub drag: f64,
    /// Force on each vertex, |V|, or none.
    pub push: &'a [DVec3],
}

/// A pair of unknowns, and whether it stands the other way round among the pairs.
#[derive(Clone, Copy, Debug)]
struct Coupling {
    pair: usize,
    is_swapped: bool,
}

/// A direction that leads downhill.
#[derive(Debug)]
pub(super) struct Direction {
    /// How far each vertex moves, |V|.
    pub moves: Vec<DVec3>,
    /// How fast the energy falls along it.
    pub slope: f64,
}

impl NewtonSystem {
    /// For an energy, with vertices that stay.
    pub fn new(energy: &Energy, is_pinned: &[bool]) -> Result<NewtonSystem, CholeskyError> {
        let mut unknowns = vec![None; is_pinned.len()];
        let free = unknowns.iter_mut().zip(is_pinned).filter(|(_, pinned)| !**pinned);
        let count = free.enumerate().map(|(row, (unknown, _))| *unknown = Some(row)).count();
        let (mut pairs, mut known) = (Vec::new(), HashMap::new());
        let mut couple = |a: usize, b: usize| {
            let (a, b) = (unknowns[a]?, unknowns[b]?);
            let key = (a.max(b), a.min(b));
            let pair = *known.entry(key).or_insert_with(|| {
                pairs.push(key);
                pairs.len() - 1
            });
            Some(Coupling { pair, is_swapped: a < b })
        };
        let edge_pairs = energy.ends.iter().map(|[a, b]| couple(*a, *b)).collect();
        let hinges = energy.costly_hinges().iter();
        let hinge_pairs = hinges.map(|h| CORNER_PAIRS.map(|(i, j)| couple(h.corners[i], h.corners[j]))).collect();
        // They are edges, and so coupled already.
        let face_pairs = energy.faces.iter().map(|f| FACE_PAIRS.map(|(i, j)| couple(f[i] as usize, f[j] as usize)));
        let face_pairs = if energy.holds_areas { face_pairs.collect() } else { Vec::new() };
        Ok(NewtonSystem {
            factor: BlockCholesky::new(count, &pairs)?,
            unknowns,
            edge_pairs,
            hinge_pairs,
            face_pairs,
            sums: Sums {
                diagonal: vec![DMat3::ZERO; count],
                pairs: vec![DMat3::ZERO; pairs.len()],
                gradient: vec![DVec3::ZERO; count],
            },
        })
    }

    /// The direction of a step from these positions, against a drag or not.
    pub fn direction(
        &mut self,
        energy: &Energy,
        positions: &[DVec3],
        stiffness: Stiffness,
        drag: Option<&Drag>,
    ) -> Result<Direction, CholeskyError> {
        self.sums.diagonal.fill(DMat3::from_diagonal(DVec3::splat(POLISH_ANCHOR)));
        self.sums.pairs.fill(DMat3::ZERO);
        self.sums.gradient.fill(DVec3::ZERO);
        self.add_strain(energy, positions, if energy.is_membrane { stiffness.bending } else { 0.0 });
        self.add_bending(energy, positions, stiffness);
        if energy.holds_areas {
            self.add_crushes(energy, positions);
        }
        drag.into_iter().for_each(|drag| self.add_drag(drag));
        self.factor.factorize(&self.sums.diagonal, &self.sums.pairs)?;
        let mut x: Vec<DVec3> = self.sums.gradient.iter().map(|g| -*g).collect();
        self.factor.solve(&mut x);
        let slope = self.sums.gradient.iter().zip(&x).map(|(g, x)| -g.dot(*x)).sum();
        let moves = self.unknowns.iter().map(|unknown| unknown.map_or(DVec3::ZERO, |row| x[row])).collect();
        Ok(Direction { moves, slope })
    }

    /// How fast the energy falls along other moves, |V|, from where the last direction was asked for.
    pub fn slope_along(&self, moves: &[DVec3]) -> f64 {
        let slope =
            |(unknown, x): (&Option<usize>, &DVec3)| unknown.map_or(0.0, |row| -self.sums.gradient[row].dot(*x));
        self.unknowns.iter().zip(moves).map(slope).sum()
    }

    fn add_drag(&mut self, drag: &Drag) {
        for (v, unknown) in self.unknowns.iter().enumerate() {
            if let Some(row) = *unknown {
                self.sums.diagonal[row] += DMat3::from_diagonal(DVec3::splat(drag.drag * drag.masses[v]));
                self.sums.gradient[row] -= drag.push.get(v).copied().unwrap_or_default();
            }
        }
    }

    /// Per face that is crushed: b″ ∇A ∇Aᵀ.
    fn add_crushes(&mut self, energy: &Energy, positions: &[DVec3]) {
        for (crush, couplings) in energy.crushes(positions).iter().zip(&self.face_pairs) {
            let Some(Crush { jet, corners, gradient }) = crush else { continue };
            let rows = corners.map(|v| self.unknowns[v]);
            self.sums.add(&rows, gradient, FACE_PAIRS.iter().zip(couplings), [jet.first, jet.second]);
        }
    }

    /// Per edge of direction u, length L and strain s = L/ℓ − 1: (u uᵀ + max(s, 0) ℓ/L (1 − u uᵀ)) / ℓ², and what holds the
    /// moves of its ends together.
    fn add_strain(&mut self, energy: &Energy, positions: &[DVec3], hold: f64) {
        for (([a, b], asked), coupling) in energy.ends.iter().zip(&energy.lengths).zip(&self.edge_pairs) {
            let along = positions[*b] - positions[*a];
            let length = along.length();
            let (u, strain) = (along / length, length / asked - 1.0);
            let across = strain.max(0.0) * asked / length;
            let all_around = across / (asked * asked) + hold;
            let block =
                outer(u, u) * ((1.0 - across) / (asked * asked)) + DMat3::from_diagonal(DVec3::splat(all_around));
            let force = u * (strain / asked);
            for (v, sign) in [(*a, -1.0), (*b, 1.0)] {
                if let Some(row) = self.unknowns[v] {
                    self.sums.diagonal[row] += block;
                    self.sums.gradient[row] += sign * force;
                }
            }
            if let Some(coupling) = coupling {
                self.sums.pairs[coupling.pair] -= block;
            }
        }
    }

    /// Per hinge: w (κ + κ_b b″) ∇α ∇αᵀ.
    fn add_bending(&mut self, energy: &Energy, positions: &[DVec3], stiffness: Stiffness) {
        let bends: Vec<_> =
            energy.costly_hinges().par_iter().with_min_len(1024).map(|hinge| hinge.bend(positions)).collect();
        for (((hinge, bend), rest), couplings) in
            energy.costly_hinges().iter().zip(&bends).zip(&energy.rest).zip(&self.hinge_pairs)
        {
            let barrier = barrier(bend.angle);
            let against_fold = stiffness.barrier * BARRIER_WEIGHT;
            let torque = hinge.weight * (stiffness.bending * (bend.angle - rest) + against_fold * barrier.first);
            let curvature = hinge.weight * (stiffness.bending + against_fold * barrier.second);
            let rows = hinge.corners.map(|v| self.unknowns[v]);
            self.sums.add(&rows, &bend.gradient, CORNER_PAIRS.iter().zip(couplings), [torque, curvature]);
        }
    }
}

impl Sums {
    /// Adds what some corners have to do with a cost, whose gradient by their places is given: f′ ∇ and f″ ∇ ∇ᵀ.
    fn add<'a>(
        &mut self,
        rows: &[Option<usize>],
        gradient: &[DVec3],
        couplings: impl Iterator<Item = (&'a (usize, usize), &'a Option<Coupling>)>,
        [first, second]: [f64; 2],
    ) {
        for (row, gradient) in rows.iter().zip(gradient) {
            if let Some(row) = *row {
                self.diagonal[row] += outer(*gradient, *gradient) * second;
                self.gradient[row] += *gradient * first;
            }
        }
        for ((i, j), coupling) in couplings {
            if let Some(Coupling { pair, is_swapped }) = *coupling {
                let [row, column] = if is_swapped { [*j, *i] } else { [*i, *j] };
                self.pairs[pair] += outer(gradient[row], gradient[column]) * second;
            }
        }
    }
}

/// u vᵀ.
fn outer(u: DVec3, v: DVec3) -> DMat3 {
    DMat3::from_cols(u * v.x, u * v.y, u * v.z)
}

/// All pairs of the corners of a face.
const FACE_PAIRS: [(usize, usize); 3] = [(1, 0), (2, 0), (2, 1)];
/// All pairs of the corners of a hinge.
const CORNER_PAIRS: [(usize, usize); 6] = [(1, 0), (2, 0), (2, 1), (3, 0), (3, 1), (3, 2)];
