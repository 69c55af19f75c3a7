//! A scene file and the files that it extends.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::DeTable;

use super::merge::extends;
use super::read::{MOST_BYTES, read_text};
use super::syntax::syntax_errors;
use super::text::Texts;
use crate::scene::error::{SceneError, SceneErrors};

/// One of the files.
pub(in crate::scene) struct Link {
    pub path: PathBuf,
    pub text: String,
    /// Its folder, seen from that of the scene.
    pub folder: PathBuf,
}

/// Files that extend one another. More are no help to anybody.
const LONGEST: usize = 32;

/// The file, the one that it extends, the one that this extends, and so on.
pub(in crate::scene) fn chain(first: Link) -> Result<Vec<Link>, SceneErrors> {
    let mut before: Vec<Link> = Vec::new();
    let mut link = first;
    loop {
        let next = extended(&link, &before)?;
        before.push(link);
        link = match next {
            Some(next) => next,
            None => return Ok(before),
        };
    }
}

/// The file that a file extends, if it does.
fn extended(link: &Link, before: &[Link]) -> Result<Option<Link>, SceneErrors> {
    let (tree, errors) = DeTable::parse_recoverable(&link.text);
    if !errors.is_empty() {
        return Err(syntax_errors(&link.path, &link.text, &errors));
    }
    let Some((name, span)) = extends(tree.get_ref()) else { return Ok(None) };
    let path = link.path.parent().unwrap_or(Path::new("")).join(name);
    if let Some(first) = before.iter().chain([link]).position(|other| is_same(&other.path, &path)) {
        let circle: Vec<&Path> = before.iter().chain([link]).skip(first).map(|link| &*link.path).collect();
        return Err(at(link, span, in_a_circle(&circle), "extend a file that does not extend this one".into()));
    }
    if before.len() + 1 >= LONGEST {
        let reason = format!("`extends` goes on through more than {LONGEST} files");
        return Err(at(link, span, reason, "put some of them together".into()));
    }
    let text = read_text(&path).map_err(|(reason, remedy)| {
        at(link, span.clone(), format!("`extends` names {}: {reason}", path.display()), remedy)
    })?;
    let size: usize = before.iter().chain([link]).map(|link| link.text.len()).sum();
    if (size + text.len()) as u64 > MOST_BYTES {
        let reason = format!("with {} the files of this scene have more than {MOST_BYTES} bytes", path.display());
        let remedy = "a scene is a short text; long lists belong into the files that it names";
        return Err(at(link, span, reason, remedy.into()));
    }
    let folder = link.folder.join(name).parent().unwrap_or(Path::new("")).to_owned();
    Ok(Some(Link { path, text, folder }))
}

fn at(link: &Link, span: Range<usize>, reason: String, remedy: String) -> SceneErrors {
    let mistake: SceneError = Texts::of(&link.path, &link.text).error(span, reason, remedy);
    SceneErrors::Mistakes(vec![mistake])
}

fn is_same(one: &Path, other: &Path) -> bool {
    one == other || matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}

/// "a.toml extends b.toml, which extends a.toml"
fn in_a_circle(files: &[&Path]) -> String {
    let names = files.iter().chain(files.first()).skip(1).map(|path| path.display().to_string());
    let rest: Vec<String> = names.collect();
    let first = files.first().map(|path| path.display().to_string()).unwrap_or_default();
    format!("`extends` goes in a circle: {first} extends {}", rest.join(", which extends "))
}
