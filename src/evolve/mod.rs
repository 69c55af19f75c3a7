//! The simulation: from frame to frame, phases, THE step, stopping, and the report per frame.

mod acceleration;
mod discretization;
mod error;
mod follow;
mod pace;
mod phase;
mod placement;
mod progress;
mod realize;
mod relax;
mod report;
mod simulation;

pub use error::{EvolveError, SetupError};
pub use pace::{Pace, Settling};
pub use phase::{Phase, PhaseError, default_phases, phase_sections, phases_from_scene};
pub use progress::{Observer, Progress, Unobserved};
pub use report::{Cursor, FrameReport, NO_CLASS};
pub use simulation::{Checkpoint, Frame, Simulation, clock_of};
