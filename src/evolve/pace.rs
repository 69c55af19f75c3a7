//! How a film passes from frame to frame.

use super::relax::Phase;
use crate::advice::Advice;
use crate::mesh::shapes::FigureEight;
use crate::tuning::{HALVINGS_OF_A_PART, HALVINGS_OF_STEPS};

/// What happens between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// Another class, relaxed from the start.
    EachClass,
    /// So many steps of the relaxation.
    Steps(usize),
    /// The metric moves on, and the surface follows until it has settled.
    Settle(Settling),
    /// The film begins in the middle, on a halfway model, and goes down both ways: first frames are one half backwards.
    BothWays(OverAPass),
}

/// A way over a pass, see [`Pace::BothWays`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OverAPass {
    /// The halfway model.
    pub halfway: HalfwayModel,
    /// Weight of bending of the shell; strain of an edge weighs 1.
    pub stiffness: f64,
}

/// Whether something may fold on the way from one frame of a film to the next, on which vertices move on straight lines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fold {
    /// Whatever may.
    #[default]
    Allow,
    /// Nothing: a frame that no regular homotopy leads to is made again in smaller steps, and ends the film if that does not help.
    Refuse,
}

impl Fold {
    /// How often the way to a frame is halved before the film is given up.
    pub(super) fn halvings(self, pace: Pace) -> usize {
        match (self, pace) {
            (Fold::Allow, _) | (Fold::Refuse, Pace::EachClass | Pace::BothWays(_)) => 0,
            (Fold::Refuse, Pace::Steps(_)) => HALVINGS_OF_STEPS,
            (Fold::Refuse, Pace::Settle(_)) => HALVINGS_OF_A_PART,
        }
    }
}

/// What stands on the pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HalfwayModel {
    /// A sphere with so many lobes, see [`crate::mesh::shapes::Halfway`].
    Sphere {
        /// Lobes.
        lobes: usize,
    },
    /// A torus.
    Torus(FigureEight),
}

impl Default for Pace {
    fn default() -> Pace {
        Pace::Settle(Settling::default())
    }
}

/// When a frame that follows a change has settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    tolerance_radians: f64,
    max_steps: usize,
    max_strain: f64,
}

/// Why frames could not settle.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("`{name}` is {value}; {}", self.remedy())]
pub struct PaceError {
    /// Which number.
    pub name: &'static str,
    /// What it is.
    pub value: f64,
}

impl Advice for PaceError {
    fn remedy(&self) -> String {
        "give a number above 0".into()
    }
}

impl Settling {
    /// A frame has settled when its face frames turn by less than `tolerance_radians` per step on average, or after
    /// `max_steps`. No edge changes its length by more than the share `max_strain` at once; where a frame brings more, it
    /// is reached in several parts.
    ///
    /// # Errors
    /// [`PaceError`] unless all three are above 0.
    pub fn new(tolerance_radians: f64, max_steps: usize, max_strain: f64) -> Result<Settling, PaceError> {
        let numbers = [("tolerance", tolerance_radians), ("max_steps", max_steps as f64), ("max_strain", max_strain)];
        match numbers.into_iter().find(|(_, value)| value.is_nan() || *value <= 0.0) {
            Some((name, value)) => Err(PaceError { name, value }),
            None => Ok(Settling { tolerance_radians, max_steps, max_strain }),
        }
    }

    /// The mean turn per step in radians below which a frame has settled.
    pub fn tolerance_radians(&self) -> f64 {
        self.tolerance_radians
    }

    /// The largest number of steps of a frame.
    pub fn max_steps(&self) -> usize {
        self.max_steps
    }

    /// The largest share by which a length changes at once.
    pub fn max_strain(&self) -> f64 {
        self.max_strain
    }

    /// The last phase of a relaxation, until the frame has settled.
    pub(super) fn phase(&self, phases: &[Phase]) -> Phase {
        let last = phases.last().copied().unwrap_or_default();
        Phase { tolerance_radians: self.tolerance_radians, max_steps: self.max_steps, untangle_steps: 0, ..last }
    }
}

impl Default for Settling {
    /// 0.005 degrees, 100 steps, 5 percent.
    fn default() -> Settling {
        Settling { tolerance_radians: 0.005_f64.to_radians(), max_steps: 100, max_strain: 0.05 }
    }
}
