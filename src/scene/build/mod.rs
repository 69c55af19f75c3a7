//! From what a scene says to the values that the rooms take. Nothing else knows both.
//!
//! Every function complains at the key that is at fault, with line and caret.

mod bending;
mod camera;
mod clock;
mod faults;
mod files;
mod light;
mod look;
mod mesh;
mod metric;
mod numbers;
mod output;
mod phases;
mod pins;
mod simulation;
mod start;

pub use camera::view;
pub use clock::clock_of;
pub use light::lights;
pub use look::look;
pub use output::output;
pub(super) use phases::degrees;
pub use phases::phases_as_text;
