//! `new`: the scene of a recipe of the cookbook, or one to start from.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::diagnostics::one_line;
use super::failure::Failure;
use crate::scene::{nearest, suggestion};
use crate::whole_file;

/// The scene of a name that is no recipe.
const STARTER: &str = include_str!("recipes/starter.toml");

/// A section of docs/cookbook.md, and the files that go with it.
struct Recipe {
    kind: &'static str,
    /// What it makes.
    about: &'static str,
    scene: &'static str,
    /// What the scene reads, or what writes it, by name.
    beside: &'static [(&'static str, &'static str)],
}

const fn recipe(kind: &'static str, about: &'static str, scene: &'static str) -> Recipe {
    Recipe { kind, about, scene, beside: &[] }
}

const RECIPES: [Recipe; 11] = [
    recipe("eversion", "turns a mesh inside out", include_str!("recipes/eversion.toml")),
    recipe("ricci", "Ricci flow of a scan, to gif and mp4", include_str!("recipes/ricci.toml")),
    Recipe {
        beside: &[("lengths.py", include_str!("recipes/lengths.py"))],
        ..recipe("numpy", "a metric from NumPy", include_str!("recipes/numpy.toml"))
    },
    recipe("formula", "a metric by formula", include_str!("recipes/formula.toml")),
    recipe("growth", "growth and wrinkles", include_str!("recipes/growth.toml")),
    Recipe {
        beside: &[("miura.fold", include_str!("recipes/miura.fold"))],
        ..recipe("folding", "paper folding, from a crease pattern", include_str!("recipes/folding.toml"))
    },
    recipe("poses", "from one pose to another", include_str!("recipes/poses.toml")),
    recipe("classes", "all classes on a poster", include_str!("recipes/classes.toml")),
    recipe("farm", "a film for a render farm", include_str!("recipes/farm.toml")),
    recipe("programs", "a film for Blender, Houdini and ParaView", include_str!("recipes/programs.toml")),
    recipe("print", "a still for print", include_str!("recipes/print.toml")),
];

/// The recipes, for the help.
pub(super) fn recipes() -> String {
    let lines = RECIPES.map(|recipe| format!("  {:<10}{}", recipe.kind, recipe.about));
    format!("Recipes, each a section of docs/cookbook.md:\n{}", lines.join("\n"))
}

/// Writes the scene of a recipe, or one to start from, and says how to go on. A file that is there stays.
pub(super) fn new(kind: &str, name: Option<&str>, out: &mut impl Write) -> Result<(), Failure> {
    let kinds = RECIPES.map(|recipe| recipe.kind);
    let recipe = RECIPES.iter().find(|recipe| recipe.kind == kind);
    if recipe.is_none() && name.is_some() {
        return Err(Failure::Recipe { kind: kind.to_owned(), remedy: suggestion("recipes", kind, &kinds) });
    }
    let scene = toml_of(name.unwrap_or(kind));
    let folder = scene.parent().unwrap_or(Path::new(""));
    let beside = recipe.map_or(&[][..], |recipe| recipe.beside);
    // First what the scene needs, so that a scene that is there can be run.
    for (name, text) in beside {
        write_new(&folder.join(name), text)?;
        writeln!(out, "{} is written", shown(&folder.join(name)))?;
    }
    write_new(&scene, recipe.map_or(STARTER, |recipe| recipe.scene))?;
    let scripts = beside.iter().filter(|(name, _)| name.ends_with(".py"));
    let before: String = scripts.map(|(name, _)| format!("python3 {}, then ", shown(&folder.join(name)))).collect();
    writeln!(out, "{} is written; now: {before}immerse run {}", shown(&scene), shown(&scene))?;
    match recipe {
        Some(recipe) => writeln!(out, "docs/cookbook.md says more of it, under `{}`", recipe.kind)?,
        None if nearest(kind.trim_end_matches(".toml"), kinds).is_some() => {
            let instead = suggestion("recipes", kind.trim_end_matches(".toml"), &kinds);
            writeln!(out, "`{}` is no recipe, so this is the scene to start from; {instead}", one_line(kind))?;
        }
        None => {}
    }
    Ok(())
}

fn toml_of(name: &str) -> PathBuf {
    PathBuf::from(if name.ends_with(".toml") { name.to_owned() } else { format!("{name}.toml") })
}

fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    let failed = |source| Failure::New { path: path.to_owned(), source };
    whole_file::write_new(path, text.as_bytes()).map_err(failed)
}

fn shown(path: &Path) -> String {
    one_line(&path.to_string_lossy()).into_owned()
}
