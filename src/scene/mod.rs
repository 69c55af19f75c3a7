//! What the scene file says.

mod data;

pub use data::*;
