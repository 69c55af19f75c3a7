//! `--set key=value`: one key of a scene, set beside its file.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::merge::{self, ORDERED};
use super::text::padding;
use crate::scene::keys::{Field, Kind, Problem};
use crate::text::clipped;

/// What was typed.
pub(in crate::scene) struct Setting {
    text: String,
    /// Where it stands among all texts.
    start: usize,
    /// The key and the value, each as a text of TOML in which places are those among all texts.
    documents: Option<[String; 2]>,
    value: Range<usize>,
}

/// A key in parts, each with its place.
type Path<'a> = Vec<Spanned<DeString<'a>>>;

/// Tables are not nested as deeply.
const MOST_PARTS: usize = 64;

const EXAMPLE: &str = "write a key of the scene and its value, as in --set start.random=7";

impl Setting {
    /// Of `key=value`, which stands at this place, at least 2.
    pub fn new(text: &str, start: usize) -> Setting {
        let end = start + text.len();
        let mut setting = Setting { text: text.to_owned(), start, documents: None, value: end..end };
        let is_deep = |key: &str| key.matches('.').count() > MOST_PARTS;
        if let Some((key, value)) = split_setting(text).filter(|(key, _)| !is_deep(key)) {
            let place = start + key.len() + 1;
            let blanks = value.len() - value.trim_start().len();
            setting.value = place + blanks..place + blanks + value.trim().len();
            setting.documents = Some([padding(start) + key + "=0", padding(place - 2) + "v=" + value]);
        }
        setting
    }

    /// Sets the key in a scene whose keys may be these. `earlier` are the keys that were set before, to which it is added.
    pub fn apply<'a>(
        &'a self,
        tree: &mut DeValue<'a>,
        fields: &[Field],
        earlier: &mut Vec<String>,
    ) -> Result<(), Problem> {
        let here = || self.start..self.start + self.text.len();
        let no_key = || problem(here(), format!("`{}` is no key and value", clipped(&self.text)), EXAMPLE);
        let [key, value] = self.documents.as_ref().ok_or_else(no_key)?;
        let path = path_of(key).ok_or_else(no_key)?;
        let names: Vec<&str> = path.iter().map(|part| part.get_ref().as_ref()).collect();
        let name = names.join(".");
        let place = path.first().map_or(self.start, |part| part.span().start)
            ..path.last().map_or(self.start, |part| part.span().end);
        if names.first() == Some(&"extends") {
            return Err(problem(place, "`extends` cannot be set".into(), "write it into a scene file, and name that"));
        }
        if earlier.contains(&name) {
            return Err(problem(place, format!("`{name}` is set twice"), "remove one of the two"));
        }
        earlier.push(name);
        put(tree, &path, 0, self.value_for(value, &kinds(fields, &names)))
    }

    /// The value: as TOML if it is TOML, unless the key takes a text, and else as a text.
    fn value_for<'a>(&'a self, document: &'a str, kinds: &[&Kind]) -> Spanned<DeValue<'a>> {
        let text = || {
            let range = self.value.start - self.start..self.value.end - self.start;
            let text = self.text.get(range).unwrap_or_default();
            Spanned::new(self.value.clone(), DeValue::String(text.into()))
        };
        let (tree, errors) = DeTable::parse_recoverable(document);
        let mut entries = tree.into_inner().into_iter();
        match (errors.is_empty(), entries.next(), entries.next()) {
            (true, Some((_, value)), None) => match value.get_ref() {
                DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_) | DeValue::Datetime(_)
                    if takes_text(kinds) =>
                {
                    text()
                }
                _ => value,
            },
            _ => text(),
        }
    }
}

fn problem(span: Range<usize>, reason: String, remedy: &str) -> Problem {
    Problem { span, reason, remedy: remedy.to_owned() }
}

/// Key and value, between which is the first equals sign outside of quotes.
pub(crate) fn split_setting(text: &str) -> Option<(&str, &str)> {
    let mut quote = None;
    for (place, c) in text.char_indices() {
        match (quote, c) {
            (None, '=') => return Some((&text[..place], &text[place + 1..])),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            _ => {}
        }
    }
    None
}

fn path_of(document: &str) -> Option<Path<'_>> {
    let (tree, errors) = DeTable::parse_recoverable(document);
    let mut path = Vec::new();
    let mut table = errors.is_empty().then(|| tree.into_inner())?;
    loop {
        let mut entries = table.into_iter();
        let ((key, value), None) = (entries.next()?, entries.next()) else { return None };
        path.push(key);
        table = match value.into_inner() {
            DeValue::Table(table) => table,
            _ => return Some(path),
        };
    }
}

/// What the key may be. In a list, a number stands for one of its entries.
fn kinds<'f>(fields: &'f [Field], names: &[&str]) -> Vec<&'f Kind> {
    let Some((first, rest)) = names.split_first() else { return Vec::new() };
    let mut found = Vec::new();
    for field in fields {
        if field.name == *first {
            within(&field.kind, rest, &mut found);
        }
        if let Kind::Variants(variants) = &field.kind {
            variants.iter().for_each(|variant| found.extend(kinds(&variant.fields, names)));
        }
    }
    found
}

fn within<'f>(kind: &'f Kind, names: &[&str], found: &mut Vec<&'f Kind>) {
    let Some((_, rest)) = names.split_first() else {
        found.push(kind);
        return;
    };
    match kind {
        Kind::Table(fields) | Kind::ChangingNumber(_, fields) => found.extend(kinds(fields, names)),
        Kind::Tables(fields) => found.extend(kinds(fields, rest)),
        Kind::Map(item) | Kind::Array { item, .. } if rest.is_empty() => found.push(item),
        _ => {}
    }
}

/// Whether a number without quotes can only mean a text.
fn takes_text(kinds: &[&Kind]) -> bool {
    let is_text = |kind: &&Kind| match kind {
        Kind::Text | Kind::Color | Kind::Choice(_) | Kind::OneOrMore(_) | Kind::Variants(_) => true,
        Kind::Either(one, _) => matches!(**one, Kind::Text),
        _ => false,
    };
    !kinds.is_empty() && kinds.iter().all(is_text)
}

/// Puts a value at a path, of which `done` parts lead to where this is.
fn put<'a>(
    here: &mut DeValue<'a>,
    path: &[Spanned<DeString<'a>>],
    done: usize,
    value: Spanned<DeValue<'a>>,
) -> Result<(), Problem> {
    let Some(part) = path.get(done) else { return Ok(()) };
    let name = part.get_ref();
    let names = |count: usize| path[..count].iter().map(|part| part.get_ref().as_ref()).collect::<Vec<_>>().join(".");
    let slot = match here {
        DeValue::Table(table) => {
            if done + 1 == path.len() {
                let is_ordered = done > 0 && path.first().is_some_and(|first| first.get_ref() == ORDERED);
                merge::put(table, part.clone(), value, is_ordered);
                return Ok(());
            }
            if !table.contains_key(name.as_ref()) {
                if path.get(done + 1).is_some_and(|next| next.get_ref().parse::<usize>().is_ok()) {
                    let reason = format!("there is no list `{}` of which an entry could be set", names(done + 1));
                    return Err(problem(part.span(), reason, "write its entries into the scene file"));
                }
                table.insert(part.clone(), Spanned::new(part.span(), DeValue::Table(DeTable::new())));
            }
            table.get_mut(name.as_ref())
        }
        DeValue::Array(list) => {
            let (count, list_name) = (list.len(), names(done));
            let Ok(index) = name.parse::<usize>() else {
                let reason = format!("`{list_name}` is a list, and `{name}` says which entry by no number");
                let remedy = format!("count its entries from 0, as in {list_name}.0, or set the whole list");
                return Err(problem(part.span(), reason, &remedy));
            };
            let Some(element) = list.get_mut(index) else {
                let reason = format!("`{list_name}` has no entry {index}: there are {count}, counted from 0");
                return Err(problem(part.span(), reason, "name one that is there, or write more into the scene file"));
            };
            Some(element)
        }
        _ => {
            let reason = format!("`{}` is no table, and has no `{name}`", names(done));
            return Err(problem(part.span(), reason, "set the key itself"));
        }
    };
    match slot {
        Some(slot) if done + 1 == path.len() => *slot = value,
        Some(slot) => return put(slot.get_mut(), path, done + 1, value),
        None => {}
    }
    Ok(())
}
