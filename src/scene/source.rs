//! Where in the file each key stands, so that later stages can point at it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::SceneError;

/// A place in the scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What is written there.
    pub text: String,
}

/// The text of a scene and the places of its keys. Empty for a scene that was made in code.
#[derive(Clone, Debug, Default)]
pub struct Source {
    path: PathBuf,
    text: Arc<str>,
    /// By dotted key, as in `phase[0].dt`: the bytes of the value, or of the header of a table.
    spans: Arc<BTreeMap<String, Range<usize>>>,
}

impl Source {
    pub(super) fn new(path: PathBuf, text: &str, tree: &DeTable) -> Source {
        let mut spans = BTreeMap::new();
        collect_spans(tree, "", &mut spans);
        Source { path, text: text.into(), spans: Arc::new(spans) }
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where the value of a dotted key stands, as in `mesh.radius` or `phase[0].dt`; for a table its
    /// header. `None` if the file does not say it.
    pub fn locate(&self, key: &str) -> Option<Location> {
        let span = self.spans.get(key)?.clone();
        let (line, column) = line_and_column(&self.text, span.start);
        Some(Location { line, column, text: self.text.get(span).unwrap_or_default().to_owned() })
    }

    /// An error at a dotted key or, where the file leaves it out, at the table it would stand in.
    pub fn complain(&self, key: &str, reason: String, remedy: String) -> SceneError {
        let mut key = key;
        loop {
            if let Some(span) = self.spans.get(key) {
                return self.error(span.clone(), reason, remedy);
            }
            match key.rfind(['.', '[']) {
                Some(end) => key = &key[..end],
                None => return self.error(0..0, reason, remedy),
            }
        }
    }

    pub(super) fn error(&self, span: Range<usize>, reason: String, remedy: String) -> SceneError {
        let (line, column) = line_and_column(&self.text, span.start);
        SceneError {
            path: self.path.as_path().into(),
            line,
            column,
            reason,
            remedy,
            text: self.text.clone(),
            span: (span.start, span.end.saturating_sub(span.start)),
            more: 0,
        }
    }
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let mut start = offset.min(text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let before = &text[..start];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

fn collect_spans(table: &DeTable, prefix: &str, spans: &mut BTreeMap<String, Range<usize>>) {
    for (key, value) in table {
        let path = if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
        collect_value(value, path, spans);
    }
}

fn collect_value(value: &Spanned<DeValue>, path: String, spans: &mut BTreeMap<String, Range<usize>>) {
    match value.get_ref() {
        DeValue::Table(table) => collect_spans(table, &path, spans),
        DeValue::Array(array) => {
            // Elements get a place of their own only where they are tables: `[[phase]]`, `parts`.
            for (i, element) in array.iter().enumerate().filter(|(_, element)| element.get_ref().is_table()) {
                collect_value(element, format!("{path}[{i}]"), spans);
            }
        }
        _ => {}
    }
    spans.insert(path, value.span());
}
