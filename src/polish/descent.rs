//! Newton steps while the shell gets softer.

use super::energy::{Energy, Stiffness, mean_absolute};
use super::local_search::Patches;
use super::newton::NewtonSystem;
use super::report::{Ending, PolishReport, mean_bending};
use crate::immersion::{RigidMotion, length_error};
use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use crate::tuning::{
    FACE_AREA_LEFT, FAR_MOVE, FAST_FADES, GENTLE_POLISH, HALVINGS_OF_A_POLISH_STEP, IDLE_ROUNDS, ISOMETRIC,
    LARGEST_HINGE_TURN, MAX_BENDING_GROWTH, NEAR_MOVE, POLISH_FADE, POLISH_GAIN, ROUND_GAIN, ROUND_STIFFNESS,
    SOFTEST_POLISH, STEPS_PER_STIFFNESS,
};
use glam::DVec3;
use std::ops::ControlFlow;

/// How a surface is polished.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polish {
    /// Weight of bending to begin with. A stiffer shell is smoothed first, and ends with less bending.
    pub stiffness: f64,
    /// Whether bending costs nothing, and the stiffness but holds the moves of neighbouring vertices together. That takes a
    /// third of the time, and is right for surfaces that are smooth and rigid, as convex ones are.
    pub is_membrane: bool,
    /// What the weight of bending is multiplied with after every second step, where steps are not short.
    pub fade: f64,
    /// The weight below which the barrier does not fade. Hinges that have come to 180° but for rounding hold everything else up.
    pub least_barrier: f64,
    /// By which share the mean bending angle may grow.
    pub max_bending_growth: f64,
    /// The largest number of Newton steps.
    pub max_steps: usize,
    /// Rounds in which patches that hold most of the error are disturbed and polished alone, if it ends short of the lengths.
    pub rounds: usize,
}

impl Default for Polish {
    /// A shell of 10⁻⁴, one half, a fifth, 120 steps, no rounds.
    fn default() -> Polish {
        Polish {
            stiffness: GENTLE_POLISH,
            is_membrane: false,
            fade: POLISH_FADE,
            least_barrier: 0.0,
            max_bending_growth: MAX_BENDING_GROWTH,
            max_steps: 120,
            rounds: 0,
        }
    }
}

/// A polished surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Polished {
    /// Vertices, |V|, laid upon those that they were polished from, unless some are pinned.
    pub positions: Vec<DVec3>,
    /// What was done.
    pub report: PolishReport,
}

/// What is told of every step, and may end polish there by [`ControlFlow::Break`].
pub type Watch<'a> = dyn FnMut(&PolishStep) -> ControlFlow<()> + 'a;

/// The state of polish after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolishStep {
    /// Steps taken.
    pub step: usize,
    /// The most steps that it may take.
    pub max_steps: usize,
    /// L2 length error.
    pub l2_length_error: f64,
    /// Weight of bending.
    pub stiffness: f64,
}

impl Polish {
    /// Polishes a connected surface. `positions` has its vertices, |V|, without pinch points; `rest` the bending angles at rest
    /// in radians, |E|, without any it is flat at rest. `pinned` vertices stay to the last bit. The result has no unit of its own,
    /// and the same bits on any number of threads and any processor. Where a linear system cannot be solved, it ends with what it
    /// has.
    pub fn apply(
        &self,
        mesh: &Mesh,
        metric: &Metric,
        positions: &[DVec3],
        rest: Option<&[f64]>,
        pinned: &[VertexId],
        watch: &mut Watch,
    ) -> Polished {
        let unit = metric.edge_lengths().iter().sum::<f64>() / metric.edge_lengths().len() as f64;
        let energy = Energy::new(mesh, metric, rest, self.is_membrane, unit);
        let mut is_pinned = vec![false; positions.len()];
        pinned.iter().for_each(|v| is_pinned[v.index()] = true);
        let begin: Vec<DVec3> = positions.iter().map(|p| *p / unit).collect();
        let mut report = PolishReport::unchanged(mesh, metric, positions);
        let Ok(mut system) = NewtonSystem::new(&energy, &is_pinned) else {
            return Polished { positions: positions.to_vec(), report };
        };
        let mut descent = Descent::new(&energy, &mut system, begin, self);
        report.ending = descent.run(watch);
        let patches = Patches::new(&energy, &is_pinned);
        let mut idle = 0;
        for round in 0..self.rounds {
            if report.ending != Ending::BestFit || idle == IDLE_ROUNDS {
                break;
            }
            let before = descent.best_strain;
            if let Some(next) = patches.round(&descent.best, round, self.least_barrier) {
                report.ending = descent.go_on_from(next, watch);
            }
            idle += usize::from(descent.best_strain > (1.0 - ROUND_GAIN) * before);
        }
        let mut places: Vec<DVec3> = descent.best.iter().map(|p| *p * unit).collect();
        if pinned.is_empty() {
            let motion = RigidMotion::onto(positions, &places, &metric.vertex_areas(mesh));
            places.iter_mut().for_each(|p| *p = motion.point(*p));
        } else {
            pinned.iter().for_each(|v| places[v.index()] = positions[v.index()]);
        }
        report.l2_length_error = length_error(mesh, metric, &places).l2;
        report.mean_bending = mean_bending(mesh, &places).to_degrees();
        report.steps = descent.steps;
        Polished { positions: places, report }
    }
}

/// The surface on its way.
pub(super) struct Descent<'a> {
    energy: &'a Energy,
    system: &'a mut NewtonSystem,
    positions: Vec<DVec3>,
    angles: Vec<f64>,
    /// Weight of bending, as it fades.
    stiffness: f64,
    steps: usize,
    polish: &'a Polish,
    /// Mean bending angle at the beginning, in radians.
    bending_before: f64,
    /// The positions with the least strain that do not bend too much.
    pub best: Vec<DVec3>,
    /// Their root mean square strain.
    pub best_strain: f64,
}

/// What a step did.
struct Step {
    /// Which part of the direction was gone.
    share: f64,
    /// How far the vertex moved that moved farthest, in mean edge lengths.
    farthest: f64,
}

impl<'a> Descent<'a> {
    pub fn new(
        energy: &'a Energy,
        system: &'a mut NewtonSystem,
        positions: Vec<DVec3>,
        polish: &'a Polish,
    ) -> Descent<'a> {
        let angles = energy.angles(&positions);
        Descent {
            stiffness: polish.stiffness,
            steps: 0,
            polish,
            bending_before: mean_absolute(&angles),
            angles,
            best_strain: energy.l2_strain(&positions),
            best: positions.clone(),
            energy,
            system,
            positions,
        }
    }

    /// Takes steps and lets the stiffness fade until the lengths are right or get no better.
    pub fn run(&mut self, watch: &mut Watch) -> Ending {
        let most_steps = self.steps + self.polish.max_steps;
        let most_bending = (1.0 + self.polish.max_bending_growth) * self.bending_before.max(LEAST_BENDING);
        let (mut since_fade, mut strains) = (0, Vec::new());
        while self.steps < most_steps {
            self.steps += 1;
            let Some(step) = self.step() else {
                // What is stiff cannot move on; what is soft has arrived.
                if self.stiffness < self.best_strain * self.best_strain {
                    return Ending::BestFit;
                }
                (self.stiffness, since_fade) = (self.stiffness * self.polish.fade, 0);
                continue;
            };
            since_fade += 1;
            let strain = self.energy.l2_strain(&self.positions);
            let bending = mean_absolute(&self.angles);
            if strain < self.best_strain && bending <= most_bending {
                (self.best_strain, self.best) = (strain, self.positions.clone());
            }
            let stiffness = self.polish.stiffness;
            let now = PolishStep {
                step: self.steps,
                max_steps: most_steps,
                l2_length_error: strain,
                stiffness: self.stiffness,
            };
            if watch(&now).is_break() {
                return Ending::StepLimit;
            }
            if strain <= ISOMETRIC {
                return Ending::Isometric;
            }
            if bending > most_bending && self.stiffness < stiffness {
                return Ending::BendingLimit;
            }
            strains.push(strain);
            let gains_little = strains.len() > PATIENCE
                && strain > strains[strains.len() - 1 - PATIENCE] * (1.0 - POLISH_GAIN)
                && self.stiffness * bending * bending < BENDING_IS_NOTHING * strain * strain;
            if gains_little || self.stiffness < SOFTEST_POLISH {
                return Ending::BestFit;
            }
            // Where steps are short and whole, the next surface is near, and there is nothing to be careful about.
            let fade = match step {
                Step { share: 1.0, farthest } if farthest < NEAR_MOVE => FAST_FADES[1],
                Step { share: 1.0, farthest } if farthest < FAR_MOVE => FAST_FADES[0],
                _ if since_fade >= STEPS_PER_STIFFNESS => self.polish.fade,
                _ => continue,
            };
            (self.stiffness, since_fade) = (self.stiffness * fade, 0);
        }
        Ending::StepLimit
    }

    /// Goes on from other positions, with a shell that is soft already.
    fn go_on_from(&mut self, positions: Vec<DVec3>, watch: &mut Watch) -> Ending {
        self.angles = self.energy.angles(&positions);
        self.positions = positions;
        self.stiffness = ROUND_STIFFNESS;
        self.run(watch)
    }

    /// One step, shortened until it leads downhill without folding a hinge over or crushing a face; `None` if no part of it
    /// does, or the linear system cannot be solved.
    fn step(&mut self) -> Option<Step> {
        let weights = Stiffness { bending: self.stiffness, barrier: self.stiffness.max(self.polish.least_barrier) };
        let before = self.energy.value(&self.positions, &self.angles, weights);
        let direction = self.system.direction(self.energy, &self.positions, weights, None).ok()?;
        let mut share = 1.0;
        for _ in 0..=HALVINGS_OF_A_POLISH_STEP {
            let next: Vec<DVec3> = self.positions.iter().zip(&direction.moves).map(|(p, x)| *p + *x * share).collect();
            let next_angles = self.energy.angles(&next);
            // An angle that passes 180° jumps by a full turn.
            let turns = next_angles.iter().zip(&self.angles).all(|(a, b)| (a - b).abs() <= LARGEST_HINGE_TURN);
            if turns && self.energy.keeps_areas(&self.positions, &next, FACE_AREA_LEFT) {
                let after = self.energy.value(&next, &next_angles, weights);
                if after <= before - ARMIJO * share * direction.slope {
                    let longest = direction.moves.iter().map(|x| x.length()).fold(0.0, f64::max);
                    (self.positions, self.angles) = (next, next_angles);
                    return Some(Step { share, farthest: share * longest });
                }
            }
            share *= 0.5;
        }
        None
    }
}

/// The part of what the slope promises that a step must keep.
const ARMIJO: f64 = 1e-4;
/// Steps over which the strain must get better.
const PATIENCE: usize = 8;
/// Bending that costs less than this share of what strain costs does not hold it back.
const BENDING_IS_NOTHING: f64 = 0.02;
/// A surface that is flat or nearly so may bend by so much on average, in radians (0.5°).
const LEAST_BENDING: f64 = 0.5 / 180.0 * std::f64::consts::PI;
