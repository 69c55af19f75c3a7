//! What is said of a film before and while it is made: the forecast of `check`, and `--preview`.

use std::fs;
use std::path::Path;

use crate::support::program;
use tempfile::TempDir;

const SCENE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n[metric]\nformula = 'length * (1 + 0.3 * t * z)'\n\
                     [clock]\nframes = 3\n[output]\nsize = [96, 72]\nsamples = 1\nreport = false\n";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("film.toml"), SCENE).unwrap();
    folder
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn check_says_what_a_run_will_take() {
    let folder = folder();
    let check = |more: &[&str]| {
        let (code, out, err) = program(folder.path(), &[&["check", "film.toml"], more].concat());
        assert_eq!(code, 0, "{err}");
        let line = |start: &str| {
            out.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("{out}")).to_owned()
        };
        [line("time:"), line("memory:")]
    };
    let [time, memory] = check(&[]);
    assert!(time.contains("3 frames of 320 faces") && time.contains("3 pictures"), "{time}");
    assert!(memory.contains("disk"), "{memory}");
    // Nothing is written, and what is asked for counts.
    assert_eq!(files(folder.path()), ["film.toml"]);
    let [time, _] = check(&["--set", "clock.frames=1", "--set", "mesh.subdivisions=6"]);
    assert!(time.contains("1 frame of 720 faces") && time.contains("its picture"), "{time}");
    // A hundred times as many frames take a hundred times as much of the disk.
    let frames = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().rev().take(2).collect();
        words[1].parse::<f64>().unwrap() * if words[0] == "MB" { 1e6 } else { 1e3 }
    };
    let ([_, few], [_, many]) = (check(&[]), check(&["--set", "clock.frames=300"]));
    let ratio = frames(&many) / frames(&few);
    assert!((80.0..120.0).contains(&ratio), "{few} {many}");
}

#[test]
fn disk_is_as_was_said() {
    let folder = folder();
    let (_, out, _) = program(folder.path(), &["check", "film.toml", "--set", "mesh.subdivisions=12"]);
    let said = out.lines().find_map(|line| line.rsplit_once("of which frames ")).unwrap().1;
    let said: f64 = said.split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e3;
    assert_eq!(
        program(folder.path(), &["simulate", "film.toml", "--set", "mesh.subdivisions=12", "--out", "film"]).0,
        0
    );
    let frames = folder.path().join("film/frames");
    let bytes: u64 = files(&frames).iter().map(|name| fs::metadata(frames.join(name)).unwrap().len()).sum();
    assert!((bytes as f64 / said - 1.0).abs() < 0.2, "{said} was said, {bytes} there are");
}

#[test]
fn a_preview_shows_the_newest_frame_until_it_is_not_asked_for() {
    let folder = folder();
    let run = |arguments: &[&str]| {
        let (code, _, err) = program(folder.path(), &[arguments, &["film.toml", "--out", "film"]].concat());
        assert_eq!(code, 0, "{err}");
        fs::read(folder.path().join("film/preview.png")).ok()
    };
    let of_three = run(&["simulate", "--preview"]).unwrap();
    assert!(of_three.starts_with(b"\x89PNG"));
    // With nothing to do it is the same, and of a shorter film it is another one.
    assert!(run(&["run", "--preview"]).unwrap() == of_three);
    assert!(run(&["simulate", "--preview", "--set", "clock.frames=2"]).unwrap() != of_three);
    assert_eq!(run(&["simulate"]), None);
    // What others have called so stays.
    fs::write(folder.path().join("film/preview.png"), "mine").unwrap();
    assert_eq!(run(&["simulate"]).unwrap(), b"mine");
}
