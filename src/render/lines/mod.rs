//! The curves of a picture that are drawn as lines.

mod edges;
mod intersect;
mod tubes;

pub use tubes::tubes;
