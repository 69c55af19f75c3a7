//! Whole runs: from lengths to the surface, phase by phase.

use std::{error::Error, ops::ControlFlow, time::Instant};

use immerse::evolve::{EvolveError, Observer, Progress};
use serde_json::{Value, json};

use super::scenes::scene;

#[derive(Clone, Default)]
struct Phase {
    steps: usize,
    inner_iterations: usize,
    seconds: f64,
}

struct Tally {
    phases: Vec<Phase>,
    restarts: usize,
    last: Instant,
    /// Length error at which the run may end.
    target: f64,
    /// Steps left before it is looked at again.
    pause: usize,
}

impl Observer for Tally {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.phases.resize(self.phases.len().max(progress.phase + 1), Phase::default());
        let phase = &mut self.phases[progress.phase];
        phase.steps += 1;
        phase.inner_iterations += progress.inner_iterations;
        phase.seconds += self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        self.restarts = progress.restarts;
        self.pause = self.pause.saturating_sub(1);
        if progress.l2_length_error <= self.target && self.pause == 0 {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Runs a surface through the default phases, at most `steps_per_phase` in each, or until its length error is at most
/// `target` and it has neither rims nor pinch points.
pub fn run(name: &str, target: Option<f64>, steps_per_phase: Option<usize>) -> Result<Value, Box<dyn Error>> {
    let scene = scene(name)?;
    let surface = scene.surface()?;
    let begin = Instant::now();
    let mut simulation = scene.simulation_of(surface)?;
    let setup = begin.elapsed().as_secs_f64();
    if let Some(steps) = steps_per_phase {
        simulation.change_phases(|phases| {
            for phase in phases {
                phase.max_steps = phase.max_steps.min(steps);
                phase.min_steps = phase.min_steps.min(phase.max_steps);
                phase.untangle_steps = 0;
            }
        })?;
    }
    // A relaxation that is given its number of steps does not start over because of rims.
    let cut = steps_per_phase.map(|steps| steps * simulation.phases().len());
    let mut tally =
        Tally { phases: Vec::new(), restarts: 0, last: Instant::now(), target: target.unwrap_or(0.0), pause: 0 };
    let frame = loop {
        let outcome = match cut {
            None => simulation.relax(&mut tally),
            Some(steps) => simulation.advance(steps, &mut tally),
        };
        match outcome {
            Ok(frame) => break frame,
            Err(EvolveError::Stopped { .. }) => {
                let frame = simulation.advance(0, &mut tally)?;
                if frame.report.rims == 0 && frame.report.pinch_points == 0 {
                    break frame;
                }
                tally.pause = 5;
            }
            Err(error) => return Err(error.into()),
        }
    };
    let seconds = begin.elapsed().as_secs_f64();
    let in_phases: f64 = tally.phases.iter().map(|phase| phase.seconds).sum();
    let phases: Vec<Value> = tally
        .phases
        .iter()
        .map(|p| json!({ "steps": p.steps, "inner_iterations": p.inner_iterations, "seconds": p.seconds }))
        .collect();
    Ok(json!({
        "faces": simulation.mesh().face_count(),
        "seconds": seconds,
        "setup_seconds": setup,
        "other_seconds": seconds - setup - in_phases,
        "phases": phases,
        "steps": tally.phases.iter().map(|phase| phase.steps).sum::<usize>(),
        "inner_iterations": tally.phases.iter().map(|phase| phase.inner_iterations).sum::<usize>(),
        "restarts": tally.restarts,
        "l2_length_error": frame.report.l2_length_error,
        "rims": frame.report.rims,
        "pinch_points": frame.report.pinch_points,
        "class": frame.report.spin_class,
        "converged": frame.report.converged,
    }))
}
