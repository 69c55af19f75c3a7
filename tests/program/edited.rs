//! A film whose scene is edited: what has not changed is kept, what has is made anew, and the folder ends as if the film had
//! been made in one go.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::SystemTime;

use crate::support::program;
use tempfile::TempDir;

const SCENE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n\
                     [[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\npositions = ['1.2*x', 'y', 'z']\n\
                     [[metric.key]]\ntime = 2\npositions = ['1.5*x', 'y', 'z']\n\
                     [clock]\nframes = 5\nend = 2\n[camera]\nframed = 'first'\n\
                     [output]\nsize = [48, 36]\nsamples = 1\nformat = ['png', 'exr']\nanimation = ['gif', 'apng']\nsheet = 3\n\
                     export = ['usd', 'obj', 'gltf']\n";

struct Film(TempDir);

impl Film {
    /// A film of this scene that is made.
    fn of(scene: &str) -> Film {
        let film = Film(TempDir::new().unwrap());
        film.write(scene);
        film.run(&["run"]);
        film
    }

    fn write(&self, scene: &str) {
        fs::write(self.0.path().join("film.toml"), scene).unwrap();
    }

    /// What the program says on standard output and standard error.
    fn run(&self, command: &[&str]) -> (String, String) {
        let (code, out, err) = program(self.0.path(), &[command, &["film.toml", "--out", "out"]].concat());
        assert_eq!(code, 0, "{err}");
        (out, err)
    }

    fn refused(&self, command: &[&str]) -> String {
        let (code, _, err) = program(self.0.path(), &[command, &["film.toml", "--out", "out"]].concat());
        assert_eq!(code, 2, "{err}");
        err
    }

    fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        collect(&self.0.path().join("out"), &mut |path| {
            files.insert(self.name(path), fs::read(path).unwrap());
        });
        files
    }

    fn times(&self) -> BTreeMap<String, SystemTime> {
        let mut times = BTreeMap::new();
        collect(&self.0.path().join("out"), &mut |path| {
            times.insert(self.name(path), fs::metadata(path).unwrap().modified().unwrap());
        });
        times
    }

    fn name(&self, path: &Path) -> String {
        path.strip_prefix(self.0.path().join("out")).unwrap().to_string_lossy().into_owned()
    }

    /// Asserts that the folder is that of a film of its scene that was made in one go.
    fn is_as_in_one_go(&self) {
        let scene = fs::read_to_string(self.0.path().join("film.toml")).unwrap();
        let (whole, files) = (Film::of(&scene).files(), self.files());
        assert_eq!(files.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
        let differing: Vec<&String> = whole.keys().filter(|name| whole[*name] != files[*name]).collect();
        assert!(differing.is_empty(), "{differing:?}");
    }
}

fn collect(folder: &Path, each: &mut dyn FnMut(&Path)) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { collect(&path, each) } else { each(&path) }
    }
}

#[test]
fn frames_before_an_edited_keyframe_are_kept() {
    let film = Film::of(SCENE);
    let before = film.times();
    film.write(&SCENE.replace("1.5*x", "1.6*x"));
    let (out, err) = film.run(&["run"]);
    assert!(out.contains("2 frames computed, 3 were there"), "{out}");
    assert!(err.contains("[metric] changed since; frames 1-3 kept, frames 4-5 to be computed"), "{err}");
    let after = film.times();
    for frame in 1..=3 {
        for name in [format!("frames/{frame:06}.npz"), format!("frames/{frame:06}.json"), format!("{frame:06}.png")] {
            assert_eq!(before[&name], after[&name], "{name} was made again");
        }
    }
    film.is_as_in_one_go();
    // And back again.
    film.write(SCENE);
    assert!(film.run(&["run"]).0.contains("2 frames computed, 3 were there"));
    film.is_as_in_one_go();
}

#[test]
fn frames_are_appended_and_left_out() {
    let film = Film::of(SCENE);
    film.write(&SCENE.replace("frames = 5\nend = 2", "frames = 7\nend = 3"));
    let (out, err) = film.run(&["run"]);
    assert!(out.contains("2 frames computed, 5 were there") && err.contains("[clock] changed since"), "{out}{err}");
    film.is_as_in_one_go();
    film.write(&SCENE.replace("frames = 5\nend = 2", "frames = 3\nend = 1"));
    let (out, err) = film.run(&["run"]);
    assert!(out.contains("0 frames computed, 3 were there"), "{out}");
    assert!(err.contains("removed what is not of this film"), "{err}");
    film.is_as_in_one_go();
}

/// A film of the relaxation, in which time is but a label.
#[test]
fn a_relaxation_is_appended() {
    let scene = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[start]\nrandom = 5\n[clock]\nframes = 4\nsteps_per_frame = 3\n\
                 [[look.text]]\ntext = '{time}'\n[output]\nsize = [48, 36]\nsamples = 1\n";
    let film = Film::of(scene);
    film.write(&scene.replace("frames = 4", "frames = 6"));
    let (out, _) = film.run(&["run"]);
    assert!(out.contains("2 frames computed, 4 were there"), "{out}");
    film.is_as_in_one_go();
}

#[test]
fn what_all_frames_depend_on_makes_all_anew() {
    for (section, edit) in [
        ("[mesh]", ("subdivisions = 3", "subdivisions = 2")),
        ("[clock]", ("end = 2", "end = 2\ntolerance = 0.01")),
        ("[phase]", ("[clock]", "[[phase]]\nindex = 4\ndt = 12\n[clock]")),
        ("[start]", ("[clock]", "[start]\nrandom = 3\n[clock]")),
    ] {
        let film = Film::of(SCENE);
        film.write(&SCENE.replace(edit.0, edit.1));
        let (out, err) = film.run(&["run"]);
        assert!(out.contains("5 frames computed\n"), "{section}: {out}");
        assert!(err.contains(&format!("{section} changed since; no frames kept")), "{err}");
        film.is_as_in_one_go();
    }
}

#[test]
fn what_decides_no_frame_keeps_all() {
    let film = Film::of(SCENE);
    let frames = |film: &Film| -> BTreeMap<String, SystemTime> {
        film.times().into_iter().filter(|(name, _)| name.starts_with("frames")).collect()
    };
    let before = frames(&film);
    film.write(&format!("# a comment\n{}[look]\npreset = 'soap'\n[checks]\nmax_rims = 0\n", SCENE));
    let (out, err) = film.run(&["run"]);
    assert!(out.contains("0 frames computed, 5 were there") && out.contains("5 pictures made\n"), "{out}");
    assert_eq!((err, frames(&film)), (String::new(), before));
    film.is_as_in_one_go();
}

#[test]
fn pictures_are_made_when_they_are_missing_or_stale_and_not_else() {
    let film = Film::of(SCENE);
    let (files, times) = (film.files(), film.times());
    let (out, _) = film.run(&["run"]);
    assert!(out.contains("0 pictures made, 5 were there"), "{out}");
    assert_eq!(film.times(), times, "a finished film is touched");
    let at = |name: &str| film.0.path().join("out").join(name);
    type Damage<'a> = (&'a str, &'a dyn Fn(&Path));
    let damages: [Damage; 6] = [
        ("000002.png", &|path| fs::remove_file(path).unwrap()),
        ("000003.exr", &|path| fs::write(path, &fs::read(path).unwrap()[..500]).unwrap()),
        ("000004.png", &|path| {
            let mut bytes = fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle] ^= 4;
            fs::write(path, bytes).unwrap();
        }),
        ("film.gif", &|path| fs::remove_file(path).unwrap()),
        ("sheet.png", &|path| fs::write(path, "").unwrap()),
        (".immerse/pictures.jsonl", &|path| {
            let text = fs::read_to_string(path).unwrap();
            fs::write(path, &text[..text.len() - 20]).unwrap();
        }),
    ];
    for (name, damage) in damages {
        let before = film.times();
        damage(&at(name));
        film.run(&["render"]);
        assert!(film.files() == files, "{name} did not come back");
        let touched: Vec<String> =
            film.times().into_iter().filter(|(n, time)| before.get(n) != Some(time)).map(|(n, _)| n).collect();
        let allowed = [name, ".immerse/pictures.jsonl", "sheet.png"];
        assert!(touched.iter().all(|name| allowed.contains(&name.as_str())), "{name}: {touched:?}");
    }
}

#[test]
fn a_line_of_the_ledger_that_is_not_as_it_was_written_counts_for_nothing() {
    let film = Film::of(SCENE);
    let files = film.files();
    let ledger = ".immerse/pictures.jsonl";
    let text = String::from_utf8(files[ledger].clone()).unwrap();
    let line = text.lines().find(|line| line.contains("000002.png")).expect("a line of the second picture");
    for field in ["\"file\":\"", "\"key\":\"", "\"shows\":\"", "\"sha256\":\"", "\"crc32\":\""] {
        let place = line.find(field).expect(field) + field.len() + 5;
        // Another digit, and in the name of the file another frame.
        let mut bytes = line.as_bytes().to_vec();
        bytes[place] ^= 1;
        let flipped = String::from_utf8(bytes).unwrap();
        fs::write(film.0.path().join("out").join(ledger), text.replace(line, &flipped)).unwrap();
        film.run(&["run"]);
        assert!(film.files() == files, "{field} flipped");
    }
}

#[test]
fn a_damaged_frame_is_made_again_and_no_other() {
    let film = Film::of(SCENE);
    let files = film.files();
    for name in ["frames/000002.npz", "frames/000003.json", "frames/000001.npz", "manifest.json", "mesh.npz"] {
        let path = film.0.path().join("out").join(name);
        let mut bytes = files[name].clone();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(path, bytes).unwrap();
        let (out, err) = film.run(&["run"]);
        let made = usize::from(name.starts_with("frames"));
        assert!(out.contains(&format!("{made} frames computed, {} were there", 5 - made)), "{name}: {out}{err}");
        assert!(film.files() == files, "{name} did not come back");
    }
}

#[test]
fn pictures_are_refused_of_a_film_that_is_not_of_the_scene() {
    let film = Film::of(SCENE);
    let before = film.files();
    fs::write(film.0.path().join("other.toml"), "[mesh]\nshape = 'torus'\n").unwrap();
    let (code, _, err) = program(film.0.path(), &["render", "other.toml", "--out", "out"]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("holds the film of the scene `film`"), "{err}");
    assert!(film.files() == before);
    film.write(&SCENE.replace("1.5*x", "1.6*x"));
    let err = film.refused(&["render"]);
    assert!(err.contains("000004.json: this frame is of the film as it was before the scene changed"), "{err}");
    // What has not changed can be drawn.
    film.run(&["render", "--frames", "1-2"]);
}

#[test]
fn a_restart_makes_all_anew() {
    let film = Film::of(SCENE);
    let (files, before) = (film.files(), film.times());
    assert!(film.run(&["simulate", "--restart"]).0.contains("5 frames computed\n"));
    film.run(&["run"]);
    assert!(film.files() == files);
    let kept: Vec<String> =
        film.times().into_iter().filter(|(n, time)| before.get(n) == Some(time)).map(|(n, _)| n).collect();
    // Exports are made anew by `run --restart` and `export --restart`; the frames that they show are the same.
    let (exports, kept): (Vec<String>, Vec<String>) = kept.into_iter().partition(|name| name.starts_with("export/"));
    assert_eq!(exports.len(), 8, "{exports:?}");
    assert_eq!(kept, [".immerse/scene.toml", "curves.csv", "curves.svg", "mesh.npz"], "which have the same bytes");
    let (said, _) = film.run(&["run", "--restart"]);
    assert!(said.contains("5 frames computed\n") && said.contains("5 pictures made\n"), "{said}");
    assert!(film.files() == files);
    let untouched =
        film.times().into_iter().filter(|(n, time)| n.starts_with("export/film") && before.get(n) == Some(time));
    assert_eq!(untouched.count(), 0);
}

#[test]
fn the_mesh_of_an_earlier_build_is_written_anew_and_frames_stay() {
    let film = Film::of(SCENE);
    let path = film.0.path().join("out/mesh.npz");
    let new = fs::read(&path).unwrap();
    // Without its edges, and with the checksums that it had then.
    let mut from = zip::ZipArchive::new(std::io::Cursor::new(&new)).unwrap();
    let mut to = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for k in 0..from.len() {
        let array = from.by_index(k).unwrap();
        if array.name().unwrap() != "edges.npy" {
            to.raw_copy_file(array).unwrap();
        }
    }
    let old = to.finish().unwrap().into_inner();
    assert!(old.len() < new.len());
    let manifest = film.0.path().join("out/manifest.json");
    let text = fs::read_to_string(&manifest).unwrap();
    let [was, is] = [&new, &old].map(|bytes| immerse::digest::Key::of_bytes(bytes).to_string());
    let text = text.replace(&was, &is);
    const PREFIX: &str = "{\n  \"crc32\": \"";
    let body = &text[PREFIX.len() + 10..];
    fs::write(&manifest, format!("{PREFIX}{:08x}\",{body}", crc32fast::hash(body.as_bytes()))).unwrap();
    fs::write(&path, &old).unwrap();
    // What is there is read as it is.
    let folder = immerse::film::FilmFolder::open(&film.0.path().join("out")).unwrap();
    assert_eq!(folder.valid_frames().unwrap(), [true; 5]);
    assert!(folder.mesh().is_ok());
    let before = film.times();
    film.run(&["run"]);
    let after = film.times();
    for frame in 1..=5 {
        for name in [format!("frames/{frame:06}.npz"), format!("frames/{frame:06}.json")] {
            assert_eq!(before[&name], after[&name], "{name} was written again");
        }
    }
    assert_eq!(fs::read(&path).unwrap(), new);
    film.is_as_in_one_go();
}
