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
            }
            if mistakes.len() > 1 {
                say(format_args!("{} mistakes", mistakes.len()));
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

impl fmt::Display for Snippet<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.mistake.reason)
    }
}

impl std::error::Error for Snippet<'_> {}

impl Diagnostic for Snippet<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.mistake.remedy))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.mistake.text.is_empty()).then_some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(None, self.mistake.span))))
    }
}
