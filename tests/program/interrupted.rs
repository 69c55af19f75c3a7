//! A film of the relaxation on disk: interrupted at any place it goes on to the same bytes.

use crate::support::program;
use immerse::evolve::FrameReport;
use immerse::film::FilmFolder;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

const FRAMES: usize = 6;

/// Phases that end between frames, the first accelerated from its first step on: much to take up again.
fn scene(subdivisions: usize) -> String {
    let phase = |bending: f64, steps: usize| {
        format!("[[phase]]\nepsilon = [1, {bending}, 1, 0.1]\nfeedback = 0.5\ntolerance = 1e-6\nmax_steps = {steps}\n")
    };
    format!(
        "[mesh]\nshape = 'sphere'\nsubdivisions = {subdivisions}\n[start]\nrandom = 5\n{}{}{}\
         [clock]\nframes = {FRAMES}\nsteps_per_frame = 3\n[output]\nsize = [32, 24]\nsamples = 1\n",
        phase(0.1, 5),
        phase(0.01, 5),
        phase(0.001, 50)
    )
}

/// What is known of every frame, but for the time it took.
fn reports(folder: &Path) -> Vec<FrameReport> {
    let cache = FilmFolder::open(folder).expect("a film");
    let report = |frame| FrameReport { seconds: 0.0, ..cache.read_report(frame).expect("a report") };
    (1..=FRAMES).map(report).collect()
}

fn state(folder: &Path, frame: usize) -> Vec<u8> {
    fs::read(folder.join(format!("frames/{frame:06}.npz"))).unwrap_or_default()
}

fn states(folder: &Path) -> Vec<Vec<u8>> {
    let states: Vec<_> = (1..=FRAMES).map(|frame| state(folder, frame)).collect();
    assert!(states.iter().all(|bytes| !bytes.is_empty()), "a frame is missing");
    assert!(states.windows(2).all(|pair| pair[0] != pair[1]), "the film stands still");
    states
}

fn times(folder: &Path) -> Vec<SystemTime> {
    let time = |frame| fs::metadata(folder.join(format!("frames/{frame:06}.npz"))).and_then(|m| m.modified());
    (1..=FRAMES).map(|frame| time(frame).expect("a frame")).collect()
}

#[test]
fn frames_that_are_gone_come_back_as_they_were() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), scene(8)).expect("a scene");
    let (code, out, err) = program(at, &["run", "film.toml", "--out", "out"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("6 frames computed"), "{out}");
    let out_folder = at.join("out");
    let whole = states(&out_folder);
    let whole_reports = reports(&out_folder);
    assert_eq!(whole_reports.iter().map(|report| report.cursor.steps).collect::<Vec<_>>(), [0, 3, 6, 9, 12, 15]);
    assert_eq!(whole_reports[FRAMES - 1].cursor.phase, 2);
    assert!((1..=FRAMES).all(|frame| out_folder.join(format!("{frame:06}.png")).exists()));

    // Nothing to do.
    let before = times(&out_folder);
    let (code, out, _) = program(at, &["run", "film.toml", "--out", "out"]);
    assert!(code == 0 && out.contains("0 frames computed, 6 were there"), "{out}");
    assert_eq!(times(&out_folder), before);

    // The last frames are gone, with and without their reports.
    for (first, ending) in [(4, "npz"), (5, "json"), (1, "json")] {
        for frame in first..=FRAMES {
            fs::remove_file(out_folder.join(format!("frames/{frame:06}.{ending}"))).expect("a frame");
        }
        let (code, out, err) = program(at, &["simulate", "film.toml", "--out", "out"]);
        let kept = if first > 1 { format!(", {} were there", first - 1) } else { String::new() };
        assert_eq!(code, 0, "{err}");
        assert!(out.contains(&format!("{} frames computed{kept}", FRAMES + 1 - first)), "{out}");
        assert!(states(&out_folder) == whole, "other bytes after frame {first} and later were removed");
        assert_eq!(reports(&out_folder), whole_reports);
    }

    // A damaged frame, and nothing else.
    let path = out_folder.join("frames/000003.npz");
    let mut bytes = fs::read(&path).expect("a frame");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).expect("a frame");
    let (code, out, err) = program(at, &["simulate", "film.toml", "--out", "out"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("1 frames computed, 5 were there"), "{out}");
    assert!(states(&out_folder) == whole);

    // Another scene is another film.
    fs::write(at.join("other.toml"), scene(7)).expect("a scene");
    let (code, _, err) = program(at, &["simulate", "other.toml", "--out", "out"]);
    assert!(code == 2 && err.contains("nothing was overwritten"), "{err}");
    assert!(states(&out_folder) == whole);
    let (code, _, err) = program(at, &["simulate", "other.toml", "--out", "out", "--restart"]);
    assert_eq!(code, 0, "{err}");
    assert!(states(&out_folder) != whole);
}

/// Whether the program was killed, without a chance to tidy up, between its second and its last frame.
fn kill_after_second_frame(at: &Path) -> bool {
    let folder = at.join("killed");
    let _ = fs::remove_dir_all(&folder);
    let mut child = Command::new(env!("CARGO_BIN_EXE_immerse"))
        .current_dir(at)
        .args(["simulate", "film.toml", "--out", "killed"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    while !folder.join("frames/000002.json").exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    let killed = !child.wait().expect("ended").success();
    killed && !folder.join("frames/000006.json").exists()
}

#[test]
fn killed_in_the_middle() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), scene(24)).expect("a scene");
    assert_eq!(program(at, &["simulate", "film.toml", "--out", "whole"]).0, 0);
    // On a busy machine the program may be done before it is killed; then once more.
    assert!((0..5).any(|_| kill_after_second_frame(at)), "it was always done before it could be killed");

    let (code, out, err) = program(at, &["simulate", "film.toml", "--out", "killed"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("were there"), "{out}");
    assert!(states(&at.join("killed")) == states(&at.join("whole")));
    assert_eq!(reports(&at.join("killed")), reports(&at.join("whole")));
}
