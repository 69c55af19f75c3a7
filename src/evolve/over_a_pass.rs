//! Films that begin in their middle: a halfway model, and the way down from it on either side.

use super::error::EvolveError;
use super::pace::OverAPass;
use super::progress::Observer;
use crate::advice::Advice;
use crate::immersion::Halfway;
use crate::mesh::Mesh;
use crate::metric::Metric;
use crate::polish::{NoSymmetry, Pass, PassError, SideExchange};
use glam::DVec3;

/// Why a surface has no way over a pass.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoPass {
    /// It is no sphere, or several.
    #[error("a film of both ways is about one sphere, and this surface is none; {}", self.remedy())]
    NoSphere,
    /// It is known by its lengths alone.
    #[error("a film of both ways is about a sphere around the origin, and the mesh has no positions; {}", self.remedy())]
    NoPositions,
    /// The halfway model has a symmetry that its mesh has not.
    #[error("{}; {}", .0, self.remedy())]
    Asymmetric(#[from] NoSymmetry),
}

impl Advice for NoPass {
    fn remedy(&self) -> String {
        "write shape = \"octasphere\" under [mesh], with `sides` twice the `lobes` of the start".into()
    }
}

impl OverAPass {
    /// The pass of a sphere with these positions, |V|.
    pub(super) fn on(&self, mesh: &Mesh, positions: Option<&[DVec3]>) -> Result<Pass, NoPass> {
        if mesh.euler_characteristic() != 2 || mesh.components().len() != 1 {
            return Err(NoPass::NoSphere);
        }
        let sphere = positions.ok_or(NoPass::NoPositions)?;
        let at = |time: f64| Halfway { lobes: self.lobes, time }.of_sphere(sphere);
        let aside = at(BESIDE).iter().zip(at(-BESIDE)).map(|(ahead, behind)| *ahead - behind).collect();
        let exchange = SideExchange::of_sphere(sphere, self.lobes)?;
        Ok(Pass { halfway: at(0.0), aside, exchange, stiffness: self.stiffness })
    }
}

/// All frames of a film over a pass, each |V|.
pub(super) fn film_of(
    pass: &Pass,
    mesh: &Mesh,
    metric: &Metric,
    (frames, time): (usize, f64),
    observer: &mut dyn Observer,
) -> Result<Vec<Vec<DVec3>>, EvolveError> {
    pass.frames(mesh, metric, frames, &mut |step| observer.after_polish_step(step)).map_err(|error| match error {
        PassError::Stopped { steps } => EvolveError::Stopped { steps },
        error => EvolveError::Pass { time, error },
    })
}

/// The time of surfaces beside a halfway model that say which way leads off it.
const BESIDE: f64 = 0.01;
