//! What a run survives: faults of the disk, being killed, other processors, other numbers of threads, long films.
//!
//! The short forms run with all other tests. The long ones take hours:
//!
//!     cargo test --release --locked --test soak -- --ignored --nocapture --test-threads 1
//!
//! Each prints how often it tried, how often the film survived and how often it was lost. What the machine lacks is
//! SKIPPED.
#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "tests fail by panicking, and say on standard error how far they are"
)]

mod contents;
mod corrupted;
mod injected;
mod killed;
mod memory;
mod processors;
mod random;

use std::path::Path;
use std::process::{Command, Output};

const PROGRAM: &str = env!("CARGO_BIN_EXE_immerse");

/// A small film with pictures and exports, one file of all frames and one of each.
fn exported_film(frames: usize) -> String {
    film(frames) + "export = ['usd', 'ply']\n"
}

/// A small film with pictures, in a few milliseconds a frame.
fn film(frames: usize) -> String {
    format!(
        "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[metric]\nformula = 'length * (1 + 0.2 * t * x)'\n\
         [clock]\nframes = {frames}\n[output]\nsize = [48, 36]\nsamples = 1\n"
    )
}

/// Runs the program, on one thread, and gives what it said.
fn run(at: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(PROGRAM);
    command.current_dir(at).args(["--threads", "1"]).args(arguments);
    command.output().expect("the program starts")
}

/// Runs the scene to its end in a folder.
fn finish(at: &Path, out: &str) {
    let output = run(at, &["run", "film.toml", "--out", out]);
    assert!(output.status.success(), "{out}: {}", String::from_utf8_lossy(&output.stderr));
}

/// Whether a program can be called; if not, says that a test is skipped.
fn has(program: &str, arguments: &[&str]) -> bool {
    let can = Command::new(program).args(arguments).output().is_ok_and(|output| output.status.success());
    if !can {
        eprintln!("SKIPPED: there is no {program} that works here");
    }
    can
}

/// What came of many tries.
#[derive(Default)]
struct Tally {
    tries: usize,
    lost: Vec<String>,
}

impl Tally {
    /// Counts a try: empty if the film survived it, else what was lost.
    fn count(&mut self, name: &str, lost: Vec<String>) {
        self.tries += 1;
        if !lost.is_empty() {
            self.lost.push(format!("{name}: {}", lost.join("; ")));
        }
    }

    /// Prints the figures, and fails if anything was lost.
    fn conclude(self, what: &str) {
        let Tally { tries, lost } = self;
        eprintln!("{what}: {tries} tries, {} survived, {} lost", tries - lost.len(), lost.len());
        assert!(lost.is_empty(), "{what}:\n{}", lost.join("\n"));
    }
}
