//! Paths of all kinds: nothing is written outside of the folder that is named, and what is said is one line.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use super::{err, files, film, folder_with, immerse, out};

/// Runs a scene of this name; `to` is what follows `--out`. Returns the exit code, what it says, and what is new below
/// the working folder.
fn run(at: &Path, scene: &OsStr, to: Option<&OsStr>) -> (Option<i32>, String, Vec<PathBuf>) {
    let before = files(at);
    let mut command = immerse(at, &["run", "-q"]);
    command.arg(scene);
    to.map(|folder| command.arg("--out").arg(folder));
    let output = command.output().expect("it runs");
    let said = err(&output);
    assert!(said.lines().count() <= 1 || said.contains("For more information, try '--help'"), "{said}");
    assert_eq!(out(&output).matches("pictures made").count(), usize::from(output.status.success()), "{}", out(&output));
    assert!(out(&output).lines().count() <= 4, "{}", out(&output));
    let after = files(at);
    let unchanged =
        |files: &BTreeMap<PathBuf, Vec<u8>>| before.iter().all(|(path, bytes)| files.get(path) == Some(bytes));
    assert!(unchanged(&after), "something else was changed");
    (output.status.code(), said, after.into_keys().filter(|path| !before.contains_key(path)).collect())
}

/// A working folder within another one, so that what leads out of it is seen.
fn inner() -> (tempfile::TempDir, PathBuf) {
    let folder = folder_with("");
    let at = folder.path().join("in");
    fs::create_dir(&at).expect("a folder");
    fs::write(at.join("film.toml"), film(2, 2, "")).expect("a scene");
    fs::create_dir(folder.path().join("elsewhere")).expect("a folder");
    (folder, at)
}

#[test]
fn folders_with_all_kinds_of_names() {
    let long = "x".repeat(300);
    let names: [(&[u8], bool); 9] = [
        (b"plain", true),
        (b"with a space", true),
        (b"a/../b", true),
        (b"../in/up", true),
        (b"new\nline", true),
        (b"\xff\xfe\x80", true),
        ("Möbius ∞".as_bytes(), true),
        (long.as_bytes(), false),
        (b"", false),
    ];
    for (name, is_fine) in names {
        let (_folder, at) = inner();
        let name = OsStr::from_bytes(name);
        let (code, said, new) = run(&at, OsStr::new("film.toml"), Some(name));
        if is_fine {
            assert_eq!(code, Some(0), "{name:?}: {said}");
            assert!(at.join(name).join("000002.png").exists(), "{name:?}");
            // All that is new is in the folder.
            let real = at.join(name).canonicalize().expect("a folder");
            for path in new {
                let path = at.join(path).canonicalize().expect("a file");
                assert!(path.starts_with(&real), "{name:?}: {}", path.display());
            }
        } else {
            assert!(matches!(code, Some(1 | 2)), "{name:?}: {said}");
            assert_eq!(new, Vec::<PathBuf>::new(), "{name:?}");
        }
    }
}

#[test]
fn scenes_with_all_kinds_of_names() {
    let names: [(&[u8], bool); 6] = [
        (b"with a space.toml", true),
        (b"new\nline.toml", true),
        (b"\xff\xfe.toml", true),
        // Their films would be in the folder of all films, and above it.
        (b"..toml", false),
        (b"...toml", false),
        (b"....toml", true),
    ];
    for (name, is_fine) in names {
        let (_folder, at) = inner();
        let name = OsStr::from_bytes(name);
        fs::rename(at.join("film.toml"), at.join(name)).expect("renamed");
        let (code, said, new) = run(&at, name, None);
        assert_eq!(code, Some(if is_fine { 0 } else { 2 }), "{name:?}: {said}");
        assert_eq!(new.is_empty(), !is_fine, "{name:?}");
        assert!(is_fine || said.contains("gives no folder of its own"), "{said}");
        for path in new {
            assert!(path.starts_with("renders") && path.components().count() > 2, "{name:?}: {}", path.display());
        }
    }
}

#[test]
fn links_are_replaced_and_not_followed() {
    let (folder, at) = inner();
    let elsewhere = folder.path().join("elsewhere");
    fs::create_dir(at.join("out")).expect("a folder");
    for name in ["000001.png", "manifest.json", ".lock", "curves.csv"] {
        fs::write(elsewhere.join(name), "mine").expect("a file");
        symlink(elsewhere.join(name), at.join("out").join(name)).expect("a link");
    }
    fs::write(elsewhere.join("manifest.json"), "mine").expect("a file");
    fs::remove_file(at.join("out/manifest.json")).expect("removed");
    let mut command = immerse(&at, &["run", "film.toml", "--out", "out", "-q"]);
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    for (path, bytes) in files(&elsewhere) {
        assert!(path.ends_with("curves.csv") || bytes == b"mine", "{} was written", path.display());
    }
    assert_eq!(fs::read_to_string(elsewhere.join("curves.csv")).expect("a file"), "mine");
    assert!(fs::symlink_metadata(at.join("out/000001.png")).expect("a picture").is_file());
}

#[test]
fn frames_that_are_elsewhere_are_refused() {
    let (folder, at) = inner();
    let elsewhere = folder.path().join("elsewhere");
    fs::write(elsewhere.join("000001.npz"), "mine").expect("a file");
    fs::create_dir(at.join("out")).expect("a folder");
    symlink(&elsewhere, at.join("out/frames")).expect("a link");
    for arguments in
        [&["run", "film.toml", "--out", "out"][..], &["simulate", "film.toml", "--out", "out", "--restart"]]
    {
        let output = immerse(&at, arguments).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "{}", err(&output));
        assert!(err(&output).contains("out/frames: this link leads out of the folder"), "{}", err(&output));
        assert_eq!(files(&elsewhere).len(), 1);
    }
    // The folder itself may be anywhere.
    symlink(&elsewhere, at.join("link")).expect("a link");
    let output = immerse(&at, &["run", "film.toml", "--out", "link", "-q"]).output().expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(elsewhere.join("000001.png").exists());
}
