//! Scenes with keys set beside them and scenes that extend others: their films are those of files that say the same.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::program;
use tempfile::TempDir;

const BASE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n\
                    [[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\npositions = ['1.2*x', 'y', 'z']\n\
                    [output]\nsize = [48, 36]\nsamples = 1\nreport = false\n";
const REST: &str = "[clock]\nframes = 4\n[camera]\nframed = 'first'\n";

fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        fs::create_dir_all(folder.path().join(name).parent().unwrap()).unwrap();
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

#[track_caller]
fn done(folder: &Path, arguments: &[&str]) -> (String, String) {
    let (code, out, err) = program(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    (out, err)
}

/// All files of a film but the text of its scene.
fn film(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if !path.ends_with(".immerse/scene.toml") {
                files.insert(path.strip_prefix(folder).unwrap().to_owned(), fs::read(&path).unwrap());
            }
        }
    }
    files
}

#[test]
fn what_is_set_makes_the_film_of_a_file_that_says_it() {
    let written = format!("{BASE}{REST}[start]\nrandom = 5\n[look]\nbackground = '#ff0000'\n");
    let plain = folder(&[("film.toml", &written)]);
    done(plain.path(), &["run", "film.toml", "--out", "out"]);
    let expected = film(&plain.path().join("out"));

    let extending = format!("extends = 'common/base.toml'\n{REST}");
    let other = folder(&[("film.toml", &extending), ("common/base.toml", BASE)]);
    let set = ["--out", "out", "--set", "start.random=5", "--set", "look.background=#ff0000"];
    // Begun with two frames and other values, and gone on with.
    let (_, err) = done(other.path(), &["simulate", "film.toml", "--out", "out", "--set", "clock.frames=2"]);
    assert_eq!(err, "");
    let (_, err) = done(other.path(), &[&["run", "film.toml"][..], &set].concat());
    assert!(err.contains("[start]") && err.contains("[clock]") && err.contains("changed since"), "{err}");
    assert_eq!(film(&other.path().join("out")).keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    assert_eq!(film(&other.path().join("out")), expected);

    // A frame that is lost is made again, the same.
    fs::remove_file(other.path().join("out/frames/000003.json")).unwrap();
    let (out, _) = done(other.path(), &[&["run", "film.toml"][..], &set].concat());
    assert!(out.contains("1 frames computed, 3 were there"), "{out}");
    assert_eq!(film(&other.path().join("out")), expected);

    // The scene that is kept makes the same film alone.
    let kept = fs::read_to_string(other.path().join("out/.immerse/scene.toml")).unwrap();
    assert!(!kept.contains("extends") && kept.contains("random = 5"), "{kept}");
    fs::write(plain.path().join("film.toml"), &kept).unwrap();
    let (out, err) = done(plain.path(), &["run", "film.toml", "--out", "out"]);
    assert!(out.contains("0 frames computed, 4 were there") && out.contains("0 pictures made"), "{out}");
    assert_eq!((err.as_str(), film(&plain.path().join("out"))), ("", expected));
}

#[test]
fn every_command_that_reads_a_scene_takes_it() {
    let folder = folder(&[("film.toml", BASE)]);
    let wrong = "--set=mesh.subdivisions=0";
    for command in ["run", "simulate", "render", "check", "gallery"] {
        let (code, out, err) = program(folder.path(), &[command, "film.toml", wrong]);
        assert_eq!((code, out.as_str()), (2, ""), "{command}: {err}");
        for part in ["command line:1:25", "`subdivisions` is 0", "--set mesh.subdivisions=0", "help: write for example"]
        {
            assert!(err.contains(part), "{command}: no `{part}` in\n{err}");
        }
        // The caret is under the value.
        let line = err.lines().position(|line| line.contains("--set mesh")).unwrap();
        let [typed, below] = [line, line + 1].map(|line| err.lines().nth(line).unwrap());
        assert_eq!(below.find('^'), typed.find("0 "), "{err}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    done(folder.path(), &["gallery", "film.toml", "--set", "mesh.subdivisions=2", "--work", "w", "--out", "g"]);
    let (out, _) = done(folder.path(), &["inspect", "w/film"]);
    assert!(out.contains("80 faces"), "{out}");
    // What a later stage finds is shown there, too.
    let (code, _, err) = program(folder.path(), &["check", "film.toml", "--set", "mesh.file=no.obj"]);
    assert!(code == 2 && err.contains("command line:1:17") && err.contains("no.obj: cannot be read"), "{err}");
}
