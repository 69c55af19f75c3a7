//! From what a scene says to the values that the rooms take. Nothing else knows both.
//!
//! Every function complains at the key that is at fault, with line and caret.

mod bending;
mod clock;
mod faults;
mod mesh;
mod metric;
mod numbers;
mod phases;
mod pins;
mod simulation;
mod start;

pub use clock::clock_of;
pub(super) use phases::degrees;
pub use phases::phases_as_text;
