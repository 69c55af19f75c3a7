//! How a surface is polished, and what is told of it.

use super::report::PolishReport;
use crate::tuning::{GENTLE_POLISH, MAX_BENDING_GROWTH, POLISH_FADE};
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
