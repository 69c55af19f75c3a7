use std::path::PathBuf;

use crate::{
    advice::Advice,
    film::disk::DiskError,
    mesh::{MeshError, SurfaceError},
    render::RenderError,
    scene::{SceneError, SceneErrors},
};

/// Why pictures of a film cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// What the scene says of its pictures is at fault.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The folder of the film is at fault.
    #[error(transparent)]
    Disk(#[from] DiskError),
    /// A picture cannot be made or written.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Pictures are wanted of a frame that has not been computed.
    #[error("{}: frame {frame} has not been computed; {}", folder.display(), self.remedy())]
    NoSuchFrame {
        /// The film.
        folder: PathBuf,
        /// The frame.
        frame: usize,
    },
    /// There is neither a film nor a sequence of surfaces.
    #[error("{}: there is no film here, and {}; {}", folder.display(), obj_files(*files), self.remedy())]
    NothingToCertify {
        /// The folder.
        folder: PathBuf,
        /// OBJ files in it.
        files: usize,
    },
    /// A surface cannot be read, or is of another mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Positions that nothing can be said of.
    #[error("{}: {source}", path.display())]
    Positions {
        /// Their file.
        path: PathBuf,
        /// Why.
        source: SurfaceError,
    },
    /// A field of a frame cannot be computed.
    #[error("a frame has no such field to show ({reason}); {}", self.remedy())]
    Field {
        /// What is wrong.
        reason: String,
    },
    /// Nobody wants the pictures any more.
    #[error("no more pictures were wanted; {}", self.remedy())]
    Stopped,
    /// The program was built without the encoder.
    #[error("this program was built without mp4; {}", self.remedy())]
    WithoutMp4,
}

impl Advice for FilmError {
    fn remedy(&self) -> String {
        match self {
            FilmError::Scene(errors) => {
                errors.mistakes().first().map_or_else(|| "correct the scene".into(), |mistake| mistake.remedy.clone())
            }
            FilmError::Disk(error) => error.remedy(),
            FilmError::Render(error) => error.remedy(),
            FilmError::NoSuchFrame { .. } => "run `immerse simulate` first".into(),
            FilmError::NothingToCertify { .. } => {
                "name the folder of a film, which holds manifest.json, or one with two or more \
                                                   OBJ files that have the same faces, in the order of their names"
                    .into()
            }
            FilmError::Mesh(error) => error.remedy(),
            FilmError::Positions { source, .. } => source.remedy(),
            FilmError::Field { .. } => "simulate the film anew, or show another".into(),
            FilmError::Stopped => "run it again".into(),
            FilmError::WithoutMp4 => {
                "build it with `cargo build --release --features mp4` (which takes a C++ compiler), or ask \
                                      for gif or apng"
                    .into()
            }
        }
    }
}

impl From<SceneError> for FilmError {
    fn from(error: SceneError) -> Self {
        FilmError::Scene(SceneErrors::Mistakes(vec![error]))
    }
}

impl FilmError {
    /// Whether another input would help, rather than another machine or another try.
    pub fn is_fault_of_input(&self) -> bool {
        match self {
            FilmError::Scene(_)
            | FilmError::NoSuchFrame { .. }
            | FilmError::NothingToCertify { .. }
            | FilmError::Mesh(_)
            | FilmError::Positions { .. }
            | FilmError::WithoutMp4 => true,
            FilmError::Field { .. } | FilmError::Stopped => false,
            FilmError::Disk(error) => error.is_fault_of_input(),
            FilmError::Render(error) => !matches!(error, RenderError::Write { .. }),
        }
    }

    /// A file that could not be read.
    pub(super) fn read(path: &std::path::Path, source: std::io::Error) -> FilmError {
        FilmError::Disk(DiskError::Io { path: path.to_owned(), action: "read", source })
    }

    /// A field that cannot be computed.
    pub(super) fn field(reason: impl std::fmt::Display) -> FilmError {
        FilmError::Field { reason: reason.to_string() }
    }

    /// A file that could not be written.
    pub(super) fn write(path: &std::path::Path, reason: impl std::fmt::Display) -> FilmError {
        FilmError::Render(RenderError::Write { path: path.to_owned(), reason: reason.to_string() })
    }
}

/// How many there are, in words.
fn obj_files(count: usize) -> &'static str {
    if count == 0 { "no OBJ file" } else { "only one OBJ file" }
}
