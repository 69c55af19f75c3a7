//! Several texts, one behind the other, so that a place says which of them is meant.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::scene::error::SceneError;

/// A text and where it stands.
#[derive(Clone, Debug)]
struct Text {
    path: Arc<Path>,
    text: Arc<str>,
    start: usize,
    rank: usize,
}

/// The texts of a scene. Places, in bytes, count through all of them.
#[derive(Clone, Debug, Default)]
pub(in crate::scene) struct Texts {
    texts: Vec<Text>,
    /// Where the file of the scene itself begins.
    main: usize,
}

/// What stands before a text that begins at this place, so that a parser counts from there.
pub(in crate::scene) fn padding(start: usize) -> String {
    " ".repeat(start)
}

impl Texts {
    /// One text alone.
    pub fn of(path: &Path, text: &str) -> Texts {
        let mut texts = Texts::default();
        texts.add(path, text, 0);
        texts
    }

    /// Adds a text; what it says takes the place of what those of a lower rank say. Returns where it begins.
    pub fn add(&mut self, path: &Path, text: &str, rank: usize) -> usize {
        // One place between texts belongs to the end of the first.
        let start = self.texts.last().map_or(0, |last| last.start + last.text.len() + 1);
        self.texts.push(Text { path: path.into(), text: text.into(), start, rank });
        start
    }

    /// Says where the file of the scene itself begins.
    pub fn set_main(&mut self, start: usize) {
        self.main = start;
    }

    /// The beginning of the scene's own file, for what is said nowhere.
    pub fn nowhere(&self) -> Range<usize> {
        self.main..self.main
    }

    /// Where each text begins, and its rank.
    pub fn ranks(&self) -> Vec<(usize, usize)> {
        self.texts.iter().map(|text| (text.start, text.rank)).collect()
    }

    fn at(&self, place: usize) -> Option<&Text> {
        self.texts.iter().rev().find(|text| text.start <= place)
    }

    /// Line and column, from 1, and what stands there.
    pub fn locate(&self, span: &Range<usize>) -> Option<(usize, usize, &str)> {
        let text = self.at(span.start)?;
        let [start, end] = [span.start, span.end].map(|place| place.saturating_sub(text.start));
        let (line, column) = line_and_column(&text.text, start);
        Some((line, column, text.text.get(start..end).unwrap_or_default()))
    }

    /// An error at a place.
    pub fn error(&self, span: Range<usize>, reason: String, remedy: String) -> SceneError {
        let nothing = || Text { path: Path::new("").into(), text: "".into(), start: 0, rank: 0 };
        let Text { path, text, start, .. } = self.at(span.start).cloned().unwrap_or_else(nothing);
        let place = span.start.saturating_sub(start);
        let (line, column) = line_and_column(&text, place);
        SceneError { path, line, column, reason, remedy, text, span: (place, span.len()), more: 0 }
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
