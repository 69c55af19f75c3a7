//! The simulation: what is asked for, the state, the relaxation, where it lies in space, and the report per frame.

mod contradictions;
mod course;
mod discretization;
mod error;
mod follow;
mod frame;
mod immersion;
mod keys;
mod pace;
mod placement;
mod program;
mod progress;
mod relax;
mod report;
mod row;
mod simulation;
mod state;
#[cfg(test)]
mod tests;

pub use error::{EvolveError, FarMove, ResumeError, SetupError};
pub use frame::{Frame, UnfitFrame};
pub use immersion::{ImmersedSurface, Immersion, ImmersionError};
pub use keys::ALGORITHM;
pub use pace::{Pace, PaceError, Settling};
pub use program::{AskedClass, Orientation, Program, Start};
pub use progress::{Observer, Progress, Unobserved};
pub use relax::{Cursor, Phase, PhaseError, Schedule, TimeStep};
pub use report::{BendingError, ComponentReport, FrameReport, NO_CLASS, Places};
pub use simulation::Simulation;
