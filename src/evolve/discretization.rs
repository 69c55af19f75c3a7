//! What a metric and a class determine: the shell, the Poisson problem and the periods.

use crate::algebra::CholeskyError;
use crate::frames::Shell;
use crate::immersion::{Periods, Poisson};
use crate::mesh::{Mesh, VertexId};
use crate::metric::Metric;
use crate::spin::{Homology, SpinStructure};

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
    ) -> Result<(Discretization, R), CholeskyError> {
        // A factorization keeps but one processor busy.
        let shell = || {
            let shell = Shell::new(mesh, metric, spin, bending_angles);
            let beside = beside(&shell);
            (shell, beside)
        };
        let ((shell, beside), poisson) = rayon::join(shell, || Poisson::new(mesh, metric, pinned));
        let poisson = poisson?;
        // Periods are those of the surface without its pins.
        let separate = !pinned.is_empty() && homology.betti() > 0;
        let free = if separate { Some(Poisson::new(mesh, metric, &[])?) } else { None };
        let periods = Periods::new(mesh, metric, homology, free.as_ref().unwrap_or(&poisson));
        Ok((Discretization { shell, poisson, periods }, beside))
    }
}
