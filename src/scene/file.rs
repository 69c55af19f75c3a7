//! From a path or a text to a scene.

use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};

use super::data::Scene;
use super::error::{SceneError, SceneErrors};
use super::keys::{Field, Problem, Problems, Table, declared};
use super::sections::root;
use super::source::Source;
use super::texts::{
    Link, Setting, Texts, as_text, chain, lay_over, move_paths, padding, read_text, take_extends, without,
};

/// Where what is set beside a file stands, in messages.
const COMMAND_LINE: &str = "command line";
/// What stands before it there.
const OPTION: &str = "--set ";

impl Scene {
    /// Reads a scene file. Its stem is the scene's name, its folder that of relative paths.
    ///
    /// # Errors
    /// [`SceneErrors`] if there is no such text, or with all the mistakes in it.
    pub fn read(path: &Path) -> Result<Scene, SceneErrors> {
        Scene::read_with(path, &[])
    }

    /// Reads a scene file and sets keys in it, each as `key=value`: a dotted key, and a value in TOML or a text without quotes.
    ///
    /// # Errors
    /// Those of [`Scene::read`], with the mistakes in what is set.
    pub fn read_with(path: &Path, settings: &[String]) -> Result<Scene, SceneErrors> {
        let text = read_text(path).map_err(|(reason, remedy)| SceneErrors::Unreadable {
            path: path.to_owned(),
            reason,
            remedy,
        })?;
        let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new(""));
        parse(text, name, folder, path.to_owned(), settings)
    }

    /// Reads a scene from a text. `name` names it in messages and output; relative paths in it start at `folder`.
    ///
    /// # Errors
    /// [`SceneErrors::Mistakes`] with every mistake: either those against TOML itself or, in valid TOML, all
    /// unknown keys, wrong types, impossible values and missing parameters.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Scene, SceneErrors> {
        // A text that was read by other means may have its mark still.
        let text = text.trim_start_matches('\u{feff}').to_owned();
        parse(text, name.to_owned(), folder, folder.join(format!("{name}.toml")), &[])
    }
}

fn parse(text: String, name: String, folder: &Path, path: PathBuf, settings: &[String]) -> Result<Scene, SceneErrors> {
    let links = chain(Link { path, text, folder: PathBuf::new() })?;
    let mut texts = Texts::default();
    // What is extended comes first.
    let mut padded = Vec::new();
    for (rank, link) in links.iter().rev().enumerate() {
        let start = texts.add(&link.path, &link.text, rank);
        texts.set_main(start);
        padded.push(padding(start) + &link.text);
    }
    let typed = settings;
    let settings: Vec<Setting> = typed
        .iter()
        .map(|text| {
            let start = texts.add(Path::new(COMMAND_LINE), &format!("{OPTION}{text}"), links.len());
            Setting::new(text, start + OPTION.len())
        })
        .collect();
    let mut tree = DeTable::new();
    for (text, link) in padded.iter().zip(links.iter().rev()) {
        let mut table = DeTable::parse_recoverable(text).0.into_inner();
        take_extends(&mut table);
        move_paths(&mut table, &link.folder);
        lay_over(&mut tree, table);
    }
    let (mut tree, wrong) = set(tree, &settings);
    let (mut scene, problems) = loop {
        let problems = Problems::of(texts.ranks());
        let mut table = Table::new("a scene".into(), Some(&tree), texts.nowhere(), &problems);
        let scene = root(&mut table);
        table.finish();
        drop(table);
        let replaced = problems.replaced();
        if replaced.is_empty() {
            break (scene, problems);
        }
        without(&mut tree, &replaced);
    };
    for Problem { span, reason, remedy } in wrong {
        problems.push(span, reason, || remedy);
    }
    let problems = problems.into_listed();
    if !problems.is_empty() {
        let mistake = |(p, more): (Problem, usize)| SceneError { more, ..texts.error(p.span, p.reason, p.remedy) };
        return Err(SceneErrors::Mistakes(problems.into_iter().map(mistake).collect()));
    }
    scene.name = name;
    scene.folder = folder.to_owned();
    scene.source = match links.as_slice() {
        [only] if settings.is_empty() => Source::new(texts, &only.text, &tree),
        _ => Source::new(texts, &as_text(&tree, &parts(&links, typed)), &tree),
    };
    Ok(scene)
}

/// What a scene was put together of, in words: files from the last to the first that is extended, then what was set.
fn parts(links: &[Link], settings: &[String]) -> Vec<String> {
    let name = |link: &Link| link.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    links.iter().rev().map(name).chain(settings.iter().map(|text| format!("{OPTION}{text}"))).collect()
}

/// Sets keys in a scene. Gives what is wrong with them.
fn set<'a>(tree: DeTable<'a>, settings: &'a [Setting]) -> (DeTable<'a>, Vec<Problem>) {
    if settings.is_empty() {
        return (tree, Vec::new());
    }
    let fields: Vec<Field> = declared(root);
    let mut earlier = Vec::new();
    let mut tree = DeValue::Table(tree);
    let wrong = settings.iter().filter_map(|setting| setting.apply(&mut tree, &fields, &mut earlier).err()).collect();
    match tree {
        DeValue::Table(tree) => (tree, wrong),
        _ => (DeTable::new(), wrong),
    }
}
