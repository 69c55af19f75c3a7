//! The sections of a scene, one function each: its keys, what they may be, and their defaults.

mod bending;
mod checks;
mod clock;
mod look;
mod mesh;
mod metric;
mod phase;
mod picture;
mod pin;
mod polish;
mod root;
mod selection;
mod solid;
mod spin;
mod start;

pub(super) use root::root;
