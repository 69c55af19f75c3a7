//! Words of a command line as job files can have them.

use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;

/// A path as text, from wherever one is. Job files are text with lines, so that some names of files have no place in them.
pub(super) fn text_of(path: &Path) -> Result<String, Failure> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let unfit = || Failure::Farm(format!("{} is no line of text; name another file or folder", path.display()));
    path.to_str().filter(|text| is_line(text)).map(str::to_owned).ok_or_else(unfit)
}

/// A word as it was typed.
pub(super) fn line_of(word: &str) -> Result<String, Failure> {
    let unfit = || Failure::Farm(format!("`{}` is more than one line; write it into the scene", word.escape_default()));
    if is_line(word) { Ok(word.to_owned()) } else { Err(unfit()) }
}

/// This program.
pub(super) fn program() -> Result<String, Failure> {
    text_of(&std::env::current_exe().unwrap_or_else(|_| PathBuf::from("immerse")))
}

fn is_line(text: &str) -> bool {
    !text.contains(char::is_control)
}

/// A name that engines take: letters, digits, dots, lines.
pub(super) fn plain_name(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' };
    name.chars().map(plain).take(64).collect()
}
