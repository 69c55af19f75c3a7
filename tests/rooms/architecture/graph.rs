//! Which file uses which, through whatever name: paths are followed to the file that defines what they mean.

use super::sources::{Module, Names, modules};
use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The modules of a crate.
pub struct Crate {
    pub modules: Vec<Module>,
}

/// What a path means.
#[derive(Clone, Copy)]
enum Meaning {
    Module(usize),
    /// Something defined in this module.
    Item(usize),
}

impl Meaning {
    fn module(self) -> usize {
        match self {
            Meaning::Module(module) | Meaning::Item(module) => module,
        }
    }
}

/// `pub use` of one another may run in circles of their own.
const DEEPEST: usize = 16;

impl Crate {
    pub fn read(root: &Path) -> Crate {
        Crate { modules: modules(root) }
    }

    /// The room of a module: the child of the root that it is in.
    pub fn room(&self, module: usize) -> Option<&str> {
        let file = &self.modules[module].file;
        let first = file.components().next()?.as_os_str().to_str()?;
        let name = first.strip_suffix(".rs").unwrap_or(first);
        self.modules[0].children.contains_key(name).then_some(name)
    }

    /// What a path means in a module, and the modules that it leads through; `None` for what other crates define.
    fn follow(&self, from: usize, path: &[String], depth: usize, trail: &mut Vec<usize>) -> Option<Meaning> {
        if depth > DEEPEST {
            return None;
        }
        let mut here = match path.first()?.as_str() {
            "crate" => Meaning::Module(0),
            "self" => Meaning::Module(from),
            "super" => Meaning::Module(self.modules[from].parent),
            name => self.look_up(from, name, path.len() == 1, depth, trail)?,
        };
        for (k, name) in path.iter().enumerate().skip(1) {
            trail.push(here.module());
            let Meaning::Module(module) = here else { break };
            here = match name.as_str() {
                "super" => Meaning::Module(self.modules[module].parent),
                name => self
                    .look_up(module, name, k + 1 == path.len(), depth, trail)
                    .or_else(|| self.modules[module].has_item_macros.then_some(Meaning::Item(module)))?,
            };
        }
        trail.push(here.module());
        Some(here)
    }

    /// A name in a module. Where a module and an item share it, the last name of a path is the item's.
    fn look_up(&self, module: usize, name: &str, last: bool, depth: usize, trail: &mut Vec<usize>) -> Option<Meaning> {
        let here = &self.modules[module];
        let child = here.children.get(name).map(|&child| Meaning::Module(child));
        let item = here.items.contains(name).then_some(Meaning::Item(module));
        let mut imported = || {
            let import = here.imports.iter().find(|import| import.name == name && import.path != [name])?;
            self.follow(module, &import.path, depth + 1, trail)
        };
        let found = if last { item.or_else(&mut imported).or(child) } else { child.or_else(&mut imported).or(item) };
        found.or_else(|| {
            here.stars.iter().find_map(|(star, _)| match self.follow(module, star, depth + 1, &mut Vec::new())? {
                Meaning::Module(inside) if inside != module => self.look_up(inside, name, last, depth + 1, trail),
                _ => None,
            })
        })
    }

    /// What a module uses itself: its code, and what it imports without passing it on.
    fn uses(&self, module: usize) -> impl Iterator<Item = &Names> {
        let here = &self.modules[module];
        here.mentions.iter().chain(here.imported().filter(|(_, passed_on)| !passed_on).map(|(path, _)| path))
    }

    /// Pairs of different files of which the first uses the second. What a file only declares or passes on, it does
    /// not use; what is passed on counts as of the file that defines it.
    pub fn file_edges(&self) -> BTreeSet<(&Path, &Path)> {
        let mut edges = BTreeSet::new();
        for module in 0..self.modules.len() {
            for path in self.uses(module) {
                if let Some(meaning) = self.follow(module, path, 0, &mut Vec::new()) {
                    edges.insert((&*self.modules[module].file, &*self.modules[meaning.module()].file));
                }
            }
        }
        edges.retain(|(from, to)| from != to);
        edges
    }

    /// Sets of files of which each uses, directly or not, each other.
    pub fn circles(&self) -> Vec<Circle> {
        let edges = self.file_edges();
        let graph: DiGraphMap<&Path, ()> = edges.iter().copied().collect();
        let mut circles: Vec<Circle> = tarjan_scc(&graph)
            .into_iter()
            .filter(|files| files.len() > 1)
            .map(|mut files| {
                files.sort();
                let inside = |(a, b): &&(&Path, &Path)| files.contains(a) && files.contains(b);
                edges.iter().filter(inside).map(|(a, b)| (a.to_path_buf(), b.to_path_buf())).collect()
            })
            .collect();
        circles.sort();
        circles
    }

    /// Rooms that each room imports, directly: those that its paths name, also to pass things on.
    pub fn room_imports(&self) -> BTreeMap<String, BTreeSet<String>> {
        let mut imports: BTreeMap<String, BTreeSet<String>> =
            self.modules[0].declared.iter().map(|room| (room.clone(), BTreeSet::new())).collect();
        for (module, here) in self.modules.iter().enumerate() {
            let Some(room) = self.room(module) else { continue };
            for path in here.paths() {
                let mut trail = Vec::new();
                let _ = self.follow(module, path, 0, &mut trail);
                // A name that is imported leads on from the room of its import, which has been counted.
                let named = trail.iter().find_map(|&module| self.room(module));
                imports.get_mut(room).expect("a room").extend(named.filter(|named| *named != room).map(str::to_owned));
            }
        }
        imports
    }

    /// Paths within the crate that could not be followed, with the files they are in.
    pub fn lost(&self) -> Vec<(PathBuf, String)> {
        let mut lost = Vec::new();
        for (module, here) in self.modules.iter().enumerate() {
            for path in here.paths() {
                let ours = ["crate", "super"].contains(&path[0].as_str());
                if ours && self.follow(module, path, 0, &mut Vec::new()).is_none() {
                    lost.push((here.file.clone(), path.join("::")));
                }
            }
        }
        lost
    }
}

/// The uses within a circle.
pub type Circle = Vec<(PathBuf, PathBuf)>;
