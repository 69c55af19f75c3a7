//! Why a surface does not get over a pass.

use crate::algebra::CholeskyError;
use crate::metric::MetricError;

/// Why there is no way over a pass.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PassError {
    /// On the way from the lengths of the halfway model to those that are asked for.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A linear system.
    #[error(transparent)]
    Linear(#[from] CholeskyError),
    /// The shell got stuck before it was the surface that is asked for.
    #[error("the surface got stuck at a length error of {:.2} %", 100.0 * .l2_length_error)]
    Stuck {
        /// L2 length error there.
        l2_length_error: f64,
    },
    /// Whoever watches said so.
    #[error("stopped after {steps} steps")]
    Stopped {
        /// Steps taken.
        steps: usize,
    },
}
