//! The simulation: from frame to frame, phases, THE step, stopping, and the report per frame.

mod acceleration;
mod contradictions;
mod course;
mod discretization;
mod error;
mod follow;
mod orientation;
mod places;
mod pace;
mod phase;
mod placement;
mod progress;
mod realize;
mod relax;
mod relaxation;
mod report;
mod simulation;
mod smoothness;

pub use error::{EvolveError, SetupError};
pub use pace::{Pace, Settling};
pub use phase::{Phase, default_phases, phases_from_scene};
pub use progress::{Observer, Progress, Unobserved};
pub use report::{BendingError, ComponentReport, Cursor, FrameReport, Places};
pub use simulation::{Checkpoint, Frame, Simulation};
