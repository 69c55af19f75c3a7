//! How long a simulation will take, found by a few steps of each phase.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::evolve::{Observer, Pace, Phase, Polishing, Program, Progress, Schedule, Settling, SetupError, Simulation};
use crate::mesh::Surface;

/// Steps of each phase that are tried.
const TRIED: usize = 3;
/// A trial ends after this time, with what is known by then.
const LONGEST: Duration = Duration::from_secs(6);
/// Steps that a phase takes, mostly, if it may take as many.
const OF_PHASE: usize = 45;
/// Steps that a frame takes to settle after the metric has changed, mostly.
const OF_FRAME: usize = 12;

/// What frames cost.
pub(super) struct Costs {
    /// The first frame, with all that is set up before.
    pub first: Duration,
    /// Each other one that follows it.
    pub next: Duration,
}

/// Takes a few steps of each phase of the first frame, and of the second one.
pub(super) fn try_some_steps(surface: Surface, program: Program) -> Result<Costs, SetupError> {
    let begin = Instant::now();
    let (pace, is_film) = (program.pace, program.clock.frames() > 1);
    let phases = program.schedule.phases().to_vec();
    let mut simulation = Simulation::new(surface, few_steps(program))?;
    let mut watch = Stopwatch::new(phases.len() + 1);
    let first = tried(&mut simulation, &mut watch);
    let typical = |phase: &Phase| OF_PHASE.clamp(phase.min_steps, phase.max_steps.max(phase.min_steps));
    let left: Duration = (0..).zip(&phases).map(|(k, phase)| watch.rest(k, typical(phase))).sum();
    let mut costs = Costs { first: begin.elapsed() + left, next: Duration::ZERO };
    if !is_film {
        return Ok(costs);
    }
    let (of_frame, phase) = match pace {
        Pace::Steps(steps) => (steps, 0),
        Pace::Settle(settling) => (OF_FRAME.min(settling.max_steps()), phases.len()),
        Pace::EachClass | Pace::BothWays(_) => return Ok(costs),
    };
    let begin = Instant::now();
    if first && tried(&mut simulation, &mut watch) {
        costs.next = begin.elapsed() + watch.rest(phase, of_frame);
    } else {
        costs.next = watch.all(phases.len(), of_frame);
    }
    Ok(costs)
}

/// The same, with a few steps in each phase and of each frame.
fn few_steps(program: Program) -> Program {
    let short = |phase: &Phase| {
        let steps = TRIED.min(phase.max_steps);
        Phase { min_steps: phase.min_steps.min(steps), max_steps: steps, untangle_steps: 0, ..*phase }
    };
    let schedule = Schedule::new(program.schedule.phases().iter().map(short).collect());
    let pace = match program.pace {
        Pace::Steps(steps) => Pace::Steps(steps.min(TRIED)),
        Pace::Settle(settling) => {
            let steps = settling.max_steps().min(TRIED);
            Settling::new(settling.tolerance_radians(), steps, settling.max_strain()).map_or(program.pace, Pace::Settle)
        }
        Pace::EachClass | Pace::BothWays(_) => program.pace,
    };
    Program { schedule: schedule.unwrap_or_else(|_| program.schedule.clone()), pace, polish: Polishing::Off, ..program }
}

/// Whether a frame was made before it was stopped. What goes wrong so early would not in a run, or be told there.
fn tried(simulation: &mut Simulation, watch: &mut Stopwatch) -> bool {
    watch.last = Instant::now();
    simulation.next_frame(watch).is_ok()
}

/// Measures the steps of each phase.
struct Stopwatch {
    begin: Instant,
    last: Instant,
    /// Per phase, and of frames that follow: how many steps were taken, and how long the shortest took.
    steps: Vec<(usize, Duration)>,
}

impl Stopwatch {
    fn new(phases: usize) -> Stopwatch {
        let now = Instant::now();
        Stopwatch { begin: now, last: now, steps: vec![(0, Duration::MAX); phases] }
    }

    /// How long so many steps of a phase take; of one that was not come by, as long as those of the last one that was.
    fn all(&self, phase: usize, steps: usize) -> Duration {
        let known = self.steps.iter().take(phase + 1).rev().find(|(taken, _)| *taken > 0);
        known.map_or(Duration::ZERO, |(_, each)| each.saturating_mul(steps as u32))
    }

    /// How long those take that were not taken in the trial.
    fn rest(&self, phase: usize, steps: usize) -> Duration {
        let taken = self.steps.get(phase).map_or(0, |(taken, _)| *taken);
        self.all(phase, steps.saturating_sub(taken))
    }
}

impl Observer for Stopwatch {
    fn after_step(&mut self, now: &Progress) -> ControlFlow<()> {
        let time = Instant::now();
        if let Some((taken, each)) = self.steps.get_mut(now.phase) {
            *taken += 1;
            *each = (*each).min(time - self.last);
        }
        self.last = time;
        // With so few steps rims are left, and frames would be drawn anew.
        let is_over = now.restarts > 0 || self.begin.elapsed() > LONGEST;
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
