//! The cookbook does what it says: every recipe that `immerse new` writes has a section, every section a recipe, and the
//! commands of the page are run in an empty folder, each on a coarser mesh, with fewer frames and smaller pictures than a reader's.

use super::numpy::{has_numpy, run_python};
use super::support::program;
use std::fs;
use std::path::Path;

/// What makes a recipe small enough for a test, and which files there must be in the end.
const RECIPES: [(&str, &[&str], &[&str]); 11] = [
    (
        "eversion",
        &["mesh.edge_length=0.08", "clock.frames=6", "clock.steps_per_frame=220"],
        &["renders/eversion/film.gif", "renders/eversion/sheet.png"],
    ),
    ("ricci", &["mesh.edge_length=0.14", "clock.frames=4"], &["renders/ricci/film.gif", "renders/ricci/sheet.png"]),
    ("numpy", &["phase=[{like = 'default', max_steps = 60}]"], &["lengths.npz", "renders/numpy/000001.png"]),
    ("formula", &["mesh.subdivisions=6", "clock.frames=6"], &["renders/formula/film.gif"]),
    ("growth", &["mesh.rings=8", "clock.frames=4"], &["renders/growth/film.gif"]),
    ("folding", &["clock.frames=4"], &["miura.fold", "renders/folding/film.gif"]),
    ("poses", &["mesh.edge_length=0.14", "clock.frames=3"], &["renders/poses/film.gif", "renders/again/000003.png"]),
    ("classes", &["clock.accuracy=0.02"], &["renders/classes/sheet.png"]),
    ("farm", &["mesh.columns=24", "mesh.rows=10", "clock.frames=4"], &["renders/farm/000004.png"]),
    (
        "programs",
        &["mesh.columns=24", "mesh.rows=10", "clock.frames=3"],
        &[
            "renders/programs/export/film.usda",
            "renders/programs/export/film.pvd",
            "renders/programs/export/film.000003.obj",
        ],
    ),
    ("print", &["mesh.columns=16", "mesh.rows=54"], &["renders/print/000001.png", "renders/print/000001.exr"]),
];

fn page() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/cookbook.md")).expect("the cookbook")
}

/// The sections of the page: the kind in their heading, and what stands below it.
fn sections(page: &str) -> Vec<(&str, &str)> {
    page.split("\n## ")
        .skip(1)
        .filter_map(|part| {
            let (heading, text) = part.split_once('\n')?;
            let kind = heading.split('`').nth(1)?;
            Some((kind, text))
        })
        .collect()
}

/// The blocks of a section in a language, in order.
fn blocks<'t>(section: &'t str, language: &str) -> Vec<&'t str> {
    let fence = format!("```{language}\n");
    section.split(fence.as_str()).skip(1).filter_map(|part| part.split("```").next()).collect()
}

#[test]
fn every_recipe_has_a_section_and_every_section_a_recipe() {
    let folder = tempfile::tempdir().expect("a folder");
    let (code, help, _) = program(folder.path(), &["new", "--help"]);
    assert_eq!(code, 0);
    let listed = help.lines().skip_while(|line| !line.starts_with("Recipes")).skip(1);
    let listed: Vec<&str> = listed.filter_map(|line| line.split_whitespace().next()).collect();
    let kinds = RECIPES.map(|(kind, ..)| kind);
    assert_eq!(listed, kinds, "{help}");
    let page = page();
    assert_eq!(sections(&page).iter().map(|(kind, _)| *kind).collect::<Vec<_>>(), kinds);
}

#[test]
fn a_recipe_is_written_by_its_kind_and_a_misspelt_one_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let new = |arguments: &[&str]| program(folder.path(), &[&["new"], arguments].concat());
    assert_eq!(new(&["ricci", "hare"]).0, 0);
    assert!(fs::read_to_string(folder.path().join("hare.toml")).expect("a file").starts_with("# Ricci flow"));
    // What a scene reads stands beside it, and nothing is replaced.
    assert_eq!(new(&["folding"]).0, 0);
    assert!(folder.path().join("miura.fold").exists());
    let (code, _, err) = new(&["folding", "another"]);
    assert_eq!(code, 2);
    assert!(err.contains("miura.fold: cannot be written"), "{err}");
    assert!(!folder.path().join("another.toml").exists());
    let (_, out, _) = new(&["numpy"]);
    assert!(out.contains("now: python3 lengths.py, then immerse run numpy.toml"), "{out}");
    // A name that is near a recipe's is a name all the same.
    let (code, out, _) = new(&["ricii"]);
    assert_eq!(code, 0);
    assert!(out.contains("did you mean `ricci`?"), "{out}");
    assert!(fs::read_to_string(folder.path().join("ricii.toml")).expect("a file").starts_with("# A scene of immerse"));
    let (code, out, _) = new(&["torus"]);
    assert!(code == 0 && !out.contains("recipe"), "{out}");
    let (code, _, err) = new(&["ricii", "bunny"]);
    assert_eq!(code, 2);
    assert!(err.contains("there is no recipe `ricii`; did you mean `ricci`?"), "{err}");
    assert!(!folder.path().join("bunny.toml").exists());
}

#[test]
fn commands_of_the_cookbook_do_what_it_says() {
    let page = page();
    let sections = sections(&page);
    for (kind, settings, files) in RECIPES {
        let (_, section) = sections.iter().find(|(there, _)| *there == kind).expect("a section");
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("mine.obj"), MINE).expect("a mesh");
        if kind == "numpy" && !has_numpy("the recipe of a metric from NumPy was not run") {
            continue;
        }
        for block in blocks(section, "toml") {
            let Some(name) = block.strip_prefix("# ").and_then(|block| block.split_once(".toml:")) else { continue };
            fs::write(folder.path().join(format!("{}.toml", name.0)), block).expect("a scene");
        }
        let commands: Vec<&str> = blocks(section, "sh").into_iter().flat_map(str::lines).collect();
        assert!(commands.first().is_some_and(|first| first.starts_with(&format!("immerse new {kind}"))), "{kind}");
        for command in commands {
            obey(folder.path(), command, settings);
        }
        for file in files {
            let written = fs::metadata(folder.path().join(file));
            assert!(written.is_ok_and(|written| written.len() > 100), "{kind}: {file} is not there");
        }
        assert_moving(folder.path(), kind);
    }
}

/// A tetrahedron with divided edges stands for the reader's mesh.
const MINE: &str = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

/// Does what a line of the page says, made small; all must be well in the end.
fn obey(folder: &Path, command: &str, settings: &[&str]) {
    let command = command.split(" #").next().unwrap_or_default().trim();
    let words: Vec<String> = command.split_whitespace().map(|word| word.replace(['\'', '"'], "")).collect();
    let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
    if words.first() == Some(&"python3") {
        let script = fs::read_to_string(folder.join(words[1])).expect("a script");
        run_python(folder, &script);
        return;
    }
    assert_eq!(words.remove(0), "immerse", "{command}");
    let verb = words[0];
    let of_a_recipe = !words.contains(&"again.toml") && !words.contains(&"--mesh");
    if matches!(verb, "run" | "simulate" | "render" | "check" | "sweep" | "farm") && of_a_recipe {
        // A sweep has settings of its own, of which one value is no combination.
        settings.iter().for_each(|setting| words.extend(["--set", setting]));
    }
    if verb == "sweep" {
        words.extend(["--set", "output.size=[80, 60]", "--set", "output.samples=1", "--set", "output.report=false"]);
    }
    if matches!(verb, "run" | "render") {
        while let Some(at) = words.iter().position(|word| matches!(*word, "--size" | "--samples")) {
            words.drain(at..at + 2);
        }
        words.extend(["--size", "80x60", "--samples", "1"]);
    }
    let (code, out, err) = program(folder, &words);
    if command.contains("mp4") && !cfg!(feature = "mp4") {
        assert_eq!(code, 2, "{command}: {err}");
        assert!(err.contains("--features mp4"), "{err}");
        return;
    }
    assert_eq!(code, 0, "{command}\n{out}\n{err}");
    assert!(!out.contains(" NO"), "{command}\n{out}");
}

/// Moving pictures have as many pictures as the film.
fn assert_moving(folder: &Path, kind: &str) {
    let Ok(gif) = fs::read(folder.join(format!("renders/{kind}/film.gif"))) else { return };
    let frames = fs::read_dir(folder.join(format!("renders/{kind}/frames"))).expect("frames");
    let ending = |path: &Path| path.extension().is_some_and(|ending| ending == "npz");
    let frames = frames.filter(|entry| ending(&entry.as_ref().expect("an entry").path())).count();
    // A graphic control extension, four bytes long, stands before each picture.
    let pictures = gif.windows(3).filter(|bytes| *bytes == [0x21, 0xF9, 0x04]).count();
    assert!(frames > 1 && pictures >= frames, "{kind}: {pictures} pictures of {frames} frames");
}
