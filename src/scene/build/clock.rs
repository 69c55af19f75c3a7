//! `[clock]` as times and pace, and how many frames there are when each class has one.

use crate::evolve::{Fold, HalfwayModel, OverAPass, Pace, Settling};
use crate::mesh::Mesh;
use crate::scene::{ClockSection, Scene, SceneError, SpinSection, StartFrom};
use crate::timeline::Clock;
use crate::tuning::{STEPS_PER_FRAME, STIFFNESS_OVER_A_PASS};

/// The clock of a scene on its mesh, which says how many classes there are where each has a frame.
///
/// # Errors
/// If there are more classes than there can be frames, or more frames than classes.
pub fn clock_of(scene: &Scene, mesh: &Mesh) -> Result<ClockSection, SceneError> {
    let ClockSection { frames, a_frame_for_each_class, .. } = scene.clock;
    if scene.spin != SpinSection::All {
        return Ok(scene.clock);
    }
    let betti = mesh.betti();
    let classes = u32::try_from(betti).ok().and_then(|betti| 1_usize.checked_shl(betti));
    match classes {
        Some(classes) if a_frame_for_each_class && classes <= Clock::MOST_FRAMES => {
            Ok(ClockSection { frames: classes, a_frame_for_each_class: false, ..scene.clock })
        }
        _ if a_frame_for_each_class => Err(scene.complain(
            "spin.class",
            format!(
                "there are 2 to the power of {betti} classes, and a film has at most {} frames",
                Clock::MOST_FRAMES
            ),
            "write `frames` under [clock] for the first so many of them",
        )),
        Some(classes) if frames > classes => Err(scene.complain(
            "clock.frames",
            format!("there are {frames} frames for the classes of {betti} generators, one each"),
            format!("lower `frames` to 2 to the power of {betti}"),
        )),
        _ => Ok(scene.clock),
    }
}

impl Scene {
    /// The times of the frames, with as many of them as the section says.
    ///
    /// # Errors
    /// At the key that is at fault.
    pub fn times(&self, section: &ClockSection) -> Result<Clock, SceneError> {
        let ClockSection { frames, start, end, looping, .. } = *section;
        Clock::new(frames, [start, end], looping).map_err(|error| self.complain_about("clock", &error))
    }

    /// What a film of both ways starts on.
    ///
    /// # Errors
    /// At `both_ways` if the scene asks for what goes with frames of faces alone.
    fn both_ways(&self, changes: bool) -> Result<Pace, SceneError> {
        let fault = |reason: &str, remedy: &str| Err(self.complain("clock.both_ways", reason, remedy));
        let halfway = match self.start.from {
            StartFrom::Halfway(lobes) => HalfwayModel::Sphere { lobes },
            StartFrom::FigureEight => HalfwayModel::Torus(self.figure_eight()?),
            _ => {
                let remedy = "write `halfway = 2` or, of a torus, from = \"figure eight\" under [start]";
                return fault("a film of both ways begins on a halfway model", remedy);
            }
        };
        let is_plain = self.start.formula.is_none() && self.start.noise.is_none() && self.bending.is_none();
        if changes || !is_plain || !self.pins.is_empty() || !self.phases.is_empty() {
            let reason = "a film of both ways has a metric that stays, and neither pins, phases, target bending angles, nor a start that is moved";
            return fault(reason, "remove them");
        }
        let stiffness = self.relaxation.bending_stiffness.unwrap_or(STIFFNESS_OVER_A_PASS);
        Ok(Pace::BothWays(OverAPass { halfway, stiffness }))
    }

    /// What happens between two frames; `changes` is whether anything changes with time.
    pub(super) fn pace(&self, section: &ClockSection, changes: bool) -> Result<Pace, SceneError> {
        if self.spin == SpinSection::All && section.fold == Fold::Refuse {
            return Err(self.complain(
                "clock.fold",
                "each class has a frame of its own, and no regular homotopy leads from one to the next",
                "remove `fold`",
            ));
        }
        Ok(match section.steps_per_frame {
            _ if section.both_ways => self.both_ways(changes)?,
            _ if self.spin == SpinSection::All => Pace::EachClass,
            Some(steps) if section.frames > 1 => Pace::Steps(steps),
            None if section.frames > 1 && !changes => Pace::Steps(STEPS_PER_FRAME),
            _ => Pace::Settle(
                Settling::new(section.tolerance.to_radians(), section.max_steps, section.max_strain)
                    .map_err(|error| self.complain_about(&format!("clock.{}", error.name), &error))?,
            ),
        })
    }
}
