//! Tests of the built program: the command line, films on disk, the scenes that ship.
#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::unreachable,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "tests fail by panicking, and their closed forms need no certain bits"
)]

mod bad_input;
mod certify;
mod classes;
mod command_line;
mod cookbook;
mod curves;
mod edited;
mod exported;
mod farm;
mod fold;
mod frame_range;
mod frame_rates;
mod hostile;
mod interrupted;
mod leftovers;
mod looking_in;
mod numpy;
mod overlap;
mod process;
mod report;
mod reproduction;
mod set;
mod shipped_scenes;
mod step_limit;
mod sweep;
mod verdict;
mod wrong_files;

#[path = "../support/mod.rs"]
mod support;
