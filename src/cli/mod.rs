//! The command line: arguments, progress, tables, exit codes.
//!
//! Standard output carries results, standard error messages and progress. Exit codes: 0 done, 1 failed
//! while running (a check that does not hold included), 2 the input is at fault.

mod arguments;
mod check;
mod checks;
mod commands;
mod curves;
mod diagnostics;
mod failure;
mod frame_range;
mod gallery;
mod inspect;
mod picture_options;
mod pipeline;
mod progress;
mod selections;
mod set_up;
mod text_table;
mod verdict;

pub use checks::{Check, checks_of, step_limit_line};
pub use commands::main;
pub use curves::{curves_csv, curves_svg};
pub use failure::PipelineError;
pub use frame_range::{FrameRange, FrameRangeError};
pub use pipeline::Summary;
pub use progress::Stages;
pub use verdict::verdict;
