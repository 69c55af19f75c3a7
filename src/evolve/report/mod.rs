//! What a frame is worth: the report, and what it is measured from.

mod frame_report;
mod measure;
mod worst_places;

pub use frame_report::{BendingError, ComponentReport, FrameReport, NO_CLASS, Places};
pub(super) use measure::{compare, measure};
