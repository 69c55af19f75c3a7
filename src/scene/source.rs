//! Where in its texts each key of a scene stands, so that later stages can point at it.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::SceneError;
use super::texts::Texts;

/// A place in the scene file, in a file that it extends, or in what was set beside it.
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
    text: Arc<str>,
    texts: Texts,
    /// By dotted key, as in `phase[0].dt`: the bytes of the value, or of the header of a table.
    spans: Arc<BTreeMap<String, Range<usize>>>,
}

impl Source {
    pub(super) fn new(texts: Texts, text: &str, tree: &DeTable) -> Source {
        let mut spans = BTreeMap::new();
        collect_spans(tree, "", &mut spans);
        Source { text: text.into(), texts, spans: Arc::new(spans) }
    }

    /// The whole scene as one text: that of its file, or, if it extends another one or keys of it were set, one that says the same.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where the value of a dotted key stands, as in `mesh.radius` or `phase[0].dt`; for a table its
    /// header. `None` if the scene does not say it.
    pub fn locate(&self, key: &str) -> Option<Location> {
        let (line, column, text) = self.texts.locate(self.spans.get(key)?)?;
        Some(Location { line, column, text: text.to_owned() })
    }

    /// An error at a dotted key or, where the scene leaves it out, at the table it would stand in.
    pub fn complain(&self, key: &str, reason: String, remedy: String) -> SceneError {
        let mut key = key;
        loop {
            if let Some(span) = self.spans.get(key) {
                return self.texts.error(span.clone(), reason, remedy);
            }
            match key.rfind(['.', '[']) {
                Some(end) => key = &key[..end],
                None => return self.texts.error(self.texts.nowhere(), reason, remedy),
            }
        }
    }
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
