//! One table of keys laid over another.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::scene::keys::PATHS;

/// The key of a scene that names the file which it extends.
const EXTENDS: &str = "extends";

/// What a file extends, and where it says so. What is no path is left to whoever reads the key.
pub(super) fn extends<'t>(tree: &'t DeTable) -> Option<(&'t str, Range<usize>)> {
    let value = tree.get(EXTENDS)?;
    let text = value.get_ref().as_str().filter(|text| !text.is_empty() && !text.contains(char::is_control))?;
    Some((text, value.span()))
}

/// Takes the name of the file out of the table that has been extended.
pub(in crate::scene) fn take_extends(tree: &mut DeTable) {
    if extends(tree).is_some() {
        tree.remove(EXTENDS);
    }
}

/// The table whose keys count in the order of the texts.
pub(super) const ORDERED: &str = "parameters";

/// Lays the keys of a scene over those of another: tables are put together key by key, anything else takes the place of what
/// was there. A parameter that was there keeps its place in the order.
pub(in crate::scene) fn lay_over<'a>(under: &mut DeTable<'a>, over: DeTable<'a>) {
    lay(under, over, false);
}

fn lay<'a>(under: &mut DeTable<'a>, over: DeTable<'a>, is_ordered: bool) {
    for (key, value) in over {
        let span = value.span();
        let merged = match (under.get_mut(key.get_ref().as_ref()), value.into_inner()) {
            (Some(below), DeValue::Table(over)) if below.get_ref().is_table() => {
                let mut below = std::mem::replace(below.get_mut(), DeValue::Boolean(false));
                if let DeValue::Table(under) = &mut below {
                    lay(under, over, key.get_ref() == ORDERED);
                }
                below
            }
            (_, over) => over,
        };
        put(under, key, Spanned::new(span, merged), is_ordered);
    }
}

/// Puts a key into a table, in place of what has its name, whose place in the order it may take.
pub(super) fn put<'a>(
    table: &mut DeTable<'a>,
    key: Spanned<DeString<'a>>,
    value: Spanned<DeValue<'a>>,
    is_ordered: bool,
) {
    if !is_ordered {
        table.remove(key.get_ref().as_ref());
    }
    // What has the name keeps its key.
    table.insert(key, value);
}

/// Seen from the folder of the scene, the files that a table names which was written in another folder.
pub(in crate::scene) fn move_paths(tree: &mut DeTable, folder: &Path) {
    if folder.as_os_str().is_empty() {
        return;
    }
    // Parameters are called as one likes.
    for (_, value) in tree.iter_mut().filter(|(key, _)| key.get_ref() != ORDERED) {
        move_in(value.get_mut(), folder);
    }
}

fn move_in(value: &mut DeValue, folder: &Path) {
    match value {
        DeValue::Table(table) => {
            for (key, value) in table.iter_mut() {
                if PATHS.contains(&key.get_ref().as_ref()) {
                    move_path(value.get_mut(), folder);
                } else {
                    move_in(value.get_mut(), folder);
                }
            }
        }
        DeValue::Array(list) => list.iter_mut().for_each(|element| move_in(element.get_mut(), folder)),
        _ => {}
    }
}

fn move_path(value: &mut DeValue, folder: &Path) {
    match value {
        DeValue::String(path) if !path.is_empty() => {
            *path = folder.join(&**path).to_string_lossy().into_owned().into();
        }
        DeValue::Array(list) => list.iter_mut().for_each(|path| move_path(path.get_mut(), folder)),
        _ => {}
    }
}

/// Removes the keys whose values stand at these places.
pub(in crate::scene) fn without(table: &mut DeTable, places: &[Range<usize>]) {
    let goes = |value: &Spanned<DeValue>| places.contains(&value.span());
    let names = table.iter().filter(|(_, value)| goes(value)).map(|(key, _)| key.get_ref().to_string());
    for name in names.collect::<Vec<_>>() {
        table.remove(name.as_str());
    }
    table.iter_mut().for_each(|(_, value)| without_in(value.get_mut(), places));
}

fn without_in(value: &mut DeValue, places: &[Range<usize>]) {
    match value {
        DeValue::Table(table) => without(table, places),
        DeValue::Array(list) => list.iter_mut().for_each(|element| without_in(element.get_mut(), places)),
        _ => {}
    }
}
