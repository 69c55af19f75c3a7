//! The same files on any number of threads and on any processor.

use crate::contents::Contents;
use crate::{PROGRAM, Tally, film, has};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A shape of so many faces that sums are in pieces and factors in wide columns, a picture with all its
/// layers; few steps.
const LARGE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 21\n[start]\nfrom = 'spectral'\n\
    [[phase]]\nepsilon = [1, 1, 1, 1]\nmax_steps = 3\ntolerance = 1e-9\n\
    [[phase]]\nepsilon = [1, 0.1, 1, 0.1]\nfeedback = 0.5\nmax_steps = 3\ntolerance = 1e-9\n\
    [output]\nsize = [48, 36]\nsamples = 1\nformat = ['png', 'exr']\n";

/// Processors of qemu: 64 bits without more, and one with SSE4 but neither AVX2 nor FMA.
const PROCESSORS: [&str; 2] = ["Nehalem", "qemu64"];

fn contents(at: &Path, out: &str, program: &[&str], threads: usize) -> Contents {
    let mut command = Command::new(program[0]);
    let threads = threads.to_string();
    command.current_dir(at).args(&program[1..]);
    let output = command.args(["run", "film.toml", "--out", out, "--threads", &threads]).output().expect("it starts");
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", String::from_utf8_lossy(&output.stderr));
    Contents::of(&at.join(out))
}

fn compare(what: &str, scene: &str, others: &[(&str, Vec<&str>, usize)]) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), scene).expect("a scene");
    let native = contents(at, "native", &[PROGRAM], 2);
    assert!(native.count() > 3, "a film with pictures");
    let mut tally = Tally::default();
    for (name, program, threads) in others {
        tally.count(name, native.differences(&contents(at, name, program, *threads)));
    }
    tally.conclude(what);
}

#[test]
fn any_number_of_threads() {
    let threads = [("one", 1), ("two", 2), ("three", 3), ("four", 4), ("seven", 7)];
    let others = threads.map(|(name, threads)| (name, vec![PROGRAM], threads));
    compare("threads, 8 820 faces", LARGE, &others);
    compare("threads, a film", &film(4), &others);
}

#[test]
fn any_processor() {
    if !has("qemu-x86_64", &["--version"]) || !cfg!(target_arch = "x86_64") {
        return;
    }
    let others = PROCESSORS.map(|processor| (processor, vec!["qemu-x86_64", "-cpu", processor, PROGRAM], 2));
    compare("processors, a film", &film(2), &others);
    compare("processors, 8 820 faces", LARGE, &others[..1]);
}

#[test]
#[ignore = "long: hours"]
fn any_processor_long() {
    if !has("qemu-x86_64", &["--version"]) || !cfg!(target_arch = "x86_64") {
        return;
    }
    let others = PROCESSORS.map(|processor| (processor, vec!["qemu-x86_64", "-cpu", processor, PROGRAM], 2));
    for entry in fs::read_dir("scenes").expect("the scenes that ship").flatten() {
        let path = entry.path();
        let Ok(scene) = fs::read_to_string(&path) else { continue };
        let folder = fs::canonicalize("scenes").expect("a folder");
        // Files are named beside the scene; a small picture shows as much as a large one.
        let scene = scene.replace("\"data/", &format!("\"{}/data/", folder.display()));
        if path.extension().is_some_and(|ending| ending == "toml") && !scene.contains("bunny") {
            compare(&format!("processors, {}", path.display()), &scene, &others[..1]);
        }
    }
}
