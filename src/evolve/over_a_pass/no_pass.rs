//! Why a surface cannot be the end of a film over a pass.

use crate::advice::Advice;
use crate::polish::NoSymmetry;

/// Why a surface has no way over a pass.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NoPass {
    /// It is no sphere, or several.
    #[error("a film of both ways is about one sphere, and this surface is none; {}", self.remedy())]
    NoSphere,
    /// It is known by its lengths alone.
    #[error("a film of both ways is about a sphere around the origin, and the mesh has no positions; {}", self.remedy())]
    NoPositions,
    /// It is no torus, or several.
    #[error("a figure eight that turns in its plane sweeps one torus, and this surface is none; {}", self.remedy())]
    NoTorus,
    /// The halfway model has a symmetry that its mesh has not.
    #[error("{}; {}", .0, self.remedy())]
    AsymmetricSphere(NoSymmetry),
    /// The same, of a torus.
    #[error("{}; {}", .0, self.remedy())]
    AsymmetricTorus(NoSymmetry),
}

impl Advice for NoPass {
    fn remedy(&self) -> String {
        match self {
            NoPass::NoSphere | NoPass::NoPositions | NoPass::AsymmetricSphere(_) => {
                "write shape = \"octasphere\" under [mesh], with `sides` twice the `lobes` of the start".into()
            }
            NoPass::NoTorus | NoPass::AsymmetricTorus(_) => {
                "write shape = \"flat_torus\" or shape = \"torus\" under [mesh]".into()
            }
        }
    }
}
