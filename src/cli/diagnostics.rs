//! Errors as a person wants them: the line of the scene with a caret, the reason, what to write instead.

use std::borrow::Cow;
use std::fmt;

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode,
    SourceSpan, SpanContents,
};

use crate::scene::SceneError;

/// A text on one line, whatever names of files and folders are in it.
pub(super) fn one_line(text: &str) -> Cow<'_, str> {
    let breaks = |c: char| c.is_control() || c == '\u{2028}' || c == '\u{2029}';
    if !text.contains(breaks) {
        return text.into();
    }
    let spelled = |c: char| if breaks(c) { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(spelled).collect::<String>().into()
}

/// The mistake, its line with a caret under the place, and the remedy.
pub(super) fn explain(mistake: &SceneError, colors: bool) -> String {
    let mut theme = GraphicalTheme::ascii();
    if !colors {
        theme = GraphicalTheme::none();
    }
    theme.characters.error = "error:".into();
    let snippet = Snippet { mistake, lines: Lines::around(mistake) };
    let mut text = String::new();
    match GraphicalReportHandler::new_themed(theme).with_context_lines(1).render_report(&mut text, &snippet) {
        Ok(()) => text,
        Err(fmt::Error) => format!("error: {mistake}"),
    }
}

/// A mistake as miette draws it.
#[derive(Debug)]
struct Snippet<'m> {
    mistake: &'m SceneError,
    /// `None` if they are no help.
    lines: Option<Lines>,
}

impl fmt::Display for Snippet<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SceneError { path, line, column, reason, .. } = self.mistake;
        if self.lines.is_none() {
            write!(f, "{}:{line}:{column}: ", one_line(&path.to_string_lossy()))?;
        }
        write!(f, "{}", abridged(reason))
    }
}

impl std::error::Error for Snippet<'_> {}

impl Diagnostic for Snippet<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(abridged(&self.mistake.remedy)))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.lines.as_ref().map(|lines| lines as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let lines = self.lines.as_ref()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, lines.span))))
    }
}

/// The line of a mistake with those before and after it, and nothing else of the file.
#[derive(Debug)]
struct Lines {
    text: String,
    path: String,
    /// Of the first one, from 0.
    number: usize,
    /// The place in this text.
    span: (usize, usize),
}

/// Lines of more bytes are not shown.
const LONGEST_LINE: usize = 1000;

impl Lines {
    fn around(mistake: &SceneError) -> Option<Lines> {
        let text = &*mistake.text;
        let (place, length) = mistake.span;
        let start_of_line = |place: usize| text.get(..place)?.rfind('\n').map_or(Some(0), |newline| Some(newline + 1));
        let end_of_line = |place: usize| Some(text.get(place..)?.find('\n').map_or(text.len(), |end| place + end));
        let (first, last) = (start_of_line(place)?, end_of_line(place)?);
        let start = if first > 0 { start_of_line(first - 1)? } else { 0 };
        let end = if last < text.len() { end_of_line(last + 1)? } else { last };
        let shown = text.get(start..end)?;
        if text.is_empty() || shown.lines().any(|line| line.len() > LONGEST_LINE) {
            return None;
        }
        // What goes on in lines below is shown as far as its own line.
        let length = length.min((last - place).max(1));
        let number = mistake.line.saturating_sub(if first > 0 { 2 } else { 1 });
        let path = one_line(&mistake.path.to_string_lossy()).into_owned();
        // The space lets a caret stand behind the last character, where something is missing.
        Some(Lines { text: format!("{shown} "), path, number, span: (place - start, length) })
    }
}

impl SourceCode for Lines {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.text.as_str().read_span(span, before, after)?;
        Ok(Box::new(MietteSpanContents::new_named(
            self.path.clone(),
            contents.data(),
            *contents.span(),
            self.number + contents.line(),
            contents.column(),
            contents.line_count(),
        )))
    }
}

/// Characters of a text that are shown. What a file quotes in it may be as long as the file.
const LONGEST_TEXT: usize = 1000;

/// A text without its middle if it is too long.
fn abridged(text: &str) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= LONGEST_TEXT {
        return text.into();
    }
    let half = LONGEST_TEXT / 2;
    let beginning: String = text.chars().take(half).collect();
    let end: String = text.chars().skip(count - half).collect();
    format!("{beginning} … {end}").into()
}
