//! Mistakes against TOML itself.

use std::path::Path;

use super::text::Texts;
use crate::scene::error::{SceneError, SceneErrors};
use crate::scene::keys::LISTED;

/// What is wrong in a text that is not TOML.
///
/// What a broken text means is a guess, so nothing else is said about it.
pub(super) fn syntax_errors(path: &Path, text: &str, errors: &[toml::de::Error]) -> SceneErrors {
    let texts = Texts::of(path, text);
    let mut mistakes: Vec<_> = errors.iter().take(LISTED).map(|error| syntax_error(&texts, text, error)).collect();
    // A path of Windows has several escapes.
    mistakes.dedup_by(|a, b| a.line == b.line && a.remedy == b.remedy);
    if let Some(last) = mistakes.last_mut() {
        last.more = errors.len().saturating_sub(LISTED);
    }
    SceneErrors::Mistakes(mistakes)
}

fn syntax_error(texts: &Texts, text: &str, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let backslash = || backslash_remedy(text, span.start);
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
    texts.error(span, format!("this is not TOML: {reason}"), remedy)
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
