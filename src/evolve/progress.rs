//! Watching and stopping a running simulation.

use crate::polish::PolishStep;
use std::ops::ControlFlow;

/// The state of a relaxation after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The frame that is being made, from 1.
    pub frame: usize,
    /// The component that is being relaxed, from 0.
    pub component: usize,
    /// Number of components.
    pub components: usize,
    /// The phase, from 0; the number of phases where a film follows its metric.
    pub phase: usize,
    /// Number of phases.
    pub phases: usize,
    /// How often frames were drawn anew because rims would not resolve.
    pub restarts: usize,
    /// Steps taken in this phase.
    pub step: usize,
    /// The most steps that it may take.
    pub max_steps: usize,
    /// Mean turn of the frames in the last step, in degrees.
    pub turn: f64,
    /// The turn at which the phase ends, in degrees.
    pub tolerance: f64,
    /// Whether that was the last step of the phase because frames stand still.
    pub settled: bool,
    /// L2 length error of the integrated surface.
    pub l2_length_error: f64,
    /// Its rims.
    pub rims: usize,
    /// Iterations of the linear solver in the last step.
    pub inner_iterations: usize,
}

/// Told of every step; may stop the simulation. Closures that take a [`Progress`] and return a [`ControlFlow`] are
/// observers.
pub trait Observer {
    /// Called after every step. `Break` ends the simulation with [`super::EvolveError::Stopped`].
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()>;

    /// Called after every step of polish. `Break` ends the simulation likewise.
    fn after_polish_step(&mut self, _: &PolishStep) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl<F: FnMut(&Progress) -> ControlFlow<()>> Observer for F {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        self(progress)
    }
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn after_step(&mut self, _: &Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
