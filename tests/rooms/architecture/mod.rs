//! What the modules of the crate may use of each other, as `syn` reads it.

mod graph;
mod sources;

use graph::Crate;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn immerse() -> Crate {
    let found = Crate::read(&folder().join("src/lib.rs"));
    assert!(found.modules.len() > 50, "only {} modules were found", found.modules.len());
    found
}

/// The block of ARCHITECTURE.md that draws the rooms: a line for each, with the rooms that it imports.
fn drawn() -> Vec<(String, BTreeSet<String>)> {
    let text = fs::read_to_string(folder().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let block = text.split("```rooms\n").nth(1).and_then(|rest| rest.split("```").next());
    let row = |line: &str| {
        let mut words = line.split_whitespace().filter(|word| *word != "<-").map(str::to_owned);
        (words.next().unwrap_or_default(), words.collect())
    };
    block.expect("a block ```rooms in ARCHITECTURE.md").lines().map(row).collect()
}

/// As [`drawn`] wants it.
fn drawing(order: &[String], imports: &BTreeMap<String, BTreeSet<String>>) -> String {
    let width = order.iter().map(String::len).max().unwrap_or(0);
    let row = |room: &String| {
        let named: Vec<&str> = order.iter().filter(|other| imports[room].contains(*other)).map(|s| &**s).collect();
        format!("{room:width$} <- {}", named.join(" ")).trim_end_matches(" <- ").trim_end().to_owned() + "\n"
    };
    order.iter().map(row).collect()
}

#[test]
fn rooms_import_what_is_drawn_and_only_rooms_before_them() {
    let found = immerse();
    let order = &found.modules[0].declared;
    let imports = found.room_imports();
    for (k, room) in order.iter().enumerate() {
        for other in &imports[room] {
            assert!(order[..k].contains(other), "{room} imports {other}, which comes after it in src/lib.rs");
        }
    }
    let wanted: Vec<_> = order.iter().map(|room| (room.clone(), imports[room].clone())).collect();
    assert!(drawn() == wanted, "ARCHITECTURE.md is to draw the rooms as they are:\n\n{}", drawing(order, &imports));
}

#[test]
fn every_path_within_the_crate_is_followed_to_its_file() {
    let found = immerse();
    assert_eq!(found.lost(), []);
    assert!(found.file_edges().len() > 300, "only {} uses were found", found.file_edges().len());
}

#[test]
fn files_do_not_use_each_other_in_circles() {
    let circles = immerse().circles();
    let show = |(from, to): &(PathBuf, PathBuf)| format!("  {} uses {}\n", from.display(), to.display());
    let text: Vec<String> = circles.iter().map(|uses| uses.iter().map(show).collect()).collect();
    assert!(circles.is_empty(), "{} circles:\n{}", circles.len(), text.join("and\n"));
}

/// The reader sees uses through other names, in macros, in bodies and through what a module passes on; and no use in a
/// declaration, in a comment or in passing on.
#[test]
fn circles_are_found_through_whatever_name() {
    let circle_of = |a: &str, b: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
        fs::create_dir(folder.path().join("room")).expect("a folder");
        write("lib.rs", "pub mod room;\npub use room::A as Front;");
        write("room/mod.rs", "mod a;\nmod b;\npub use a::A;\npub(crate) use b::{B, work};");
        write("room/a.rs", a);
        write("room/b.rs", b);
        let found = Crate::read(&folder.path().join("lib.rs"));
        assert_eq!(found.lost(), []);
        !found.circles().is_empty()
    };
    let b = "pub struct B;\npub fn work() {}\nfn f(_: super::A) {}";
    for a in [
        "use super::B;\npub struct A;",
        "use crate::room::{self, A as _};\npub struct A;\nfn f() { room::work() }",
        "pub struct A(crate::room::B);",
        "pub struct A;\nfn f() { println!(\"{:?}\", (1, super::work())); }",
        "pub struct A;\nfn f() { use super::*; work(); }",
        "use super::b as other;\npub struct A;\nfn f() { other::work() }",
        "pub struct A;\nmod inside { fn f() { super::super::work() } }",
    ] {
        assert!(circle_of(a, b), "{a}");
    }
    assert!(circle_of("use super::B;\npub struct A;", "pub struct B;\npub fn work() -> crate::Front { todo!() }"));
    for a in
        ["/// [`super::B`]\npub struct A; // super::B", "pub struct A;\nfn f() { let work = 1; std::mem::drop(work); }"]
    {
        assert!(!circle_of(a, b), "{a}");
    }
    assert!(!circle_of("pub use super::B;\npub struct A;", "pub struct B;\npub fn work() {}\nuse super::A;"));
}

/// Positions are a source of lengths and nothing else before there are frames.
#[test]
fn spin_and_connectivity_see_no_points_of_space() {
    let found = immerse();
    let files = ["mesh/connectivity.rs", "mesh/repair.rs", "mesh/ids.rs"];
    for file in files {
        assert!(found.modules.iter().any(|module| module.file == Path::new(file)), "there is no {file}");
    }
    for (k, module) in found.modules.iter().enumerate() {
        if found.room(k) == Some("spin") || files.iter().any(|file| module.file == Path::new(file)) {
            let points = ["DVec3", "Vec3", "Vec3A", "DVec4", "Vec4"];
            let sees = module.triples || module.paths().flatten().any(|name| points.contains(&&**name));
            assert!(!sees, "{} sees points of space", module.file.display());
        }
    }
}

/// The disk is the business of the readers, of films, of pictures and of the command line.
#[test]
fn only_some_rooms_reach_the_disk() {
    let found = immerse();
    let mut reaching = BTreeSet::new();
    for (k, module) in found.modules.iter().enumerate() {
        let reaches = |path: &Vec<String>| match path.iter().map(|name| &**name).collect::<Vec<_>>()[..] {
            ["std", "fs", ..] | ["tempfile", _, ..] => true,
            ["std", "env", what, ..] => what != "consts",
            _ => false,
        };
        let asked = ["exists", "try_exists", "is_file", "is_dir", "read_dir", "canonicalize"];
        if module.paths().any(reaches) || module.methods.iter().any(|name| asked.contains(&&**name)) {
            let room = found.room(k).unwrap_or_default();
            let may = ["whole_file", "scene", "render", "film", "cli"].contains(&room)
                || ["mesh/read", "mesh/write"].iter().any(|folder| module.file.starts_with(folder));
            assert!(may, "{} reaches the disk", module.file.display());
            reaching.insert(module.file.clone());
        }
    }
    assert!(reaching.len() > 5, "only {reaching:?} reach the disk");
}

/// Pictures are made of what a frame says. Pictures of energies ask for the weights of phases, and for nothing else of
/// what makes frames.
#[test]
fn pictures_do_not_solve() {
    let found = immerse();
    assert!(found.modules.iter().any(|module| module.file == Path::new("immersion/poisson.rs")));
    let imports = found.room_imports();
    assert!(["render", "film"].iter().all(|room| !imports[*room].contains("frames")), "{imports:?}");
    for (from, to) in found.file_edges() {
        let of = |room: &str| from.starts_with(room);
        let solver = to == Path::new("immersion/poisson.rs")
            || to == Path::new("evolve/simulation.rs")
            || to.starts_with("evolve/relax") && to != Path::new("evolve/relax/phase.rs");
        assert!(!((of("render") || of("film")) && solver), "{} uses {}", from.display(), to.display());
    }
}

#[test]
fn files_are_short_and_finished() {
    let found = immerse();
    let files: BTreeSet<&Path> = found.modules.iter().map(|module| &*module.file).collect();
    for file in files {
        let text = fs::read_to_string(folder().join("src").join(file)).expect("a source");
        let lines = text.lines().count();
        assert!(lines <= 400, "{}: {lines} lines", file.display());
        for word in ["TODO", "FIXME", "XXX"] {
            assert!(!text.contains(word), "{}: contains {word:?}", file.display());
        }
    }
    for module in &found.modules {
        assert!(!module.tests_in_braces, "{}: tests go to `tests/` or to a file of their own", module.file.display());
    }
}
