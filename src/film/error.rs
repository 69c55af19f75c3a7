use std::path::PathBuf;

use crate::{
    cache::CacheError,
    render::RenderError,
    scene::{Scene, SceneError, SceneErrors},
};

/// Why pictures of a film cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum MovieError {
    /// What the scene says of its pictures is at fault.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The folder of the film is at fault.
    #[error(transparent)]
    Cache(#[from] CacheError),
    /// A picture cannot be made or written.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Pictures are wanted of a frame that has not been computed.
    #[error("{}: frame {frame} has not been computed; run `immerse simulate` first", folder.display())]
    NoSuchFrame {
        /// The film.
        folder: PathBuf,
        /// The frame.
        frame: usize,
    },
    /// A field of a frame cannot be computed.
    #[error("a frame has no such field to show ({reason}); simulate the film anew, or show another")]
    Field {
        /// What is wrong.
        reason: String,
    },
    /// The program was built without the encoder.
    #[error(
        "this program was built without mp4; build it with `cargo build --release --features mp4` (which takes a C++ \
         compiler), or ask for gif or apng"
    )]
    WithoutMp4,
}

impl From<SceneError> for MovieError {
    fn from(error: SceneError) -> Self {
        MovieError::Scene(SceneErrors::Mistakes(vec![error]))
    }
}

impl MovieError {
    /// Whether another input would help, rather than another machine or another try.
    pub fn is_fault_of_input(&self) -> bool {
        match self {
            MovieError::Scene(_) | MovieError::NoSuchFrame { .. } | MovieError::WithoutMp4 => true,
            MovieError::Field { .. } => false,
            MovieError::Cache(error) => !matches!(error, CacheError::Io { .. } | CacheError::Unfit { .. }),
            MovieError::Render(error) => !matches!(error, RenderError::Write { .. }),
        }
    }

    /// An error shown where the scene names what is at fault.
    pub(super) fn of_scene(scene: &Scene, key: &str, message: &str) -> MovieError {
        MovieError::Scene(SceneErrors::Mistakes(vec![scene.complain_of(key, message)]))
    }

    /// A file that could not be written.
    pub(super) fn write(path: &std::path::Path, reason: impl std::fmt::Display) -> MovieError {
        MovieError::Render(RenderError::Write { path: path.to_owned(), reason: reason.to_string() })
    }
}
