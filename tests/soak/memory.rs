//! The memory of a film does not grow with its frames, but for what is known of each: its keys, its checksums and its report.

use crate::{PROGRAM, film};
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The most memory that a process has held so far, in kilobytes.
fn peak(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix("kB")?.trim().parse().ok())
}

/// Kilobytes of keys, checksums, and the report with its line of `curves.csv`. At the end they are held of all frames; in a film
/// of hundreds they disappear in what is freed by then.
const KNOWN_OF_A_FRAME: f64 = 2.0;

/// Runs a film and compares its peak at the last frame with that at frame 20.
fn memory(frames: usize) {
    if peak(std::process::id()).is_none() {
        eprintln!("SKIPPED: this system does not say how much memory a process holds");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    // The page of a film is put together in memory, in which it takes up to some 100 MB, however long the film is.
    fs::write(at.join("film.toml"), film(frames) + "report = false\n").expect("a scene");
    let mut child = Command::new(PROGRAM)
        .current_dir(at)
        .args(["run", "film.toml", "--out", "film", "--threads", "1"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let (mut early, mut last) = (None, None);
    while child.try_wait().expect("a state").is_none() {
        last = peak(child.id()).or(last);
        if early.is_none() && at.join("film/000020.png").exists() {
            early = last;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(child.wait().expect("ended").success());
    let (early, last) = (early.expect("the film was sampled"), last.expect("the film was sampled"));
    eprintln!("memory over a film of {frames} frames: {early} kB at frame 20, {last} kB at the last");
    let known = KNOWN_OF_A_FRAME * frames.saturating_sub(240) as f64;
    assert!(last as f64 <= 1.02 * early as f64 + known, "{early} kB at frame 20, {last} kB at the last");
}

#[test]
fn memory_over_a_film() {
    memory(240);
}

#[test]
#[ignore = "long: an hour"]
fn memory_over_a_film_long() {
    memory(10_000);
}
