//! Pictures are made while frames are still being computed: the same files, and one failure ends both.

use std::{
    fs,
    path::Path,
    process::{Command, Output},
    sync::mpsc,
    thread,
    time::Duration,
};

use crate::support::scene;
use immerse::film::{Arrivals, FilmError, make_pictures_of_arrivals};

/// A ball that swells to an ellipsoid, and is shown in so few pixels that its pictures cost little.
const FILM: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[start]\nfrom = 'mesh'\n\
                    [metric]\nformula = 'length * (1 + 0.2 * t * z^2)'\n\
                    [[phase]]\nmax_steps = 20\n[clock]\nframes = 6\n[output]\nsize = [64, 48]\nsamples = 4\n";
const FRAMED_FIRST: &str = "[camera]\nframed = 'first'\n";

fn immerse(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_immerse")).current_dir(folder).args(arguments).output().expect("it runs")
}

/// A folder with a scene.
fn folder_with(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("scene.toml"), text).expect("a scene");
    folder
}

fn picture(folder: &Path, frame: usize) -> Vec<u8> {
    fs::read(folder.join(format!("renders/scene/{frame:06}.png"))).expect("a picture")
}

#[test]
fn pictures_made_meanwhile_are_those_made_afterwards() {
    for camera in ["", FRAMED_FIRST] {
        let at_once = folder_with(&format!("{FILM}{camera}"));
        let one_by_one = folder_with(&format!("{FILM}{camera}"));
        for (folder, arguments) in [
            (&at_once, &["run", "scene.toml", "--threads", "3"][..]),
            (&one_by_one, &["simulate", "scene.toml", "--threads", "1"]),
            (&one_by_one, &["render", "scene.toml", "--threads", "1"]),
        ] {
            let output = immerse(folder.path(), arguments);
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
        for frame in 1..=6 {
            assert!(picture(at_once.path(), frame) == picture(one_by_one.path(), frame), "frame {frame} {camera}");
        }
    }
}

#[test]
fn a_camera_for_the_first_frame_does_not_wait_for_the_last_one() {
    let folder = folder_with(FILM);
    assert!(immerse(folder.path(), &["simulate", "scene.toml"]).status.success());
    let film = folder.path().join("renders/scene");
    for (text, is_made) in [(format!("{FILM}{FRAMED_FIRST}"), true), (FILM.to_owned(), false)] {
        let scene = scene(&text);
        let arrivals = Arrivals::default();
        arrivals.reach(2);
        let (tell, told) = mpsc::channel();
        thread::scope(|scope| {
            let pictures = scope.spawn(|| {
                let watch = &mut |event| tell.send(event).expect("somebody listens");
                make_pictures_of_arrivals(&scene, &film, &[1, 2], &arrivals, watch)
            });
            // All is told, or nothing after a while.
            let mut waited = 0;
            while !pictures.is_finished() && waited < 20 {
                waited += usize::from(told.recv_timeout(Duration::from_millis(50)).is_err());
            }
            assert_eq!(pictures.is_finished(), is_made, "{text}");
            arrivals.end();
            match pictures.join().expect("no panic") {
                Ok(pictured) => assert!(is_made && pictured.made == 2),
                Err(FilmError::NoSuchFrame { .. }) => assert!(!is_made, "more frames were to come"),
                Err(error) => panic!("{error}"),
            }
        });
    }
}

#[test]
fn a_picture_that_cannot_be_written_ends_the_simulation() {
    let folder = folder_with(&format!("{}{FRAMED_FIRST}", FILM.replace("frames = 6", "frames = 400")));
    // A folder stands where the picture should.
    fs::create_dir_all(folder.path().join("renders/scene/000001.png/full")).expect("a folder");
    let output = immerse(folder.path(), &["run", "scene.toml", "--quiet"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("000001.png") && !said.contains("stopped"), "{said}");
    let frames = fs::read_dir(folder.path().join("renders/scene/frames")).expect("a folder").count() / 2;
    assert!((1..400).contains(&frames), "{frames} frames");
    // What is complete is gone on with.
    let again = immerse(folder.path(), &["inspect", "renders/scene"]);
    assert!(again.status.success(), "{}", String::from_utf8_lossy(&again.stderr));
}

#[test]
fn a_frame_that_cannot_be_computed_ends_the_pictures_with_its_own_message() {
    // Beyond half of the film the lengths are no numbers.
    let text = FILM.replace("0.2 * t * z^2", "0 * sqrt(0.5 - t)");
    let folder = folder_with(&format!("{text}{FRAMED_FIRST}"));
    let output = immerse(folder.path(), &["run", "scene.toml", "--quiet"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("metric") && !said.contains("has not been computed"), "{said}");
}

#[test]
fn the_film_of_another_scene_is_not_shown() {
    let folder = folder_with(FILM);
    assert!(immerse(folder.path(), &["simulate", "scene.toml"]).status.success());
    fs::write(folder.path().join("other.toml"), FILM.replace("subdivisions = 3", "subdivisions = 2")).expect("a scene");
    let output = immerse(folder.path(), &["run", "other.toml", "--out", "renders/scene", "--quiet"]);
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!folder.path().join("renders/scene/000001.png").exists());
}
