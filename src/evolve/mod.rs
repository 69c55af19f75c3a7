//! The simulation: what is asked for, the state, the relaxation, where it lies in space, and the report per frame.

mod ahead;
mod course;
mod discretization;
mod error;
mod finish;
mod follow;
mod frame;
mod immersion;
mod next_frame;
mod over_a_pass;
mod pace;
mod places;
mod program;
mod progress;
mod relax;
mod report;
mod simulation;
mod state;
#[cfg(test)]
mod tests;

pub use ahead::ALGORITHM;
pub use error::{EvolveError, FarMove, FoldedWay, ResumeError, SetupError};
pub use frame::{Frame, UnfitFrame};
pub use immersion::{ImmersedSurface, Immersion, ImmersionError};
pub use over_a_pass::NoPass;
pub use pace::{Fold, HalfwayModel, OverAPass, Pace, PaceError, Settling};
pub use program::{AskedClass, Orientation, Polishing, Program, Start};
pub use progress::{Observer, Progress, Unobserved};
pub use relax::{Cursor, Phase, PhaseError, Schedule, TimeStep};
pub use report::{BendingError, ComponentReport, FrameReport, NO_CLASS, Places};
pub use simulation::Simulation;
