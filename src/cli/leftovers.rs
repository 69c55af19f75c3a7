//! What is removed because it is not of a film, and what is left from before, in words.

use std::path::Path;

use super::failure::PipelineError;
use super::progress::Log;
use crate::film::{self, Leftovers};
use crate::scene::OutputSection;

/// Removes pictures of another film and says which, and names those of formats that were not made now, on a line each. A page that
/// is about to be written is neither.
pub(super) fn clear_leftovers(
    folder: &Path,
    output: Option<&OutputSection>,
    page_follows: bool,
    log: &Log,
) -> Result<(), PipelineError> {
    let cleared = film::clear_leftovers(folder, output, page_follows);
    let Leftovers { removed, older } = cleared.map_err(PipelineError::from)?;
    say_removed(folder, &removed, log);
    say(folder, "left from an earlier run, not made anew", &older, log);
    Ok(())
}

/// Names files that were removed.
pub(super) fn say_removed(folder: &Path, names: &[String], log: &Log) {
    say(folder, "removed what is not of this film", names, log);
}

/// Files that are listed by name.
const NAMED: usize = 8;

fn say(folder: &Path, what: &str, names: &[String], log: &Log) {
    let listed = match names.len().saturating_sub(NAMED) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names[..NAMED].join(", ")),
    };
    if !names.is_empty() {
        log.note(format_args!("{}: {what} ({} files): {listed}", folder.display(), names.len()));
    }
}
