//! Newton steps while the shell gets softer.

use super::energy::{Energy, Stiffness, mean_absolute};
use super::newton::NewtonSystem;
use super::report::Ending;
use super::settings::{Polish, PolishStep, Watch};
use crate::tuning::{
    ARMIJO, FAR_MOVE, FAST_FADES, HALVINGS_OF_A_POLISH_STEP, ISOMETRIC, LARGEST_HINGE_TURN, NEAR_MOVE, POLISH_GAIN,
    ROUND_STIFFNESS, SOFTEST_POLISH, STEPS_PER_STIFFNESS,
};
use glam::DVec3;

/// The surface on its way.
pub(super) struct Descent<'a> {
    energy: &'a Energy,
    system: &'a mut NewtonSystem,
    positions: Vec<DVec3>,
    angles: Vec<f64>,
    /// Weight of bending, as it fades.
    stiffness: f64,
    /// Taken so far.
    pub steps: usize,
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
    pub fn go_on_from(&mut self, positions: Vec<DVec3>, watch: &mut Watch) -> Ending {
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
            let (from, to) = ((&*self.positions, &*self.angles), (&*next, &*next_angles));
            if self.energy.is_regular(from, to, LARGEST_HINGE_TURN) {
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

/// Steps over which the strain must get better.
const PATIENCE: usize = 8;
/// Bending that costs less than this share of what strain costs does not hold it back.
const BENDING_IS_NOTHING: f64 = 0.02;
/// A surface that is flat or nearly so may bend by so much on average, in radians (0.5°).
const LEAST_BENDING: f64 = 0.5 / 180.0 * std::f64::consts::PI;
