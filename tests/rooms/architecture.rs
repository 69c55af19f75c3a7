//! The module order of the crate and the rules that every source file keeps, read off the sources.

use std::fs;
use std::path::{Path, PathBuf};

/// A module imports only modules before it.
const ORDER: [&str; 15] = [
    "advice",
    "text",
    "mesh",
    "scene",
    "algebra",
    "timeline",
    "metric",
    "spin",
    "frames",
    "immersion",
    "evolve",
    "cache",
    "render",
    "movie",
    "cli",
];

/// All Rust sources with their text, paths relative to `src`.
fn sources() -> Vec<(PathBuf, String)> {
    fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                collect(&path, found);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    collect(&root, &mut paths);
    paths.sort();
    assert!(paths.len() > 50, "only {} sources were found", paths.len());
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source");
        (path.strip_prefix(&root).expect("inside src").to_owned(), text)
    };
    paths.into_iter().map(read).collect()
}

/// The module that a file belongs to; `None` for lib.rs and main.rs.
fn module(path: &Path) -> Option<String> {
    let first = path.components().next()?.as_os_str().to_str()?;
    let name = first.strip_suffix(".rs").unwrap_or(first);
    (!["lib", "main"].contains(&name)).then(|| name.to_owned())
}

/// A text without its comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// Names of the modules that a text reaches through `crate::`, also in braces.
fn imports(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let text = code(text);
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + "crate::".len()..];
        let word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
        if let Some(group) = rest.strip_prefix('{') {
            // Only names at depth one are modules.
            let mut depth = 0;
            let mut item = String::new();
            for c in group.chars() {
                match c {
                    '}' if depth == 0 => break,
                    '{' => depth += 1,
                    '}' => depth -= 1,
                    ',' if depth == 0 => names.push(word(std::mem::take(&mut item).trim())),
                    _ if depth == 0 => item.push(c),
                    _ => {}
                }
            }
            names.push(word(item.trim()));
        } else {
            names.push(word(rest));
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

#[test]
fn modules_import_only_modules_above_them() {
    let rank = |name: &str| ORDER.iter().position(|module| *module == name);
    let mut seen = 0;
    for (path, text) in sources() {
        let Some(here) = module(&path) else { continue };
        let own = rank(&here).unwrap_or_else(|| panic!("{}: the module is not in the order", path.display()));
        for name in imports(&text) {
            let Some(other) = rank(&name) else { panic!("{}: `crate::{name}` is no module", path.display()) };
            assert!(other <= own, "{}: {here} imports {name}, which comes after it", path.display());
            assert!(
                here != "scene" || ["scene", "advice", "text", "mesh"].contains(&name.as_str()),
                "{}: scene imports {name}",
                path.display()
            );
            seen += 1;
        }
    }
    assert!(seen > 50, "only {seen} imports were found");
}

#[test]
fn modules_are_declared_in_their_order() {
    let (_, text) = sources().into_iter().find(|(path, _)| path == Path::new("lib.rs")).expect("lib.rs");
    let declared: Vec<&str> =
        text.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    assert_eq!(declared, ORDER);
}

/// Positions are a source of lengths and nothing else before there are frames; the disk is the business of the
/// readers, the cache, the pictures and the command line.
#[test]
fn stages_see_only_what_they_may() {
    for (path, text) in sources() {
        let text = code(&text);
        let path_text = path.to_string_lossy().replace('\\', "/");
        let in_module = |names: &[&str]| module(&path).is_some_and(|name| names.contains(&name.as_str()));
        if in_module(&["spin"]) || ["mesh/connectivity.rs", "mesh/repair.rs", "mesh/ids.rs"].contains(&&*path_text) {
            assert!(!text.contains("DVec3") && !text.contains("[f64; 3]"), "{path_text} sees points of space");
        }
        let reaches_disk = text.contains("std::fs") || text.contains("fs::read") || text.contains("File::");
        let may = in_module(&["scene", "cache", "render", "movie", "cli"])
            || path_text.starts_with("mesh/read/")
            || path_text.starts_with("mesh/write/");
        assert!(may || !reaches_disk, "{path_text} reaches the disk");
        // Pictures of energies ask for the weights of a scene's phases, and for nothing else of what makes frames.
        let solves =
            text.contains("Poisson") || text.contains("Simulation") || imports(&text).contains(&"frames".to_owned());
        assert!(!in_module(&["render", "movie"]) || !solves, "{path_text} solves");
    }
}

#[test]
fn files_are_short_and_libraries_neither_print_nor_panic_nor_exit() {
    for (path, text) in sources() {
        let lines = text.lines().count();
        assert!(lines <= 400, "{}: {lines} lines", path.display());
        if path.ends_with("tests.rs") {
            continue; // a module of tests may panic
        }
        for word in [
            "TODO",
            "FIXME",
            "XXX",
            "todo!",
            "unimplemented!",
            "dbg!",
            "println!",
            "eprintln!",
            "print!(",
            "eprint!(",
            ".unwrap()",
            ".expect(",
            "panic!(",
            "process::exit",
            "unsafe ",
            "#[cfg(test)]\nmod tests {",
        ] {
            // Words of comments count for the first three only; `compile_fail` examples and doc tests may unwrap.
            let looked_at = if ["TODO", "FIXME", "XXX"].contains(&word) { text.clone() } else { code(&text) };
            assert!(!looked_at.contains(word), "{}: contains {word:?}", path.display());
        }
    }
}

/// Functions of the C library differ from machine to machine in the last bits; geometry takes libm's.
#[test]
fn geometry_does_not_depend_on_the_c_library() {
    for (path, text) in sources() {
        if module(&path).is_some_and(|name| ["scene", "cli", "cache", "render"].contains(&name.as_str())) {
            continue;
        }
        let text = code(&text);
        for call in [
            ".sin(",
            ".cos(",
            ".tan(",
            ".exp(",
            ".ln(",
            ".powf(",
            ".acos(",
            ".asin(",
            ".atan(",
            ".atan2(",
            ".sin_cos(",
            ".hypot(",
            ".cbrt(",
        ] {
            assert!(!text.contains(call), "{}: contains {call:?}", path.display());
        }
    }
}
