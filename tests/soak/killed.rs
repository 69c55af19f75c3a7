//! Killed at random moments, a film goes on to the same files.

use crate::contents::Contents;
use crate::random::Random;
use crate::{PROGRAM, Tally, exported_film, finish};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Kills of one film, before it is let go to its end.
const IN_A_ROW: usize = 5;

/// Whether the program was still at work after that time, and was killed.
fn killed_after(at: &Path, out: &str, time: Duration) -> bool {
    let mut child = Command::new(PROGRAM)
        .current_dir(at)
        .args(["run", "film.toml", "--out", out])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(time);
    let at_work = child.try_wait().expect("a state").is_none();
    let _ = child.kill();
    child.wait().expect("ended");
    at_work
}

fn kill(kills: usize, frames: usize, seed: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), exported_film(frames)).expect("a scene");
    let start = Instant::now();
    finish(at, "whole");
    let duration = start.elapsed();
    let whole = Contents::of(&at.join("whole"));

    let mut random = Random(seed);
    let (mut tally, mut done, mut rounds) = (Tally::default(), 0, 0);
    while done < kills {
        rounds += 1;
        assert!(rounds <= 20 * kills, "it was done before it could be killed, nearly always");
        let out = format!("film-{rounds}");
        let hits = (0..IN_A_ROW.min(kills - done)).filter(|_| killed_after(at, &out, duration.mul_f64(random.unit())));
        let hits = hits.count();
        finish(at, &out);
        let lost = whole.differences(&Contents::of(&at.join(&out)));
        for _ in 0..hits {
            tally.count(&format!("round {rounds}, seed {seed}"), lost.clone());
        }
        done += hits;
        let _ = fs::remove_dir_all(at.join(&out));
    }
    tally.conclude("kill -9 at random moments");
}

#[test]
fn kills_at_random_moments() {
    kill(50, 6, 1);
}

#[test]
#[ignore = "long: half an hour"]
fn kills_at_random_moments_long() {
    kill(2000, 12, 2);
}
