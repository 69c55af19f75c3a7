//! The command line: arguments, progress, tables, exit codes.
//!
//! Standard output carries results, standard error messages and progress. Exit codes: 0 done, 1 failed
//! while running (a check that does not hold included), 2 the input is at fault, 75 another process is at work in the
//! folder, 128 and the number of the signal that ended the program.

mod arguments;
mod certify;
mod check;
mod commands;
mod diagnostics;
mod export;
mod failure;
mod farm;
mod forecast;
mod gallery;
mod leftovers;
mod new;
mod pipeline;
mod preview;
mod process;
mod progress;
mod report;
mod results;
mod selections;
mod set_up;
mod shell;
mod sweep;

pub use arguments::{FrameRange, FrameRangeError};
pub use commands::main;
pub use failure::PipelineError;
pub use pipeline::Summary;
pub use results::{Check, check_of_homotopy, checks_of, curves_csv, curves_svg, step_limit_line, verdict};
