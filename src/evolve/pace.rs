//! How a film passes from frame to frame.

use super::Phase;
use crate::scene::{ClockSection, PhaseSection, SpinSection};

/// What happens between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Another class, relaxed from the start.
    EachClass,
    /// So many steps of the relaxation.
    Steps(usize),
    /// The metric moves on, and the surface follows until it has settled.
    Settle(Settling),
}

/// When a frame that follows a change has settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// Mean turn of the frames per step in radians below which it has.
    pub tolerance_radians: f64,
    /// It has to after this many steps.
    pub max_steps: usize,
    /// No edge changes its length by more than this share at once.
    pub max_strain: f64,
}

impl Pace {
    /// From the `[clock]` of a scene; `changes` is whether anything in the scene changes with time.
    pub fn from_scene(clock: &ClockSection, spin: &SpinSection, changes: bool) -> Pace {
        match clock.steps_per_frame {
            _ if *spin == SpinSection::All => Pace::EachClass,
            Some(steps) if clock.frames > 1 => Pace::Steps(steps),
            None if clock.frames > 1 && !changes => Pace::Steps(STEPS_PER_FRAME),
            _ => Pace::Settle(Settling {
                tolerance_radians: clock.tolerance.to_radians(),
                max_steps: clock.max_steps,
                max_strain: clock.max_strain,
            }),
        }
    }
}

impl Settling {
    /// The last phase of a relaxation, until the frame has settled.
    pub(super) fn phase(&self, phases: &[Phase]) -> Phase {
        let last = phases.last().copied().unwrap_or_else(|| Phase::from_scene(&PhaseSection::default()));
        Phase { tolerance_radians: self.tolerance_radians, max_steps: self.max_steps, untangle_steps: 0, ..last }
    }
}

/// Of a film of the relaxation whose scene does not say.
const STEPS_PER_FRAME: usize = 2;
