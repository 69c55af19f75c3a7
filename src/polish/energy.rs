//! What a surface costs: its strain, its bending, and the barrier.

use super::barrier::{Jet, barrier};
use super::hinge::{Hinge, hinges};
use crate::algebra::inner_product;
use crate::mesh::{EdgeId, Mesh, VertexId};
use crate::metric::Metric;
use crate::tuning::{BARRIER_WEIGHT, FACE_AREA_LEFT, LEAST_AREA};
use glam::DVec3;
use rayon::prelude::*;

/// The energy of a connected surface in units of its mean edge length.
#[derive(Debug)]
pub(super) struct Energy {
    /// Per edge: its ends.
    pub ends: Vec<[usize; 2]>,
    /// Per edge: the length that is asked for.
    pub lengths: Vec<f64>,
    pub hinges: Vec<Hinge>,
    /// Whether bending costs nothing. Hinges are watched all the same.
    pub is_membrane: bool,
    /// Per hinge: the angle at rest, in radians.
    pub rest: Vec<f64>,
    /// Per face: its corners.
    pub faces: Vec<[u32; 3]>,
    /// Per face: the area that its lengths ask for.
    areas: Vec<f64>,
    /// Whether faces that are crushed cost besides what their edges do.
    pub holds_areas: bool,
}

/// What angles cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stiffness {
    /// The weight of bending, κ.
    pub bending: f64,
    /// The weight of the barrier.
    pub barrier: f64,
}

impl Stiffness {
    /// The same weight for both.
    pub fn of(weight: f64) -> Stiffness {
        Stiffness { bending: weight, barrier: weight }
    }
}

impl Energy {
    /// `rest` holds the angles at rest in radians, |E|; without any the shell is flat at rest. `unit` is the mean edge
    /// length.
    pub fn new(mesh: &Mesh, metric: &Metric, rest: Option<&[f64]>, is_membrane: bool, unit: f64) -> Energy {
        let hinges = hinges(mesh, metric);
        Energy {
            ends: mesh.edges().map(|e| mesh.edge_vertices(e).map(VertexId::index)).collect(),
            lengths: mesh.edges().map(|e: EdgeId| metric.length(e) / unit).collect(),
            rest: hinges.iter().map(|hinge| rest.map_or(0.0, |rest| rest[hinge.edge])).collect(),
            faces: mesh.triangles(),
            areas: metric.face_areas().iter().map(|area| area / (unit * unit)).collect(),
            holds_areas: false,
            is_membrane,
            hinges,
        }
    }

    /// The hinges that cost something when they bend.
    pub fn costly_hinges(&self) -> &[Hinge] {
        if self.is_membrane { &[] } else { &self.hinges }
    }

    /// What of it some edges, hinges and faces cost, among vertices that `own` numbers anew.
    pub fn part(
        &self,
        edges: &[usize],
        hinges: &[usize],
        faces: &[usize],
        own: &mut impl FnMut(usize) -> usize,
    ) -> Energy {
        Energy {
            ends: edges.iter().map(|e| self.ends[*e].map(&mut *own)).collect(),
            lengths: edges.iter().map(|e| self.lengths[*e]).collect(),
            hinges: hinges
                .iter()
                .map(|h| Hinge { corners: self.hinges[*h].corners.map(&mut *own), ..self.hinges[*h] })
                .collect(),
            rest: hinges.iter().map(|h| self.rest[*h]).collect(),
            faces: faces.iter().map(|f| self.faces[*f].map(|v| own(v as usize) as u32)).collect(),
            areas: faces.iter().map(|f| self.areas[*f]).collect(),
            holds_areas: self.holds_areas,
            is_membrane: self.is_membrane,
        }
    }

    /// The same, with what keeps faces from being crushed: ln²(A / A₀) / 2 where the area A of a face is less than its least one A₀.
    pub fn with_uncrushed_faces(self) -> Energy {
        Energy { holds_areas: true, ..self }
    }

    /// Of the whole surface, as its lengths ask for.
    pub fn area(&self) -> f64 {
        inner_product(&self.areas, &self.areas, |area, _| area)
    }

    /// What is crushed, of each face.
    pub fn crushes(&self, positions: &[DVec3]) -> Vec<Option<Crush>> {
        let faces = self.faces.par_iter().with_min_len(TASK).zip(&self.areas);
        faces.map(|(face, asked)| if self.holds_areas { Crush::of(*face, *asked, positions) } else { None }).collect()
    }

    /// Relative length errors, |E|.
    pub fn strains(&self, positions: &[DVec3]) -> Vec<f64> {
        let edges = self.ends.par_iter().with_min_len(TASK).zip(&self.lengths);
        edges.map(|([a, b], length)| positions[*a].distance(positions[*b]) / length - 1.0).collect()
    }

    /// Bending angles of all hinges in radians.
    pub fn angles(&self, positions: &[DVec3]) -> Vec<f64> {
        self.hinges.par_iter().with_min_len(TASK).map(|hinge| hinge.angle(positions)).collect()
    }

    /// Root mean square of [`Energy::strains`].
    pub fn l2_strain(&self, positions: &[DVec3]) -> f64 {
        let strains = self.strains(positions);
        (inner_product(&strains, &strains, |a, b| a * b) / strains.len() as f64).sqrt()
    }

    /// The energy of positions with these bending angles.
    pub fn value(&self, positions: &[DVec3], angles: &[f64], stiffness: Stiffness) -> f64 {
        let strains = self.strains(positions);
        let strain = 0.5 * inner_product(&strains, &strains, |a, b| a * b);
        let hinges = self.costly_hinges().par_iter().with_min_len(TASK).zip(&self.rest).zip(angles);
        let costs: Vec<f64> = hinges
            .map(|((hinge, rest), angle)| {
                let off = angle - rest;
                hinge.weight
                    * (0.5 * stiffness.bending * off * off + stiffness.barrier * BARRIER_WEIGHT * barrier(*angle).value)
            })
            .collect();
        let crushes: Vec<f64> = if self.holds_areas {
            self.crushes(positions).iter().map(|crush| crush.map_or(0.0, |crush| crush.jet.value)).collect()
        } else {
            Vec::new()
        };
        let crushed = inner_product(&crushes, &crushes, |crush, _| crush);
        strain + inner_product(&costs, &costs, |cost, _| cost) + crushed
    }

    /// Whether a move from some positions with these bending angles to others folds no hinge over and crushes no face: no hinge turns
    /// by more than `most_turn`, in radians, since an angle that passes 180° jumps by a full turn.
    pub fn is_regular(&self, from: (&[DVec3], &[f64]), to: (&[DVec3], &[f64]), most_turn: f64) -> bool {
        let turns_little = to.1.iter().zip(from.1).all(|(a, b)| (a - b).abs() <= most_turn);
        turns_little && self.keeps_areas(from.0, to.0)
    }

    /// Whether every face keeps at least a share of the area that its lengths ask for, or half of what it has now.
    fn keeps_areas(&self, before: &[DVec3], positions: &[DVec3]) -> bool {
        let area = |places: &[DVec3], face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| places[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        let faces = self.faces.par_iter().with_min_len(TASK).zip(&self.areas);
        faces.all(|(face, asked)| {
            let now = area(positions, face);
            now >= FACE_AREA_LEFT * asked || now >= 0.5 * area(before, face)
        })
    }
}

/// A face that has lost so much of its area that it costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crush {
    /// What it costs, by the share of the area that is left.
    pub jet: Jet,
    pub corners: [usize; 3],
    /// Of the share that is left, by the places of the corners.
    pub gradient: [DVec3; 3],
}

impl Crush {
    fn of(face: [u32; 3], asked: f64, positions: &[DVec3]) -> Option<Crush> {
        let corners = face.map(|v| v as usize);
        let [a, b, c] = corners.map(|v| positions[v]);
        let normal = (b - a).cross(c - a);
        let double = normal.length();
        let left = 0.5 * double / asked;
        if left >= LEAST_AREA {
            return None;
        }
        let log = libm::log(left / LEAST_AREA);
        let jet = Jet { value: 0.5 * log * log, first: log / left, second: (1.0 - log) / (left * left) };
        let gradient = [c - b, a - c, b - a].map(|side| normal.cross(side) * (0.5 / (double * asked)));
        Some(Crush { jet, corners, gradient })
    }
}

/// The mean absolute value of angles; 0 where there are none.
pub(super) fn mean_absolute(angles: &[f64]) -> f64 {
    inner_product(angles, angles, |a, _| a.abs()) / angles.len().max(1) as f64
}

/// Elements that are worth a task of their own.
const TASK: usize = 1024;
