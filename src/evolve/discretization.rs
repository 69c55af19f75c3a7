//! What a metric and a class determine: the shell, the Poisson problem and the periods.

use crate::algebra::CholeskyError;
use crate::frames::{Shell, ShellError};
use crate::immersion::{Periods, Poisson};
use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use crate::spin::{Homology, SpinStructure};

/// Why there is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum DiscretizationError {
    #[error(transparent)]
    Shell(#[from] ShellError),
    #[error(transparent)]
    Poisson(#[from] CholeskyError),
}

/// Made anew whenever the lengths change.
#[derive(Debug)]
pub(super) struct Discretization {
    pub shell: Shell,
    pub poisson: Poisson,
    pub periods: Periods,
}

impl Discretization {
    /// With what `beside` makes of the shell meanwhile.
    pub fn new<R: Send>(
        mesh: &Mesh,
        metric: &Metric,
        spin: &SpinStructure,
        homology: &Homology,
        bending_angles: Option<&[f64]>,
        pinned: &[VertexId],
        beside: impl FnOnce(&Shell) -> R + Send,
    ) -> Result<(Discretization, R), DiscretizationError> {
        // A factorization keeps but one processor busy.
        let shell = || {
            let shell = Shell::new(mesh, metric, spin, bending_angles)?;
            let beside = beside(&shell);
            Ok::<_, ShellError>((shell, beside))
        };
        let (shell, poisson) = rayon::join(shell, || Poisson::new(mesh, metric, pinned));
        let ((shell, beside), poisson) = (shell?, poisson?);
        // Periods are those of the surface without its pins.
        let separate = !pinned.is_empty() && homology.betti() > 0;
        let free = if separate { Some(Poisson::new(mesh, metric, &[])?) } else { None };
        let periods = Periods::new(mesh, metric, homology, free.as_ref().unwrap_or(&poisson));
        Ok((Discretization { shell, poisson, periods }, beside))
    }
}
