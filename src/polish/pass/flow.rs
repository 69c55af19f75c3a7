//! Steps of a thin shell downhill, none of which folds a hinge over or crushes a face.

use super::error::PassError;
use crate::polish::energy::{Energy, Stiffness};
use crate::polish::newton::{Drag, NewtonSystem};
use crate::polish::settings::{PolishStep, Watch};
use crate::tuning::{ARMIJO, GENTLE_HINGE_TURN, HALVINGS_OF_A_POLISH_STEP};
use glam::DVec3;

/// A shell that moves downhill.
pub(super) struct Flow<'a, 'b> {
    system: NewtonSystem,
    /// Per vertex: its area in squared mean edge lengths.
    pub masses: Vec<f64>,
    /// What resists moves of a vertex, per mass.
    pub drag: f64,
    /// Force on each vertex, |V|, or none.
    pub push: Vec<DVec3>,
    progress: Progress<'a, 'b>,
}

/// What is told of the steps.
pub(super) struct Progress<'a, 'b> {
    watch: &'a mut Watch<'b>,
    steps: usize,
    max_steps: usize,
}

/// A surface with its bending angles, in mean edge lengths and radians.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub positions: Vec<DVec3>,
    pub angles: Vec<f64>,
}

/// What a step was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    /// The share that was taken of it.
    pub share: f64,
    /// How far it moved a vertex at most, in mean edge lengths.
    pub farthest: f64,
}

impl Shape {
    pub fn new(energy: &Energy, positions: Vec<DVec3>) -> Shape {
        Shape { angles: energy.angles(&positions), positions }
    }

    fn parts(&self) -> (&[DVec3], &[f64]) {
        (&self.positions, &self.angles)
    }
}

impl<'a, 'b> Progress<'a, 'b> {
    pub fn new(watch: &'a mut Watch<'b>) -> Progress<'a, 'b> {
        Progress { watch, steps: 0, max_steps: 0 }
    }
}

impl<'a, 'b> Flow<'a, 'b> {
    pub fn new(system: NewtonSystem, masses: Vec<f64>, progress: Progress<'a, 'b>) -> Flow<'a, 'b> {
        Flow { system, masses, drag: 0.0, push: Vec::new(), progress }
    }

    /// Says how many steps may follow.
    pub fn announce(&mut self, steps: usize) {
        self.progress.max_steps = self.progress.steps + steps;
    }

    /// One step, no longer than `farthest`, with what is kept of the step before as `momentum`, |V|. `None` if no part of it leads
    /// downhill. `symmetric` makes moves of the symmetry that the surface has.
    pub fn step(
        &mut self,
        energy: &Energy,
        shape: &mut Shape,
        stiffness: Stiffness,
        farthest: f64,
        momentum: Option<&[DVec3]>,
        symmetric: &dyn Fn(&mut [DVec3]),
    ) -> Result<Option<Taken>, PassError> {
        let height = |shape: &Shape| {
            let work: f64 = shape.positions.iter().zip(&self.push).map(|(p, push)| p.dot(*push)).sum();
            energy.value(&shape.positions, &shape.angles, stiffness) - work
        };
        let before = height(shape);
        let drag = Drag { masses: &self.masses, drag: self.drag, push: &self.push };
        let direction = self.system.direction(energy, &shape.positions, stiffness, Some(&drag))?;
        let (mut moves, mut slope) = (direction.moves, direction.slope);
        if let Some(momentum) = momentum {
            // It must not lead uphill.
            let more = self.system.slope_along(momentum);
            if slope + more > LEAST_SLOPE * slope {
                moves.iter_mut().zip(momentum).for_each(|(x, more)| *x += *more);
                slope += more;
            }
        }
        symmetric(&mut moves);
        let longest = moves.iter().map(|x| x.length()).fold(0.0, f64::max);
        let mut share = (farthest / longest).min(1.0);
        for _ in 0..=HALVINGS_OF_A_POLISH_STEP {
            let mut next: Vec<DVec3> = shape.positions.iter().zip(&moves).map(|(p, x)| *p + *x * share).collect();
            symmetric(&mut next);
            let next = Shape::new(energy, next);
            if energy.is_regular(shape.parts(), next.parts(), GENTLE_HINGE_TURN)
                && height(&next) <= before - ARMIJO * share * slope
            {
                *shape = next;
                self.tell(energy, shape, stiffness)?;
                return Ok(Some(Taken { share, farthest: share * longest }));
            }
            share *= 0.5;
        }
        Ok(None)
    }

    fn tell(&mut self, energy: &Energy, shape: &Shape, stiffness: Stiffness) -> Result<(), PassError> {
        let Progress { watch, steps, max_steps } = &mut self.progress;
        *steps += 1;
        let l2_length_error = energy.l2_strain(&shape.positions);
        let step = PolishStep { step: *steps, max_steps: *max_steps, l2_length_error, stiffness: stiffness.bending };
        match watch(&step).is_break() {
            true => Err(PassError::Stopped { steps: *steps }),
            false => Ok(()),
        }
    }
}

/// The part of its slope that momentum must leave to a step.
const LEAST_SLOPE: f64 = 0.3;
