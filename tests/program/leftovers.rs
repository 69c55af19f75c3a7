//! After a run the folder of a film holds nothing of another film that this program made, and all that others put there.

use std::fs;
use std::path::Path;

use crate::support::program;
use tempfile::TempDir;

const FILM: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[clock]\nframes = FRAMES\nsteps_per_frame = 1\n\
                    [output]\nsize = [32, 24]\nsamples = 1\nformat = ['png', 'exr']\nanimation = ['gif', 'apng']\nsheet = 4\n";

fn write_scene(folder: &Path, frames: usize) {
    fs::write(folder.join("film.toml"), FILM.replace("FRAMES", &frames.to_string())).unwrap();
}

/// What the program says on standard error.
fn run(folder: &Path, arguments: &[&str]) -> String {
    let (code, _, err) = program(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {err}");
    err
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| entry.file_name().into_string().unwrap())
        .filter(|name| name != "manifest.json" && name != "mesh.npz")
        .collect();
    names.sort();
    names
}

fn pictures(frames: usize) -> Vec<String> {
    let mut names: Vec<String> = (1..=frames).flat_map(|k| [format!("{k:06}.exr"), format!("{k:06}.png")]).collect();
    if frames > 1 {
        names.extend(["curves.csv", "curves.svg"].map(str::to_owned));
    }
    names.extend(["film.apng", "film.gif", "report.html", "sheet.png"].map(str::to_owned));
    names
}

/// A folder in which a film of five frames was made.
fn film_of_five() -> TempDir {
    let folder = TempDir::new().unwrap();
    write_scene(folder.path(), 5);
    assert_eq!(run(folder.path(), &["run", "film.toml", "--out", "out"]), "");
    assert_eq!(files(&folder.path().join("out")), pictures(5));
    folder
}

#[test]
fn pictures_of_a_longer_film_go() {
    for frames in [3, 1] {
        let folder = film_of_five();
        let out = folder.path().join("out");
        write_scene(folder.path(), frames);
        let err = run(folder.path(), &["simulate", "film.toml", "--out", "out", "--restart"]);
        assert!(err.contains("removed what is not of this film") && err.contains("000001.png"), "{err}");
        let left = files(&out);
        assert_eq!(left, if frames > 1 { vec!["curves.csv", "curves.svg"] } else { vec![] }, "{err}");
        run(folder.path(), &["run", "film.toml", "--out", "out"]);
        assert_eq!(files(&out), pictures(frames));
    }
}

/// As when somebody removes the manifest to begin anew.
#[test]
fn pictures_of_another_film_go_when_it_is_run_in_their_place() {
    let folder = film_of_five();
    let out = folder.path().join("out");
    // Frames of the longer film stay until then.
    fs::remove_file(out.join("manifest.json")).unwrap();
    write_scene(folder.path(), 2);
    let err = run(folder.path(), &["run", "film.toml", "--out", "out", "--format", "png"]);
    let kept = ["000001.exr", "000001.png", "000002.exr", "000002.png"];
    assert_eq!(files(&out), [&kept[..], &["curves.csv", "curves.svg", "report.html", "sheet.png"]].concat(), "{err}");
    assert_eq!(fs::read_dir(out.join("frames")).unwrap().count(), 4, "two files a frame");
    assert_eq!(err.lines().count(), 2, "{err}");
}

#[test]
fn other_pictures_of_the_same_film_stay_and_those_in_other_formats_are_named() {
    let folder = film_of_five();
    let out = folder.path().join("out");
    assert_eq!(run(folder.path(), &["render", "film.toml", "--out", "out", "--frames", "1-3"]), "");
    assert_eq!(files(&out), pictures(5), "pictures 4 and 5 are of this film");
    let err = run(folder.path(), &["render", "film.toml", "--out", "out", "--format", "png", "--sheet", "0"]);
    assert_eq!(files(&out), pictures(5));
    assert!(err.contains("left from an earlier run") && err.lines().count() == 1, "{err}");
    for name in ["000001.exr", "000005.exr", "film.gif", "film.apng"] {
        assert!(err.contains(name), "{name}: {err}");
    }
    // Going on with the same film is no reason for anything to go.
    assert_eq!(run(folder.path(), &["run", "film.toml", "--out", "out"]), "");
    assert_eq!(files(&out), pictures(5));
}

#[test]
fn what_others_put_there_stays() {
    let folder = film_of_five();
    let out = folder.path().join("out");
    let others = ["000007.png", "000099.exr", "0000005.png", "000004.jpg", "film.webm", "notes.txt", "000005.png.bak"];
    others.iter().for_each(|name| fs::write(out.join(name), b"made by hand").unwrap());
    fs::create_dir(out.join("000006.png")).unwrap();
    // Somebody's own moving picture and table in place of ours.
    fs::write(out.join("film.gif"), b"GIF89a by hand").unwrap();
    fs::write(out.join("curves.csv"), "x,y\n1,2\n").unwrap();
    write_scene(folder.path(), 1);
    run(folder.path(), &["simulate", "film.toml", "--out", "out", "--restart"]);
    for name in others.iter().chain(&["film.gif", "curves.csv", "000006.png"]) {
        assert!(out.join(name).exists(), "{name} stays");
    }
    assert!(!out.join("000005.png").exists() && !out.join("film.apng").exists());
}
