//! The simulation: phases, THE step, stopping, and the report per frame.

mod acceleration;
mod error;
mod phase;
mod progress;
mod report;
mod simulation;

pub use error::{EvolveError, SetupError};
pub use phase::{Phase, default_phases, phases_from_scene};
pub use progress::{Observer, Progress, Unobserved};
pub use report::{Cursor, FrameReport};
pub use simulation::{Frame, Simulation};
