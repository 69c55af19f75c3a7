//! How pictures come by the frames of a film: in order, several at a time, also while frames are still being computed.

mod arrivals;
mod event;
mod in_order;
mod memory;
mod reel;
mod survey;

pub use arrivals::Arrivals;
pub use event::{Event, Watch};
pub(in crate::film) use in_order::in_order;
pub(in crate::film) use memory::at_a_time;
pub(super) use memory::picture_bytes;
pub(super) use reel::{Frames, Reel};
pub(super) use survey::{Survey, metadata, survey};
