//! Files of a finished film that are damaged are found, and made again with the same bytes.

use crate::contents::Contents;
use crate::random::Random;
use crate::{Tally, exported_film, finish};
use immerse::film::FilmFolder;
use std::fs;
use std::path::{Path, PathBuf};

/// Ways to damage a file.
const DAMAGES: [&str; 8] =
    ["a bit is flipped", "cut", "emptied", "zeros", "swapped", "gone", "longer", "another one is in its place"];

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    files
}

/// Damages a file; says whether it is another one then.
fn damage(path: &Path, other: &Path, how: usize, random: &mut Random) -> bool {
    let before = fs::read(path).expect("a file");
    let mut bytes = before.clone();
    let place = random.below(bytes.len());
    match how {
        0 => bytes[place] ^= 1 << random.below(8),
        1 => bytes.truncate(place),
        2 => bytes.clear(),
        3 => bytes.iter_mut().skip(place).take(64).for_each(|byte| *byte = 0),
        4 | 7 => bytes = fs::read(other).expect("a file"),
        5 => {
            fs::remove_file(path).expect("removed");
            return true;
        }
        _ => bytes.extend_from_slice(&before[..place]),
    }
    fs::write(path, &bytes).expect("written");
    if how == 4 {
        fs::write(other, &before).expect("written");
    }
    bytes != before
}

fn corrupt(tries: usize, frames: usize, seed: u64) {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), exported_film(frames)).expect("a scene");
    finish(at, "out");
    let out = at.join("out");
    let whole = Contents::of(&out);
    let names = files(&out);
    let mut random = Random(seed);
    let mut tally = Tally::default();
    while tally.tries < tries {
        let (path, how) = (&names[random.below(names.len())], random.below(DAMAGES.len()));
        let alike: Vec<&PathBuf> = names.iter().filter(|other| other.extension() == path.extension()).collect();
        if damage(path, alike[random.below(alike.len())], how, &mut random) {
            finish(at, "out");
            let name = format!("{} {}, try {} of seed {seed}", path.display(), DAMAGES[how], tally.tries);
            tally.count(&name, whole.differences(&Contents::of(&out)));
        }
    }
    tally.conclude("damaged files");
}

#[test]
fn damaged_files_are_made_again() {
    corrupt(500, 3, 1);
}

#[test]
#[ignore = "long: some minutes"]
fn damaged_files_are_made_again_long() {
    corrupt(5000, 12, 2);
}

/// Of the state of a frame, and of its report.
#[test]
#[ignore = "long: some minutes"]
fn every_bit_of_a_frame_is_watched_over_long() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), exported_film(3)).expect("a scene");
    finish(at, "out");
    let film = FilmFolder::open(&at.join("out")).expect("a film");
    let mut tally = Tally::default();
    for ending in ["npz", "json"] {
        let path = at.join(format!("out/frames/000002.{ending}"));
        let whole = fs::read(&path).expect("a file");
        for bit in 0..8 * whole.len() {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            fs::write(&path, bytes).expect("written");
            let lost = if film.read_frame(2).is_ok() { vec!["it was not seen".to_owned()] } else { Vec::new() };
            tally.count(&format!("bit {bit} of {ending}"), lost);
        }
        fs::write(&path, whole).expect("written");
    }
    assert!(film.read_frame(2).is_ok());
    tally.conclude("every bit of a frame");
}
