//! The curves of a picture that are drawn as lines.

mod edges;
mod intersect;
mod tubes;

pub use intersect::self_intersections;
pub use tubes::tubes;
