//! Moving pictures take as long as they should, and say so where their format cannot.

use std::{
    fs::{self, File},
    io::BufReader,
    path::Path,
};

use crate::support::program;
use tempfile::TempDir;

const FRAMES: f64 = 4.0;
const FILM: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[clock]\nframes = 4\nsteps_per_frame = 1\n\
                    [output]\nsize = [16, 12]\nsamples = 1\n";

/// What is said while a film of this rate is rendered, and what `check` says of it.
fn render(folder: &Path, rate: f64, animation: &str) -> [String; 2] {
    fs::write(folder.join("film.toml"), format!("{FILM}frame_rate = {rate:?}\nanimation = [{animation}]\n")).unwrap();
    let (code, _, err) = program(folder, &["run", "film.toml", "--out", "out"]);
    assert_eq!(code, 0, "{err}");
    [err, program(folder, &["check", "film.toml"]).1]
}

fn delays_of_gif(folder: &Path) -> Vec<f64> {
    let file = BufReader::new(File::open(folder.join("out/film.gif")).unwrap());
    let mut reader = gif::DecodeOptions::new().read_info(file).unwrap();
    let mut delays = Vec::new();
    while let Some(frame) = reader.read_next_frame().unwrap() {
        delays.push(f64::from(frame.delay) / 100.0);
    }
    delays
}

fn delay_of_apng(folder: &Path) -> f64 {
    let file = BufReader::new(File::open(folder.join("out/film.apng")).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    let control = reader.info().frame_control.unwrap();
    f64::from(control.delay_num) / f64::from(control.delay_den)
}

#[test]
fn a_gif_says_what_it_cannot_show() {
    let folder = TempDir::new().unwrap();
    for rate in [60.0, 50.5, 120.0] {
        for said in render(folder.path(), rate, "'gif', 'apng'") {
            let part = "film.gif shows 50 frames a second and takes 0.08 s, not ";
            assert!(said.contains(part) && said.contains("apng or mp4"), "{rate}: {said}");
        }
        assert_eq!(delays_of_gif(folder.path()), [0.02; 4]);
    }
    assert!(render(folder.path(), 0.001, "'gif'")[0].contains("film.gif shows 0.00153 frames a second"));
    assert!(!render(folder.path(), 60.0, "'apng'")[0].contains("gif shows"));
}

#[test]
fn delays_of_a_gif_add_up() {
    let folder = TempDir::new().unwrap();
    for rate in [50.0, 30.0, 23.976, 12.0, 1.0, 0.5] {
        let [said, check] = render(folder.path(), rate, "'gif'");
        assert!(said.is_empty() && !check.contains("gif"), "{rate}: {said}");
        let delays = delays_of_gif(folder.path());
        let total: f64 = delays.iter().sum();
        assert!((total - FRAMES / rate).abs() <= 0.005 + 1e-9, "{rate}: {delays:?}");
    }
}

#[test]
fn an_apng_shows_any_rate() {
    let folder = TempDir::new().unwrap();
    for rate in [1000.0, 60.0, 23.976, 1.0, 0.1, 0.001] {
        render(folder.path(), rate, "'apng'");
        let delay = delay_of_apng(folder.path());
        assert!((delay * rate - 1.0).abs() < 1e-4, "{rate}: {delay}");
    }
}
