//! What is found of a film before it is simulated: the keys of its frames, and pins that contradict the metric.

mod contradictions;
mod keys;

pub(super) use contradictions::contradictions;
pub use keys::ALGORITHM;
pub(super) use keys::{LookAhead, keys_of, origin_of};
