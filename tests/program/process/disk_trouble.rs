//! Disks that are full, files that may not grow, folders that may not be written: no half file counts, the path is
//! named, and the same command later makes the same bytes.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;

use super::{
    as_nobody, assert_code, assert_same, assert_tidy, end_of, err, files, film, folder_with, is_root, shell, skip,
    start,
};

/// Makes the film in `whole`, and after trouble in `out` makes it there, too.
fn goes_on_to_the_same_bytes(at: &Path, output: &std::process::Output, names: &str) {
    assert_code(output, 1);
    assert!(err(output).contains(names), "no `{names}` in {}", err(output));
    let said = err(output);
    assert!(said.lines().filter(|line| line.starts_with("error: ")).count() == 1, "{said}");
    if at.join("out").exists() {
        assert_tidy(&at.join("out"));
    }
    assert_code(&end_of(start(at, &["run", "film.toml", "--out", "out", "-q"])), 0);
    assert_code(&end_of(start(at, &["run", "film.toml", "--out", "whole", "-q"])), 0);
    assert_same(&files(&at.join("out")), &files(&at.join("whole")));
}

const OUTPUT: &str = "format = ['png', 'exr']\nanimation = ['gif']\n";

/// A disk of so many kilobytes, on which the folder is while the program runs; then it is copied to another one.
#[test]
fn a_disk_that_is_full() {
    let folder = folder_with(&film(6, 6, OUTPUT));
    let at = folder.path();
    if !is_root() || !shell(at, "unshare -m true").status.success() {
        return skip("only root can mount a small disk");
    }
    for kilobytes in [8, 150, 400, 700] {
        let script = format!(
            "mkdir -p disk && mount -t tmpfs -o size={kilobytes}k none disk || exit 99
             \"$IMMERSE\" run film.toml --out disk/out -q; code=$?
             rm -rf out; [ -d disk/out ] && cp -a disk/out out; exit $code"
        );
        let output = shell(at, &format!("unshare -m bash -c '{script}'"));
        if output.status.code() == Some(99) {
            return skip("no small disk can be mounted here");
        }
        goes_on_to_the_same_bytes(at, &output, "disk/out");
        assert!(err(&output).contains("space"), "{kilobytes} kB: {}", err(&output));
    }
}

#[test]
fn files_that_may_not_grow() {
    // In units of 1024 bytes: not even the first frame, and no longer the animation.
    for limit in [1, 20] {
        let folder = folder_with(&film(6, 6, OUTPUT));
        let at = folder.path();
        let output = shell(at, &format!("ulimit -f {limit}; exec \"$IMMERSE\" run film.toml --out out -q"));
        goes_on_to_the_same_bytes(at, &output, "out");
        assert!(err(&output).contains("too large"), "{}", err(&output));
    }
}

#[test]
fn a_folder_that_may_not_be_written() {
    let folder = folder_with(&film(3, 3, ""));
    let at = folder.path();
    let Some(nobody) = as_nobody(at) else {
        return skip("nobody cannot run the program here");
    };
    for parts in ["out", "out/frames"] {
        assert!(
            shell(at, &format!("rm -rf out; mkdir -p out/frames; chmod 777 out out/frames; chmod 555 {parts}"))
                .status
                .success()
        );
        let output = shell(at, &format!("{nobody} \"$IMMERSE\" run film.toml --out out -q"));
        assert_code(&output, 1);
        assert!(err(&output).contains(parts) && err(&output).contains("ermission"), "{}", err(&output));
        assert_eq!(
            files(&at.join("out")).len(),
            if parts == "out" { 0 } else { 3 },
            "{:?}",
            files(&at.join("out")).keys()
        );
        assert!(shell(at, "chmod -R 777 out").status.success());
        goes_on_to_the_same_bytes(at, &output, "out");
    }
}

#[test]
fn a_folder_that_is_a_file() {
    let folder = folder_with(&film(2, 2, ""));
    let at = folder.path();
    fs::write(at.join("out"), "mine").expect("a file");
    for (out, part) in [("out", "it is a file, and a film is a folder"), ("out/deep", "out/deep: cannot be created")] {
        for command in ["run", "simulate"] {
            let output = end_of(start(at, &[command, "film.toml", "--out", out, "-q"]));
            assert!(matches!(output.status.code(), Some(1 | 2)), "{}", err(&output));
            assert!(err(&output).contains(part), "{}", err(&output));
            assert_eq!(fs::read_to_string(at.join("out")).expect("a file"), "mine");
        }
    }
    fs::remove_file(at.join("out")).expect("removed");
    // A file where the frames belong.
    fs::create_dir(at.join("out")).expect("a folder");
    fs::write(at.join("out/frames"), "mine").expect("a file");
    let output = end_of(start(at, &["run", "film.toml", "--out", "out", "-q"]));
    assert_code(&output, 1);
    assert!(err(&output).contains("out/frames: cannot be created"), "{}", err(&output));
    fs::remove_file(at.join("out/frames")).expect("removed");
    goes_on_to_the_same_bytes(at, &output, "out");
}
