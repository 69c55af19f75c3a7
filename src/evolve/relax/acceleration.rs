//! Anderson acceleration of the relaxation (Walker and Ni 2011), on rotations.
//!
//! A step is a map of frames to frames whose fixed point is sought. From the last few steps the combination is
//! formed whose changes cancel best, in the logarithms of the rotations between frames. It takes over the slow modes
//! of a phase that is converging, and is thrown away as soon as steps grow, so that it never steers a phase that is
//! still finding its shape.

use crate::algebra::inner_product;
use crate::tuning::{
    ACCELERATION_REACH, ACCELERATION_REACH_OF_A_FACE, ACCELERATION_REGULARIZATION, ACCELERATION_WINDOW,
};
use glam::{DQuat, DVec3};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Earlier steps of one phase.
#[derive(Clone, Debug, Default)]
pub struct Acceleration {
    /// Differences between successive steps, and between successive results, oldest first.
    step_changes: Vec<Vec<DVec3>>,
    result_changes: Vec<Vec<DVec3>>,
    /// Inner products of the step changes, row by row.
    products: Vec<Vec<f64>>,
    /// The last result and the step that led to it.
    last: Option<(Vec<DQuat>, Vec<DVec3>)>,
    last_length: f64,
}

impl Acceleration {
    /// Corrects the frames `after` a step that began at `before`.
    pub fn correct(&mut self, before: &[DQuat], after: &mut [DQuat]) {
        let step = turns(before, after);
        let length = dot(&step, &step).sqrt();
        if length > self.last_length {
            *self = Acceleration::default();
        }
        self.last_length = length;
        let result = after.to_vec();
        if let Some((last_result, last_step)) = self.last.take() {
            if self.step_changes.len() == ACCELERATION_WINDOW {
                self.step_changes.remove(0);
                self.result_changes.remove(0);
                self.products.remove(0);
                self.products.iter_mut().for_each(|row| _ = row.remove(0));
            }
            self.step_changes.push(step.par_iter().zip(&last_step).map(|(a, b)| *a - *b).collect());
            self.result_changes.push(turns(&last_result, &result));
            if let Some(newest) = self.step_changes.last() {
                // The lower triangle.
                self.products.push(self.step_changes.iter().map(|change| dot(change, newest)).collect());
            }
            if let Some(weights) = self.weights(&step) {
                self.apply(&weights, length, after);
            }
        }
        self.last = Some((result, step));
    }

    /// The combination of step changes closest to the step.
    fn weights(&self, step: &[DVec3]) -> Option<DVector<f64>> {
        let n = self.step_changes.len();
        let mut matrix = DMatrix::from_fn(n, n, |i, j| self.products[i.max(j)][i.min(j)]);
        let floor = ACCELERATION_REGULARIZATION * matrix.trace() / n as f64;
        (0..n).for_each(|i| matrix[(i, i)] += floor);
        matrix.cholesky().map(|factor| factor.solve(&DVector::from_fn(n, |i, _| dot(&self.step_changes[i], step))))
    }

    fn apply(&self, weights: &DVector<f64>, step_length: f64, frames: &mut [DQuat]) {
        let mut correction = vec![DVec3::ZERO; frames.len()];
        for (weight, change) in weights.iter().zip(&self.result_changes) {
            correction.par_iter_mut().zip(change).for_each(|(c, change)| *c -= *change * *weight);
        }
        let total = dot(&correction, &correction).sqrt();
        let reach = ACCELERATION_REACH * step_length;
        let scale = if total > reach { reach / total } else { 1.0 };
        let most = ACCELERATION_REACH_OF_A_FACE * reach / (frames.len() as f64).sqrt();
        frames.par_iter_mut().zip(&correction).for_each(|(frame, c)| {
            let c = (*c * scale).clamp_length_max(most);
            let angle = c.length();
            if angle > 0.0 {
                *frame = (*frame * crate::algebra::quaternion::exp(angle, c / angle)).normalize();
            }
        });
    }
}

/// Logarithms of the rotations from `a` to `b`: half angle times axis, in space.
fn turns(a: &[DQuat], b: &[DQuat]) -> Vec<DVec3> {
    a.par_iter()
        .zip(b)
        .map(|(a, b)| {
            let q = a.conjugate() * *b;
            let v = DVec3::new(q.x, q.y, q.z);
            let sine = v.length();
            let v = if sine > 1e-12 { v * (libm::atan2(sine, q.w.abs()) / sine) } else { v };
            if q.w < 0.0 { -v } else { v }
        })
        .collect()
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    inner_product(a, b, DVec3::dot)
}
