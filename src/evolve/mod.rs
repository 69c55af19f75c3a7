//! The simulation: from frame to frame, phases, THE step, stopping, and the report per frame.

mod acceleration;
mod classes;
mod contradictions;
mod course;
mod discretization;
mod error;
mod follow;
mod orientation;
mod pace;
mod phase;
mod placement;
mod places;
mod progress;
mod realize;
mod relax;
mod relaxation;
mod report;
mod simulation;
mod smoothness;

pub use classes::clock_of;
pub use error::{EvolveError, SetupError};
pub use pace::{Pace, Settling};
pub use phase::{Phase, PhaseError, default_phases, phase_sections, phases_from_scene};
pub use progress::{Observer, Progress, Unobserved};
pub use relax::MAX_RESTARTS;
pub use report::{BendingError, ComponentReport, Cursor, FrameReport, NO_CLASS, Places};
pub use simulation::{Checkpoint, Frame, Simulation};
