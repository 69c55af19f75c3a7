//! From a path or a text to a scene.

use std::io;
use std::path::{Path, PathBuf};

use toml::de::DeTable;

use super::data::Scene;
use super::error::{SceneError, SceneErrors};
use super::foreign::{folder_that_is_no_scene, foreign_content, foreign_ending};
use super::keys::{LISTED, Problem, Problems, Table};
use super::sections::root;
use super::source::Source;
use crate::text::decode;
use crate::whole_file::{self, ReadError};

/// Far more than any scene needs, and little enough to be read in a moment; what is longer is not a scene.
const MOST_BYTES: u64 = 4 << 20;

impl Scene {
    /// Reads a scene file. Its stem is the scene's name, its folder that of relative paths.
    ///
    /// # Errors
    /// [`SceneErrors`] if there is no such text, or with all the mistakes in it.
    pub fn read(path: &Path) -> Result<Scene, SceneErrors> {
        let unreadable = |reason: String, remedy: &str| SceneErrors::Unreadable {
            path: path.to_owned(),
            reason,
            remedy: remedy.to_owned(),
        };
        let foreign =
            |(reason, remedy): (String, String)| SceneErrors::Unreadable { path: path.to_owned(), reason, remedy };
        if path.is_dir() {
            return Err(foreign(folder_that_is_no_scene(path)));
        }
        // Of what ends otherwise the content does not matter, and may be large.
        let bytes = match (whole_file::read(path, MOST_BYTES), foreign_ending(path)) {
            (Ok(_) | Err(ReadError::TooLarge { .. }), Some(what)) => return Err(foreign(what)),
            (Ok(bytes), None) => bytes,
            (Err(ReadError::Io(error)), _) if error.kind() == io::ErrorKind::NotFound => {
                return Err(unreadable(
                    "there is no such file".into(),
                    "check the path; `immerse new NAME` writes a scene to start from",
                ));
            }
            (Err(ReadError::Io(error)), _) => {
                return Err(unreadable(format!("it cannot be read ({error})"), "name a scene file that you may read"));
            }
            (Err(error @ ReadError::NoFile(_)), _) => {
                let remedy = "name a scene file; what comes out of a pipe can be saved as one";
                return Err(unreadable(format!("it cannot be read: {error}"), remedy));
            }
            (Err(error @ ReadError::TooLarge { .. }), None) => {
                return Err(unreadable(
                    error.to_string(),
                    "name a scene file, which is a short text; long lists belong into the files that it names",
                ));
            }
        };
        if let Some(what) = foreign_content(path, &bytes) {
            return Err(foreign(what));
        }
        let text = decode(&bytes);
        if let Some(line) = text.first_broken_line {
            return Err(unreadable(format!("line {line} is not UTF-8 text"), "save the file as UTF-8"));
        }
        let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let folder = path.parent().unwrap_or(Path::new(""));
        parse(&text.text, name, folder, path.to_owned())
    }

    /// Reads a scene from a text. `name` names it in messages and output; relative paths in it start at `folder`.
    ///
    /// # Errors
    /// [`SceneErrors::Mistakes`] with every mistake: either those against TOML itself or, in valid TOML, all
    /// unknown keys, wrong types, impossible values and missing parameters.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Scene, SceneErrors> {
        // A text that was read by other means may have its mark still.
        parse(text.trim_start_matches('\u{feff}'), name.to_owned(), folder, folder.join(format!("{name}.toml")))
    }
}

fn parse(text: &str, name: String, folder: &Path, path: PathBuf) -> Result<Scene, SceneErrors> {
    let (tree, syntax_errors) = DeTable::parse_recoverable(text);
    let source = Source::new(path, text, tree.get_ref());
    if !syntax_errors.is_empty() {
        // What a broken text means is a guess, so nothing else is said about it.
        let listed = syntax_errors.iter().take(LISTED);
        let mut mistakes: Vec<_> = listed.map(|error| syntax_error(&source, error)).collect();
        // A path of Windows has several escapes.
        mistakes.dedup_by(|a, b| a.line == b.line && a.remedy == b.remedy);
        if let Some(last) = mistakes.last_mut() {
            last.more = syntax_errors.len().saturating_sub(LISTED);
        }
        return Err(SceneErrors::Mistakes(mistakes));
    }
    let problems = Problems::default();
    let mut table = Table::new("a scene".into(), Some(tree.get_ref()), 0..0, &problems);
    let mut scene = root(&mut table);
    table.finish();
    drop(table);
    let problems = problems.into_listed();
    if !problems.is_empty() {
        let mistake = |(p, more): (Problem, usize)| SceneError { more, ..source.error(p.span, p.reason, p.remedy) };
        return Err(SceneErrors::Mistakes(problems.into_iter().map(mistake).collect()));
    }
    scene.name = name;
    scene.folder = folder.to_owned();
    scene.source = source;
    Ok(scene)
}

fn syntax_error(source: &Source, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let backslash = || backslash_remedy(source.text(), span.start);
    let (reason, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let remedy = match (reason, expected) {
        ("duplicate key", _) => "remove one of the two".to_owned(),
        ("string values must be quoted" | "invalid boolean", _) => {
            "put text in double quotes; only numbers, true and false stand without".to_owned()
        }
        ("unexpected leading zero", _) => "remove the zeros in front, or put a class in quotes".to_owned(),
        (reason, _) if reason.contains("escape") || reason.contains("unicode") => {
            backslash().unwrap_or_else(|| "write two backslashes for one, or put the text in single quotes".to_owned())
        }
        (reason, _) if reason.contains("recurs") => "nest tables and lists less deeply".to_owned(),
        (_, "nothing") => "remove this".to_owned(),
        (_, "") => {
            "correct the line; a key is followed by `=` and a value, a list stands in square brackets".to_owned()
        }
        (_, expected) => format!("write {expected} here"),
    };
    source.error(span, format!("this is not TOML: {reason}"), remedy)
}

/// In double quotes a backslash begins an escape, as in no path of Windows: the string around a place, in single quotes.
fn backslash_remedy(text: &str, place: usize) -> Option<String> {
    let start = text.get(..place)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text.get(start..)?.lines().next()?;
    let (before, after) = line.split_at_checked(place - start)?;
    let opening = before.rfind('"')?;
    let closing = after.find('"').map_or(line.len(), |end| before.len() + end);
    let inside = line.get(opening + 1..closing)?;
    let single = (!inside.contains('\'') && inside.contains('\\')).then(|| format!(": '{inside}'"))?;
    Some(format!("in double quotes a backslash begins an escape; put it in single quotes{single}"))
}
