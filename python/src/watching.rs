//! Progress, signals and stopping: what happens between two steps of a simulation that runs without the interpreter.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use immerse::evolve::{self, Observer};
use immerse::polish::PolishStep;
use pyo3::prelude::*;

/// How often signals are looked for where nobody asks to be told of every step.
const LOOK: Duration = Duration::from_millis(50);

/// Where a relaxation stands after a step; what progress callbacks are given.
#[pyclass(module = "immerse", frozen, get_all)]
pub struct Progress {
    /// "relax" while a frame goes through the phases, "follow" while a film follows its metric.
    doing: &'static str,
    /// The frame that is being made, from 1.
    frame: usize,
    /// Number of frames.
    frames: usize,
    /// The connected component that is being relaxed, from 0.
    component: usize,
    /// Number of components.
    components: usize,
    /// The phase, from 0.
    phase: usize,
    /// Number of phases.
    phases: usize,
    /// Steps taken in this phase.
    step: usize,
    /// The most steps that it may take.
    max_steps: usize,
    /// How often frames were drawn anew because rims would not resolve.
    restarts: usize,
    /// Root mean square of the relative length errors of all edges.
    error: f64,
    /// Number of rims.
    rims: usize,
    /// Mean turn of the frames in the step, in degrees.
    turn: f64,
}

#[pymethods]
impl Progress {
    fn __repr__(&self) -> String {
        let Progress { doing, frame, frames, phase, step, error, rims, .. } = self;
        format!(
            "<immerse.Progress: {doing}, frame {frame} of {frames}, phase {phase}, step {step}, error {error:.3e}, {rims} rims>"
        )
    }
}

impl Progress {
    fn of(now: &evolve::Progress, frames: usize) -> Progress {
        Progress {
            doing: if now.phase < now.phases { "relax" } else { "follow" },
            frame: now.frame.max(1),
            frames,
            component: now.component,
            components: now.components,
            phase: now.phase,
            phases: now.phases,
            step: now.step,
            max_steps: now.max_steps,
            restarts: now.restarts,
            error: now.l2_length_error,
            rims: now.rims,
            turn: now.turn,
        }
    }
}

/// Watches a simulation for Python: calls back, and looks for signals.
pub struct Watcher {
    callback: Option<Py<PyAny>>,
    frames: usize,
    looked: Instant,
    /// What the callback or a signal raised.
    raised: Option<PyErr>,
}

impl Watcher {
    /// With a callback, if there is one, of a film of so many frames.
    pub fn new(callback: Option<Py<PyAny>>, frames: usize) -> Watcher {
        Watcher { callback, frames, looked: Instant::now(), raised: None }
    }

    /// What is to be raised in place of the error of a simulation that was stopped.
    pub fn raised(self) -> Option<PyErr> {
        self.raised
    }

    fn look(&mut self, now: &evolve::Progress) -> PyResult<bool> {
        self.looked = Instant::now();
        Python::attach(|py| {
            py.check_signals()?;
            let Some(callback) = &self.callback else { return Ok(true) };
            let answer = callback.bind(py).call1((Progress::of(now, self.frames),))?;
            Ok(answer.is_none() || answer.is_truthy()?)
        })
    }
}

impl Observer for Watcher {
    fn after_step(&mut self, now: &evolve::Progress) -> ControlFlow<()> {
        if self.callback.is_none() && self.looked.elapsed() < LOOK {
            return ControlFlow::Continue(());
        }
        match self.look(now) {
            Ok(true) => ControlFlow::Continue(()),
            Ok(false) => ControlFlow::Break(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    fn after_polish_step(&mut self, _: &PolishStep) -> ControlFlow<()> {
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}
