//! Why a command failed, and whose fault it is.

use std::io;
use std::path::PathBuf;

use super::arguments::FrameRangeError;
use crate::evolve::EvolveError;
use crate::film::{DiskError, FilmError};
use crate::scene::{SceneError, SceneErrors};
use crate::text::clipped;

/// Why a command did not do what it should.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The scene file cannot be read, or has mistakes, or what it names is at fault.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The simulation ended without a frame.
    #[error(transparent)]
    Evolve(#[from] EvolveError),
    /// The folder of the film is at fault.
    #[error(transparent)]
    Disk(#[from] DiskError),
    /// Pictures cannot be made.
    #[error(transparent)]
    Film(FilmError),
}

impl From<FilmError> for PipelineError {
    fn from(error: FilmError) -> Self {
        match error {
            FilmError::Scene(errors) => PipelineError::Scene(errors),
            other => PipelineError::Film(other),
        }
    }
}

impl From<SceneError> for PipelineError {
    fn from(mistake: SceneError) -> Self {
        PipelineError::Scene(SceneErrors::Mistakes(vec![mistake]))
    }
}

impl PipelineError {
    /// Whether another input would help, rather than another machine or another try.
    pub fn is_fault_of_input(&self) -> bool {
        match self {
            PipelineError::Scene(_) => true,
            PipelineError::Disk(error) => error.is_fault_of_input(),
            PipelineError::Film(error) => error.is_fault_of_input(),
            PipelineError::Evolve(_) => false,
        }
    }
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
    #[error("--frames: {0}")]
    Frames(#[from] FrameRangeError),
    #[error("standard output cannot be written ({0}); check where it goes")]
    Output(#[from] io::Error),
    #[error("{}: cannot be written ({source}); choose another name or folder", path.display())]
    New { path: PathBuf, source: io::Error },
    #[error("there is no recipe `{}`; {remedy}", clipped(kind))]
    Recipe { kind: String, remedy: String },
    #[error("{}: this folder cannot be used ({source}); name another one, or go where it is", path.display())]
    Folder { path: PathBuf, source: io::Error },
    #[error("there cannot be that many threads ({0}); ask for fewer with --threads")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error("{}: this name gives no folder of its own; name one with --out, or call the file otherwise", path.display())]
    Name { path: PathBuf },
    #[error("--set: {0} runs are more than a sweep has; name fewer values")]
    Sweep(usize),
    #[error("job files cannot be written: {0}")]
    Farm(String),
    /// By a signal.
    #[error("interrupted by signal {signal}; run it again")]
    Interrupted { signal: u8 },
    #[error(
        "this program has a fault and cannot go on ({reason}); what is complete is kept, please report this with the scene"
    )]
    Panic { reason: String },
    /// Has been said already.
    #[error("not all is well")]
    NotWell,
}

/// Failed while running, or a check does not hold.
const FAILED: u8 = 1;
/// The input is at fault.
const INPUT: u8 = 2;
/// Somebody else is at work there; `EX_TEMPFAIL` of `sysexits.h`.
const TRY_AGAIN: u8 = 75;
/// What shells add to the number of a signal.
const SIGNAL: u8 = 128;

impl Failure {
    /// The exit code of the program.
    pub fn code(&self) -> u8 {
        match self {
            Failure::Pipeline(PipelineError::Disk(DiskError::Busy { .. })) => TRY_AGAIN,
            Failure::Pipeline(error) if error.is_fault_of_input() => INPUT,
            Failure::Pipeline(_) | Failure::Output(_) | Failure::Panic { .. } | Failure::NotWell => FAILED,
            Failure::Frames(_)
            | Failure::New { .. }
            | Failure::Recipe { .. }
            | Failure::Folder { .. }
            | Failure::Name { .. }
            | Failure::Sweep(_)
            | Failure::Farm(_)
            | Failure::Threads(_) => INPUT,
            Failure::Interrupted { signal } => SIGNAL + signal,
        }
    }
}
