//! What is said on standard error: how far a run is, messages, and the same as JSON.

mod estimate;
mod log;
mod record;
mod standing;
#[cfg(test)]
mod tests;
mod voice;

pub(super) use log::Log;
pub(super) use standing::Kept;
pub(super) use voice::LogFormat;
