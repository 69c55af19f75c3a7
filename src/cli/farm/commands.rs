//! Lists of shell commands, one a line.

use super::job::{Job, Step, Tasks};
use super::written::Written;
use crate::cli::shell::line;

/// All files there may be.
pub(super) const FILES: &[&str] =
    &["1-simulate.txt", "2-pictures.txt", "3-assemble.txt", "2-assemble.txt", "1-runs.txt"];

/// A file for each step, in their order.
pub(super) fn write(job: &Job) -> Written {
    let file = |(number, step): (usize, &Step)| (format!("{number}-{}.txt", step.name), lines(&job.program, step));
    let files = (1..).zip(&job.steps).map(file).collect();
    // A run whose checks do not hold is a row of the table of its sweep.
    let otherwise = if job.frames.is_some() { " || break" } else { "" };
    let start = format!("for step in {{}}/?-*.txt; do parallel --retries 3 <\"$step\"{otherwise}; done");
    Written { files, start }
}

fn lines(program: &str, step: &Step) -> String {
    let command = |more: &[String]| line(&[&[program.to_owned()], &*step.words, more].concat()) + "\n";
    match &step.tasks {
        Tasks::One => command(&[]),
        Tasks::Frames(tasks) | Tasks::Runs(tasks) => tasks.iter().map(|task| command(task)).collect(),
    }
}
