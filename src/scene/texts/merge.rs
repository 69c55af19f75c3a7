//! One table of keys laid over another.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

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

/// Lays a table over another: tables are put together key by key, anything else takes the place of what was there. A key
/// that was there keeps its place in the order.
pub(in crate::scene) fn lay_over<'a>(under: &mut DeTable<'a>, over: DeTable<'a>) {
    for (key, value) in over {
        let Some(below) = under.get_mut(key.get_ref().as_ref()) else {
            under.insert(key, value);
            continue;
        };
        let span = value.span();
        let merged = match (std::mem::replace(below.get_mut(), DeValue::Boolean(false)), value.into_inner()) {
            (DeValue::Table(mut under), DeValue::Table(over)) => {
                lay_over(&mut under, over);
                DeValue::Table(under)
            }
            (_, over) => over,
        };
        *below = Spanned::new(span, merged);
    }
}

/// Seen from the folder of the scene, the files that a table names which was written in another folder.
pub(in crate::scene) fn move_paths(tree: &mut DeTable, folder: &Path) {
    if folder.as_os_str().is_empty() {
        return;
    }
    // Parameters are called as one likes.
    for (_, value) in tree.iter_mut().filter(|(key, _)| key.get_ref() != "parameters") {
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
