//! What is asked of a sweep.

use std::path::Path;

/// What is asked for, as it was typed.
pub(in crate::cli) struct Request<'a> {
    pub scene: &'a Path,
    pub mesh: Option<&'a Path>,
    pub set: &'a [String],
    pub out: Option<&'a Path>,
    pub restart: bool,
}

impl Request<'_> {
    /// The command that asks for it, for a shell.
    pub fn command(&self) -> String {
        let mut words = vec!["immerse".to_owned(), "sweep".to_owned(), quoted(&self.scene.to_string_lossy())];
        words.extend(self.set.iter().map(|text| format!("--set {}", quoted(text))));
        words.extend(self.mesh.map(|mesh| format!("--mesh {}", quoted(&mesh.to_string_lossy()))));
        words.extend(self.out.map(|out| format!("--out {}", quoted(&out.to_string_lossy()))));
        words.join(" ")
    }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "._-=,+/:@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
