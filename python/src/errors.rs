//! The library's errors as Python's exceptions, with the same sentences.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;

use immerse::advice::Advice;
use immerse::evolve::EvolveError;
use immerse::film::{DiskError, FilmError};
use immerse::mesh::{MeshError, WriteError};
use immerse::scene::{SceneError, SceneErrors};
use pyo3::create_exception;
use pyo3::exceptions::{
    PyException, PyFileNotFoundError, PyIsADirectoryError, PyOSError, PyPermissionError, PyValueError,
};
use pyo3::prelude::*;

create_exception!(
    immerse,
    Error,
    PyValueError,
    "What was given is at fault. The text says what is wrong and what to do about it; `remedy` is the latter alone."
);
create_exception!(
    immerse,
    Stopped,
    PyException,
    "A progress callback returned False. The text says how many steps had been taken."
);

/// Adds the exceptions to the module.
pub fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    let error = py.get_type::<Error>();
    error.setattr("remedy", "")?;
    module.add("Error", error)?;
    module.add("Stopped", py.get_type::<Stopped>())
}

/// An exception with these words.
fn with_remedy(py: Python<'_>, text: String, remedy: String) -> PyErr {
    let error = Error::new_err(text);
    match error.value(py).setattr("remedy", remedy) {
        Ok(()) => error,
        Err(other) => other,
    }
}

/// An error of the library.
pub fn raised(py: Python<'_>, error: &impl Advice) -> PyErr {
    with_remedy(py, error.to_string(), error.remedy())
}

/// What is wrong with an argument, and what to do about it.
pub fn refused(py: Python<'_>, reason: impl Into<String>, remedy: impl Into<String>) -> PyErr {
    let (reason, remedy) = (reason.into(), remedy.into());
    with_remedy(py, format!("{reason}; {remedy}"), remedy)
}

/// What the system says, in the library's words.
fn of_system(kind: ErrorKind, text: String) -> PyErr {
    match kind {
        ErrorKind::NotFound => PyFileNotFoundError::new_err(text),
        ErrorKind::PermissionDenied => PyPermissionError::new_err(text),
        ErrorKind::IsADirectory => PyIsADirectoryError::new_err(text),
        _ => PyOSError::new_err(text),
    }
}

/// An error of a file that was to be read: of the system if it cannot be opened, else of what is in it.
fn of_file(py: Python<'_>, path: &Path, text: String, remedy: String) -> PyErr {
    match File::open(path) {
        Err(error) => of_system(error.kind(), text),
        Ok(_) => with_remedy(py, text, remedy),
    }
}

/// A mesh that cannot be read or made.
pub fn of_mesh(py: Python<'_>, error: &MeshError) -> PyErr {
    match error {
        MeshError::File { path, .. } => of_file(py, path, error.to_string(), error.remedy()),
        _ => raised(py, error),
    }
}

/// A file that was not written.
pub fn of_write(py: Python<'_>, error: &WriteError) -> PyErr {
    match error {
        WriteError::NoFolder { .. } => of_system(ErrorKind::NotFound, error.to_string()),
        WriteError::Io { .. } => of_system(ErrorKind::Other, error.to_string()),
        WriteError::Count { .. } | WriteError::NotFinite { .. } => raised(py, error),
    }
}

/// Mistakes in a scene, each with its line and a caret under the place.
pub fn of_scene(py: Python<'_>, errors: &SceneErrors) -> PyErr {
    match errors {
        SceneErrors::Unreadable { path, remedy, .. } => of_file(py, path, errors.to_string(), remedy.clone()),
        SceneErrors::Mistakes(mistakes) => {
            let text = mistakes.iter().map(with_caret).collect::<Vec<_>>().join("\n");
            let remedy = mistakes.first().map(|mistake| mistake.remedy.clone()).unwrap_or_default();
            with_remedy(py, text, remedy)
        }
    }
}

/// A mistake that is found when a scene is built.
pub fn of_mistake(py: Python<'_>, mistake: &SceneError) -> PyErr {
    with_remedy(py, with_caret(mistake), mistake.remedy.clone())
}

/// A sentence, and below it the line of the scene with a caret.
fn with_caret(mistake: &SceneError) -> String {
    let SceneError { line, column, text, span, more, .. } = mistake;
    let mut words = mistake.to_string();
    if let Some(shown) = text.lines().nth(line.saturating_sub(1)).filter(|shown| shown.chars().count() <= 200) {
        let start = column.saturating_sub(1);
        let under = text.get(span.0..span.0 + span.1).and_then(|place| place.lines().next()).unwrap_or_default();
        let wide = under.chars().count().clamp(1, shown.chars().count().saturating_sub(start).max(1));
        let (margin, number) = (" ".repeat(line.to_string().len()), line);
        words += &format!("\n  {number} | {shown}\n  {margin} | {}{}", " ".repeat(start), "^".repeat(wide));
    }
    if *more > 0 {
        words += &format!("\nand {more} more like it");
    }
    words
}

/// The folder of a film.
pub fn of_disk(py: Python<'_>, error: &DiskError) -> PyErr {
    match error {
        DiskError::Io { source, .. } => of_system(io::Error::kind(source), error.to_string()),
        DiskError::NotAFilm { path } if !path.exists() => of_system(ErrorKind::NotFound, error.to_string()),
        DiskError::Missing { .. } => of_system(ErrorKind::NotFound, error.to_string()),
        DiskError::Busy { .. } => PyOSError::new_err(error.to_string()),
        _ => raised(py, error),
    }
}

/// Pictures of a film.
pub fn of_film(py: Python<'_>, error: &FilmError) -> PyErr {
    match error {
        FilmError::Scene(errors) => of_scene(py, errors),
        FilmError::Disk(error) => of_disk(py, error),
        FilmError::Render(immerse::render::RenderError::Write { .. }) => PyOSError::new_err(error.to_string()),
        FilmError::Stopped => Stopped::new_err(error.reason()),
        _ => raised(py, error),
    }
}

/// A simulation that ended early.
pub fn of_evolve(py: Python<'_>, error: &EvolveError) -> PyErr {
    match error {
        EvolveError::Stopped { .. } => Stopped::new_err(error.reason()),
        _ => raised(py, error),
    }
}
