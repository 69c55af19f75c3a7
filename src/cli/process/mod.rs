//! The process: its threads, signals, panics and streams, and the folders that it alone writes into.

mod answers;
mod panics;
mod session;
mod signals;
mod supervision;
mod threads;

pub(super) use answers::Answers;
pub(super) use session::Session;
pub(super) use signals::Signals;
pub(super) use supervision::supervised;
pub(super) use threads::make_pool;
