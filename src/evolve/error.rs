//! Why a simulation cannot start or ends early.

use super::PhaseError;
use crate::algebra::CholeskyError;
use crate::immersion::{BendingError, PinError, StartError};
use crate::metric::MetricError;
use crate::scene::{AtKey, ClockSection, SceneError};
use crate::spin::SpinError;
use crate::timeline::TimelineError;

/// Why a scene does not describe a simulation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// The surface, and where the scene names it.
    #[error(transparent)]
    Surface(#[from] SceneError),
    /// A parameter.
    #[error("{}", .0.error)]
    Parameter(#[from] AtKey<TimelineError>),
    /// Its lengths.
    #[error("{}", .0.error)]
    Metric(#[from] AtKey<MetricError>),
    /// Its class.
    #[error(transparent)]
    Spin(#[from] SpinError),
    /// Its pins.
    #[error("{}", .0.error)]
    Pin(#[from] AtKey<PinError>),
    /// What it starts from.
    #[error("{}", .0.error)]
    Start(#[from] AtKey<StartError>),
    /// Its target bending angles.
    #[error("{}", .0.error)]
    Bending(#[from] AtKey<BendingError>),
    /// Its phases.
    #[error("{}", .0.error)]
    Phase(#[from] AtKey<PhaseError>),
    /// `class = "all"` with too many frames.
    #[error(
        "there are {frames} frames for the classes of {betti} generators, one each; lower `frames` to 2 to the power \
         of {betti}"
    )]
    MoreFramesThanClasses {
        /// What the clock says.
        frames: usize,
        /// Number of generators.
        betti: usize,
    },
    /// `class = "all"` with more classes than there can be frames.
    #[error(
        "there are 2 to the power of {betti} classes, and a film has at most {most} frames; write `frames` under [clock] \
         for the first so many of them",
        most = ClockSection::MOST_FRAMES
    )]
    TooManyClasses {
        /// Number of generators.
        betti: usize,
    },
    /// The Poisson problem.
    #[error("{0}; even out the edge lengths, the weights differ by too many orders of magnitude")]
    Poisson(#[from] CholeskyError),
}

impl SetupError {
    /// The key of the scene file that is at fault.
    pub fn key(&self) -> &str {
        match self {
            SetupError::Surface(_) => "mesh",
            SetupError::Poisson(_) => "metric",
            SetupError::MoreFramesThanClasses { .. } => "clock.frames",
            SetupError::Spin(_) | SetupError::TooManyClasses { .. } => "spin.class",
            SetupError::Parameter(at) => &at.key,
            SetupError::Metric(at) => &at.key,
            SetupError::Pin(at) => &at.key,
            SetupError::Start(at) => &at.key,
            SetupError::Bending(at) => &at.key,
            SetupError::Phase(at) => &at.key,
        }
    }
}

/// Why a running simulation ended without a frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
    /// The class to begin.
    #[error(transparent)]
    Spin(#[from] SpinError),
    /// The scene gives no metric.
    #[error("at time {time}: {}", error.error)]
    Metric {
        /// When.
        time: f64,
        /// Why, and which key of the scene says so.
        error: AtKey<MetricError>,
    },
    /// The scene gives no places for its pins.
    #[error("{}", .0.error)]
    Pin(#[from] AtKey<PinError>),
    /// The scene gives no target bending angles.
    #[error("{}", .0.error)]
    Bending(#[from] AtKey<BendingError>),
    /// The Poisson problem.
    #[error("at time {time}: {error}; even out the edge lengths, the weights differ by too many orders of magnitude")]
    Poisson {
        /// When.
        time: f64,
        /// Why.
        error: CholeskyError,
    },
    /// A vertex star became figure-8.
    #[error(
        "at time {time} rounding has changed the spin structure at vertex {vertex}; lower `max_strain` under [clock], \
         or use better triangles there"
    )]
    StarChanged {
        /// When.
        time: f64,
        /// Where.
        vertex: usize,
    },
    /// The class is another.
    #[error(
        "at time {time} rounding has changed the class from {before} to {after}; lower `max_strain` under [clock], or \
         use better triangles"
    )]
    ClassChanged {
        /// When.
        time: f64,
        /// q on every generator,
        before: String,
        /// and now.
        after: String,
    },
}

impl EvolveError {
    /// The key of the scene file that is at fault, if any is.
    pub fn key(&self) -> Option<&str> {
        match self {
            EvolveError::Metric { error, .. } => Some(&error.key),
            EvolveError::Pin(error) => Some(&error.key),
            EvolveError::Bending(error) => Some(&error.key),
            _ => None,
        }
    }
}
