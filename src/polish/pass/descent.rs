//! From the pass down to the surface that is asked for, on one side.

use super::error::PassError;
use super::flow::{Flow, Shape, Taken};
use super::halfway::Pass;
use super::way::Way;
use crate::algebra::inner_product;
use crate::polish::energy::{Energy, Stiffness};
use crate::tuning::{
    DRAG_OF_A_DESCENT, MOMENTUM, MOST_STEPS_OF_A_DESCENT, MOST_STIFFENING, NEARLY_DOWN, PUSH_OFF_A_PASS,
    REACH_OF_THE_PUSH, STEP_OF_A_DESCENT, STIFFENING, STRETCHED_AT_REST,
};
use glam::DVec3;
use std::f64::consts::PI;

impl Pass {
    /// Goes down from the begin of the way until the surface is nearly the one that is asked for.
    pub(super) fn descend(&self, energy: &Energy, side: f64, way: &mut Way, flow: &mut Flow) -> Result<(), PassError> {
        let symmetric = |vectors: &mut [DVec3]| self.make_turn_symmetric(vectors);
        let mut stiffness = self.stiffness;
        let mut shape = Shape::new(energy, way.end().to_vec());
        let mass = inner_product(&flow.masses, &flow.masses, |mass, _| mass);
        // Of what turns over, in mean edge lengths.
        let radius = self.size * (mass / (4.0 * PI)).sqrt();
        // Bending costs so much of the whole surface.
        let stiffness_of_all = self.stiffness / (self.size * self.size);
        flow.push = self.push(&flow.masses, side * PUSH_OFF_A_PASS * stiffness_of_all / (mass * radius));
        let least_drag = DRAG_OF_A_DESCENT * stiffness_of_all / (mass * radius * radius);
        let far = (STEP_OF_A_DESCENT * radius).min(1.0);
        flow.drag = least_drag;
        let kept = energy.l2_strain(&shape.positions);
        flow.announce(MOST_STEPS_OF_A_DESCENT);
        let mut is_down = false;
        let mut momentum: Option<Vec<DVec3>> = None;
        for _ in 0..MOST_STEPS_OF_A_DESCENT {
            let before = shape.positions.clone();
            let mut go = |flow: &mut Flow, momentum| {
                flow.step(energy, &mut shape, Stiffness::of(stiffness), LONGEST * far, momentum, &symmetric)
            };
            let taken = match go(flow, momentum.as_deref())? {
                None if momentum.is_some() => go(flow, None)?,
                taken => taken,
            };
            let l2_length_error = energy.l2_strain(&shape.positions);
            let Some(Taken { share, farthest }) = taken else { return Err(PassError::Stuck { l2_length_error }) };
            flow.drag = (flow.drag * (farthest / share / far).clamp(0.5, 2.0)).max(least_drag);
            let is_off = flow.push.is_empty();
            let stands_still = share == 1.0 && farthest < STANDING_STILL;
            // Then it is its stiffness that stretches it, which goes.
            is_down |= is_off && stands_still && l2_length_error > STRETCHED_AT_REST * kept;
            // What is stretched less may be stiffer: pockets stay wide, and their corners do not lock, or unlock.
            if !is_down && (l2_length_error < kept || farthest < STANDING_STILL) {
                stiffness = (stiffness * STIFFENING).min(self.stiffness * MOST_STIFFENING);
            } else {
                stiffness = (stiffness / STIFFENING).max(if is_down { 0.0 } else { self.stiffness });
            }
            momentum =
                Some(shape.positions.iter().zip(&before).map(|(now, before)| (*now - *before) * MOMENTUM).collect());
            way.push(shape.positions.clone());
            if !flow.push.is_empty()
                && distance(way.begin(), &shape.positions, &flow.masses) > REACH_OF_THE_PUSH * radius
            {
                flow.push = Vec::new();
            }
            if l2_length_error < NEARLY_DOWN && is_off && (is_down || stands_still) {
                return Ok(());
            }
        }
        Err(PassError::Stuck { l2_length_error: energy.l2_strain(&shape.positions) })
    }

    /// Forces aside whose work is this large where all vertices move by one, and which do not move the surface as a whole.
    fn push(&self, masses: &[f64], force: f64) -> Vec<DVec3> {
        let total = inner_product(masses, masses, |mass, _| mass);
        let mean = self.aside.iter().zip(masses).map(|(aside, mass)| *aside * (*mass / total)).sum::<DVec3>();
        let longest = self.aside.iter().map(|aside| aside.length()).fold(0.0, f64::max);
        self.aside.iter().zip(masses).map(|(aside, mass)| (*aside - mean) * (force * mass / longest)).collect()
    }
}

/// Root mean square distance of two surfaces, by area.
fn distance(from: &[DVec3], to: &[DVec3], masses: &[f64]) -> f64 {
    let squares: Vec<f64> = from.iter().zip(to).map(|(a, b)| a.distance_squared(*b)).collect();
    (inner_product(&squares, masses, |square, mass| square * mass) / inner_product(masses, masses, |m, _| m)).sqrt()
}

/// The longest step over the one that is aimed at.
const LONGEST: f64 = 1.3;
/// A step in mean edge lengths that moves nothing any more.
const STANDING_STILL: f64 = 0.1;
