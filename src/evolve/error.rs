//! Why a simulation cannot start or ends early.

use crate::algebra::CholeskyError;
use crate::immersion::PinError;
use crate::mesh::MeshError;
use crate::metric::MetricError;
use crate::spin::SpinError;

/// Why a scene does not describe a simulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// The surface.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Its lengths.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// Its class.
    #[error(transparent)]
    Spin(#[from] SpinError),
    /// Its pins.
    #[error(transparent)]
    Pin(#[from] PinError),
    /// The Poisson problem.
    #[error("{0}; even out the edge lengths, the weights differ by too many orders of magnitude")]
    Poisson(#[from] CholeskyError),
    /// A start from positions that do not exist.
    #[error(
        "the frames are to start from positions, but the mesh has none; write `random = 0` or use a mesh that has them"
    )]
    StartWithoutPositions,
    /// Bending angles of positions that do not exist.
    #[error(
        "bending angles are to come from positions, but the mesh has none; leave [bending] out or use a mesh that has them"
    )]
    BendingWithoutPositions,
}

impl SetupError {
    /// The key of the scene file that is at fault.
    pub fn key(&self) -> &'static str {
        match self {
            SetupError::Mesh(_) => "mesh",
            SetupError::Metric(_) | SetupError::Poisson(_) => "metric",
            SetupError::Spin(_) => "spin.class",
            SetupError::Pin(_) => "pin",
            SetupError::StartWithoutPositions => "start.from",
            SetupError::BendingWithoutPositions => "bending.from",
        }
    }
}

/// Why a running simulation ended without a frame.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EvolveError {
    /// The observer said so.
    #[error("stopped after {steps} steps; run again to resume at the last finished frame")]
    Stopped {
        /// Steps taken.
        steps: usize,
    },
    /// Frames became NaN.
    #[error("frames are no longer finite after {steps} steps of phase {phase}; lower `dt` of that phase")]
    Diverged {
        /// Steps taken.
        steps: usize,
        /// Phase, from 0.
        phase: usize,
    },
}
