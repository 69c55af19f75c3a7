//! What can be wrong with a scene file, each mistake with its place, the reason and a remedy.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// One mistake in a scene file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}:{line}:{column}: {reason}; {remedy}", path.display())]
pub struct SceneError {
    /// The scene file.
    pub path: Arc<Path>,
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What is wrong there.
    pub reason: String,
    /// What to write instead.
    pub remedy: String,
    /// The whole text of the file, for showing the line.
    pub text: Arc<str>,
    /// First byte and number of bytes of the place in `text`.
    pub span: (usize, usize),
    /// How many more there are of its kind behind this one, which are not listed.
    pub more: usize,
}

/// Why there is no scene: the file cannot be read, or all the mistakes in it, by line.
#[derive(Clone, Debug, PartialEq)]
pub enum SceneErrors {
    /// There is no text.
    Unreadable {
        /// The scene file.
        path: PathBuf,
        /// Why it cannot be read.
        reason: String,
        /// What to do about it.
        remedy: String,
    },
    /// The text has mistakes, at least one, in the order of the file; of each kind the first twenty.
    Mistakes(Vec<SceneError>),
}

impl SceneErrors {
    /// The mistakes in the text; none if there was no text.
    pub fn mistakes(&self) -> &[SceneError] {
        match self {
            SceneErrors::Unreadable { .. } => &[],
            SceneErrors::Mistakes(mistakes) => mistakes,
        }
    }
}

impl fmt::Display for SceneErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SceneErrors::Unreadable { path, reason, remedy } => write!(f, "{}: {reason}; {remedy}", path.display()),
            SceneErrors::Mistakes(mistakes) => {
                for (i, mistake) in mistakes.iter().enumerate() {
                    if i > 0 {
                        writeln!(f)?;
                    }
                    write!(f, "{mistake}")?;
                    if mistake.more > 0 {
                        write!(f, "\nand {} more like it", mistake.more)?;
                    }
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for SceneErrors {}

/// What is wrong, and which key of the scene says so, as in `metric.change[0].log_scale`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key}: {error}")]
pub struct AtKey<E: std::fmt::Display> {
    /// The dotted key.
    pub key: String,
    /// What is wrong with it.
    pub error: E,
}

impl<E: fmt::Display> AtKey<E> {
    /// Puts a key to an error, as in `map_err(AtKey::of("metric.csv"))`.
    pub fn of<F: Into<E>>(key: impl Into<String>) -> impl FnOnce(F) -> AtKey<E> {
        move |error| AtKey { key: key.into(), error: error.into() }
    }
}
