//! The relaxation of one connected component: Algorithm 2, its step (Algorithm 8), and what decides when it ends.

mod acceleration;
mod algorithm;
mod control;
mod cursor;
mod draws;
mod mending;
mod mirror_image;
mod phase;
mod relaxation;
mod restart;
mod smoothness;
mod step;

pub use cursor::Cursor;
pub use phase::{Phase, PhaseError, Schedule, TimeStep};
pub(super) use relaxation::{Among, Beginning, Relaxation, split};
