//! A fault at every call of the system that touches a film's files: the program says so and ends, no half file counts,
//! and the same command makes the same film.

use crate::contents::Contents;
use crate::{PROGRAM, Tally, exported_film, finish, has};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output};

/// Calls whose failure a disk can cause.
const CALLS: [&str; 10] =
    ["openat", "mkdir", "write", "pwrite64", "fsync", "fdatasync", "rename", "renameat", "renameat2", "unlink"];

const FAULTS: [&str; 3] = ["error=EIO", "error=ENOSPC", "signal=KILL"];

fn traced(at: &Path, out: &str, log: &str, options: &[&str]) -> Output {
    let mut command = Command::new("strace");
    command.current_dir(at).args(["-f", "-qq", "-o", log]).args(options);
    command.args([PROGRAM, "--threads", "1", "run", "film.toml", "--out", out]);
    command.output().expect("strace starts")
}

/// Of each call, which ones of a thread touch what is ours: a folder whose path begins like this, or a file that is open.
fn occurrences(log: &str, folder: &str) -> BTreeMap<(&'static str, usize), ()> {
    let mut counts: BTreeMap<(String, &str), usize> = BTreeMap::new();
    let mut ours = BTreeMap::new();
    for line in log.lines() {
        let (thread, rest) = line.split_once(' ').unwrap_or(("", line));
        let Some(call) = CALLS.into_iter().find(|call| rest.trim_start().starts_with(&format!("{call}("))) else {
            continue;
        };
        let count = counts.entry((thread.to_owned(), call)).or_default();
        *count += 1;
        // The system's own libraries are none of a film's files.
        if call != "openat" || rest.contains(folder) || rest.contains("film.toml") {
            ours.insert((call, *count), ());
        }
    }
    ours
}

/// Injects every fault at every point of a film.
fn inject(frames: usize) {
    if !has("strace", &["-f", "-o", "/dev/null", "true"]) {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), exported_film(frames)).expect("a scene");
    finish(at, "whole");
    let whole = Contents::of(&at.join("whole"));
    assert!(whole.count() > 3 * frames, "a frame has its state, its report and its picture");

    let trace = format!("trace={}", CALLS.map(|call| format!("?{call}")).join(","));
    assert!(traced(at, "film-traced", "log", &["-e", &trace]).status.success());
    let log = fs::read_to_string(at.join("log")).expect("a log");
    let points: Vec<_> = occurrences(&log, "film-traced").into_keys().collect();
    assert!(points.len() > 10 * frames, "{} points", points.len());

    let mut tally = Tally::default();
    for (number, &(call, when)) in points.iter().enumerate() {
        for fault in FAULTS {
            let name = format!("{fault} at {call} {when}");
            let out = format!("film-{number}-{}", &fault[6..]);
            let output = traced(
                at,
                &out,
                "log",
                &["-e", &format!("trace={call}"), "-e", &format!("inject={call}:{fault}:when={when}")],
            );
            let mut lost = judged(&output, fault);
            if output.status.success() {
                // What was hit does not matter to the film, as a message does not. A lock that nobody could remove
                // is in nobody's way.
                let differences = whole.differences(&Contents::of(&at.join(&out)));
                lost.extend(differences.into_iter().filter(|difference| difference != ".lock is too many"));
            }
            let again = crate::run(at, &["run", "film.toml", "--out", &out]);
            if again.status.success() {
                lost.extend(whole.differences(&Contents::of(&at.join(&out))));
            } else {
                lost.push(format!("the next run fails: {}", String::from_utf8_lossy(&again.stderr)));
            }
            tally.count(&name, lost);
            let _ = fs::remove_dir_all(at.join(&out));
        }
    }
    tally.conclude(&format!("faults injected at {} points of {frames} frames", points.len()));
}

/// What is wrong with how the program ended.
fn judged(output: &Output, fault: &str) -> Vec<String> {
    let said = String::from_utf8_lossy(&output.stderr);
    match (output.status.code(), output.status.signal()) {
        (Some(0), _) => Vec::new(),
        (Some(1 | 2), _) if fault.starts_with("error") && !said.contains("panicked") => Vec::new(),
        (None, Some(9)) if fault.starts_with("signal") => Vec::new(),
        _ => vec![format!("it ended with {}, saying `{}`", output.status, said.trim())],
    }
}

#[test]
fn faults_of_the_disk() {
    inject(2);
}

#[test]
#[ignore = "long: an hour"]
fn faults_of_the_disk_long() {
    inject(20);
}
