//! Errors as a person wants them: the line of the scene with a caret, the reason, what to write instead.

use std::fmt;
use std::io::{self, IsTerminal, Write};

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

use crate::scene::{SceneError, SceneErrors};

/// Writes a line to standard error. If even that is gone there is nobody to tell.
pub(super) fn say(text: impl fmt::Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Shows all mistakes of a scene.
pub(super) fn say_scene_errors(errors: &SceneErrors) {
    match errors {
        SceneErrors::Unreadable { .. } => say(format_args!("error: {errors}")),
        SceneErrors::Mistakes(mistakes) => {
            for mistake in mistakes {
                say(explain(mistake, io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()));
                if mistake.more > 0 {
                    say(format_args!("and {} more like the last one\n", mistake.more));
                }
            }
            let count: usize = mistakes.iter().map(|mistake| 1 + mistake.more).sum();
            if count > 1 {
                say(format_args!("{count} mistakes"));
            }
        }
    }
}

/// The mistake, its line with a caret under the place, and the remedy.
pub(super) fn explain(mistake: &SceneError, colors: bool) -> String {
    let mut theme = GraphicalTheme::ascii();
    if !colors {
        theme = GraphicalTheme::none();
    }
    theme.characters.error = "error:".into();
    // The space lets a caret stand behind the last character, where something is missing.
    let source = NamedSource::new(mistake.path.to_string_lossy(), format!("{} ", mistake.text));
    let snippet = Snippet { mistake, source };
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
    source: NamedSource<String>,
}

/// Lines of more bytes are not shown.
const LONGEST_LINE: usize = 1000;

impl Snippet<'_> {
    fn is_in_a_long_line(&self) -> bool {
        let (start, _) = self.mistake.span;
        let [before, after] =
            self.mistake.text.as_bytes().split_at_checked(start).map_or([&[][..]; 2], |(a, b)| [a, b]);
        let before = before.iter().rev().take_while(|&&b| b != b'\n').take(LONGEST_LINE + 1).count();
        before + after.iter().take_while(|&&b| b != b'\n').take(LONGEST_LINE + 1).count() > LONGEST_LINE
    }
}

impl fmt::Display for Snippet<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SceneError { path, line, column, reason, .. } = self.mistake;
        if self.is_in_a_long_line() {
            write!(f, "{}:{line}:{column}: ", path.display())?;
        }
        write!(f, "{reason}")
    }
}

impl std::error::Error for Snippet<'_> {}

impl Diagnostic for Snippet<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.mistake.remedy))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.mistake.text.is_empty() && !self.is_in_a_long_line()).then_some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, self.mistake.span))))
    }
}
