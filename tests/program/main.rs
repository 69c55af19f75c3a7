//! Tests of the built program: the command line, films on disk, the scenes that ship.

mod bad_input;
mod classes;
mod command_line;
mod curves;
mod frame_range;
mod frame_rates;
mod interrupted;
mod leftovers;
mod overlap;
mod shipped_scenes;
mod step_limit;
mod verdict;
mod wrong_files;

#[path = "../support/mod.rs"]
mod support;
