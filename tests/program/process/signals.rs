//! Signals: the frame that is being made is finished or dropped, nothing half-made stays, and the same command goes on.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::thread;
use std::time::{Duration, Instant};

use super::{assert_code, assert_same, assert_tidy, end_of, err, files, film, folder_with, shell, start, wait_until};

fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill");
    assert!(sent.success(), "there was nobody to send {signal} to");
}

/// What came of a signal, and that it came of it soon.
#[track_caller]
fn after(signal: &str, child: Child) -> Output {
    let begin = Instant::now();
    send(signal, &child);
    let output = end_of(child);
    assert!(begin.elapsed() < Duration::from_secs(5), "{signal} took {:?}", begin.elapsed());
    output
}

fn has(folder: &Path, name: &str) -> impl Fn() -> bool {
    let path = folder.join(name);
    move || path.exists()
}

const FRAMES: usize = 40;

#[test]
fn interrupted_again_and_again_it_is_the_same_film() {
    let output = "animation = ['gif']\nsheet = 4\n";
    let folder = folder_with(&film(8, FRAMES, output));
    let at = folder.path();
    let arguments = |out| ["run", "film.toml", "--out", out, "-q"];
    assert_code(&end_of(start(at, &arguments("whole"))), 0);
    let out = at.join("out");
    let signals =
        [("-INT", 130, "frames/000003.json"), ("-TERM", 143, "frames/000020.json"), ("-INT", 130, "000001.png")];
    for (signal, code, sign) in signals {
        let child = start(at, &arguments("out"));
        wait_until(sign, has(&out, sign));
        let output = after(signal, child);
        assert_code(&output, code);
        let err = err(&output);
        assert!(err.contains(&format!("of {FRAMES} frames")) && err.contains("the same command goes on"), "{err}");
        assert_eq!(err.lines().count(), 1, "{err}");
        assert_tidy(&out);
    }
    assert_code(&end_of(start(at, &arguments("out"))), 0);
    assert_same(&files(&out), &files(&at.join("whole")));
}

#[test]
fn how_many_frames_are_kept_is_what_is_there() {
    let folder = folder_with(&film(8, FRAMES, ""));
    let at = folder.path();
    for (command, restart) in [("simulate", ""), ("simulate", "--restart"), ("run", "--restart")] {
        let mut arguments = vec![command, "film.toml", "--out", "out", "-q"];
        arguments.extend((!restart.is_empty()).then_some(restart));
        let _ = fs::remove_dir_all(at.join("out"));
        let child = start(at, &arguments);
        wait_until("a few frames are there", has(at, "out/frames/000005.json"));
        let output = after("-TERM", child);
        assert_code(&output, 143);
        let kept = fs::read_dir(at.join("out/frames")).expect("a folder").count() / 2;
        let again = if restart.is_empty() { "the same command goes on" } else { "the same command without --restart" };
        for part in [format!("{kept} of {FRAMES} frames"), again.to_owned()] {
            assert!(err(&output).contains(&part), "no `{part}` in {}", err(&output));
        }
    }
}

#[test]
fn a_picture_that_takes_long_is_dropped() {
    let huge = film(8, 1, "").replace("size = [64, 48]\nsamples = 4", "size = [9000, 9000]\nsamples = 16");
    let folder = folder_with(&huge);
    let at = folder.path();
    assert_code(&end_of(start(at, &["simulate", "film.toml", "--out", "out", "-q"])), 0);
    let child = start(at, &["render", "film.toml", "--out", "out", "-q"]);
    wait_until("it has begun", has(at, "out/.lock"));
    thread::sleep(Duration::from_millis(500));
    let output = after("-INT", child);
    assert_code(&output, 130);
    assert!(err(&output).contains("0 of 1 pictures are kept"), "{}", err(&output));
    assert!(!at.join("out/000001.png").exists());
    assert_tidy(&at.join("out"));
}

/// As `timeout` and `make` send it: to the program, and to the group that it is in.
#[test]
fn a_signal_that_comes_twice_at_once_is_one() {
    let folder = folder_with(&film(8, FRAMES, ""));
    let at = folder.path();
    let child = start(at, &["run", "film.toml", "--out", "out", "-q"]);
    wait_until("three frames", has(&at.join("out"), "frames/000003.json"));
    let twice = format!("kill -INT {0}; kill -INT {0}", child.id());
    assert!(shell(at, &twice).status.success());
    let output = end_of(child);
    assert_code(&output, 130);
    assert!(err(&output).contains("the same command goes on"), "{}", err(&output));
    assert_tidy(&at.join("out"));
}

#[test]
fn setting_up_is_left_at_once() {
    // A mesh that takes seconds to set up.
    let folder = folder_with(&film(300, 2, ""));
    let at = folder.path();
    let child = start(at, &["run", "film.toml", "--out", "out", "-q"]);
    wait_until("it has begun", has(at, "out/.lock"));
    let output = after("-TERM", child);
    assert_code(&output, 143);
    assert!(err(&output).contains("what is complete is kept"), "{}", err(&output));
    assert!(!at.join("out/.lock").exists());
    // Twice is at once.
    let child = start(at, &["run", "film.toml", "--out", "out", "-q"]);
    wait_until("it has begun", has(at, "out/.lock"));
    send("-INT", &child);
    thread::sleep(Duration::from_millis(100));
    let begin = Instant::now();
    assert_code(&after("-INT", child), 130);
    assert!(begin.elapsed() < Duration::from_secs(1), "{:?}", begin.elapsed());
}

#[test]
fn whoever_waits_for_a_folder_can_be_told_to_stop() {
    let folder = folder_with(&film(24, 400, ""));
    let at = folder.path();
    let first = start(at, &["simulate", "film.toml", "--out", "out", "-q"]);
    wait_until("the first one is there", has(at, "out/frames/000001.json"));
    let second = start(at, &["simulate", "film.toml", "--out", "out", "-q"]);
    thread::sleep(Duration::from_millis(300));
    assert_code(&after("-INT", second), 130);
    assert_code(&after("-HUP", first), if cfg!(target_os = "linux") { 129 } else { 130 });
    assert_tidy(&at.join("out"));
}

#[test]
fn a_gallery_ends_between_its_pictures() {
    let folder = folder_with(&film(8, FRAMES, ""));
    let at = folder.path();
    fs::write(at.join("other.toml"), film(8, 2, "")).expect("a scene");
    let arguments = ["gallery", "other.toml", "film.toml", "--out", "out", "--work", "work", "-q"];
    let child = start(at, &arguments);
    wait_until("the second film has begun", has(at, "work/film/frames/000003.json"));
    let output = after("-INT", child);
    assert_code(&output, 130);
    assert!(err(&output).contains(&format!("of {FRAMES} frames are kept")), "{}", err(&output));
    assert!(at.join("out/other.png").exists() && !at.join("out/film.png").exists());
    assert_tidy(at);
    assert_code(&end_of(start(at, &arguments)), 0);
    assert!(at.join("out/film.png").exists());
}

/// As `nohup` does.
#[cfg(target_os = "linux")]
#[test]
fn what_is_to_be_ignored_is_ignored() {
    let folder = folder_with(&film(8, FRAMES, ""));
    let script = "trap '' HUP INT; \"$IMMERSE\" simulate film.toml --out out -q & pid=$!
        while [ ! -e out/frames/000003.json ]; do sleep 0.01; done
        kill -HUP $pid; kill -INT $pid; wait $pid";
    let output = shell(folder.path(), script);
    assert_code(&output, 0);
    assert_eq!(err(&output), "");
}
