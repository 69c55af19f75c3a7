//! One frame for each class: how many there are, and which one a frame shows.

use super::SetupError;
use crate::mesh::Mesh;
use crate::scene::{ClockSection, Scene, SpinSection};

/// The clock of a scene on its mesh, which says how many classes there are where each has a frame.
///
/// # Errors
/// [`SetupError::TooManyClasses`], [`SetupError::MoreFramesThanClasses`]
pub fn clock_of(scene: &Scene, mesh: &Mesh) -> Result<ClockSection, SetupError> {
    let ClockSection { frames, a_frame_for_each_class, .. } = scene.clock;
    if scene.spin != SpinSection::All {
        return Ok(scene.clock);
    }
    let betti = mesh.betti();
    let classes = u32::try_from(betti).ok().and_then(|betti| 1_usize.checked_shl(betti));
    match classes {
        Some(classes) if a_frame_for_each_class && classes <= ClockSection::MOST_FRAMES => {
            Ok(ClockSection { frames: classes, a_frame_for_each_class: false, ..scene.clock })
        }
        _ if a_frame_for_each_class => Err(SetupError::TooManyClasses { betti }),
        Some(classes) if frames > classes => Err(SetupError::MoreFramesThanClasses { frames, betti }),
        _ => Ok(scene.clock),
    }
}

/// The binary digit of a number at a place, 0 beyond all that it has.
pub(super) fn digit(number: usize, place: usize) -> bool {
    u32::try_from(place).ok().and_then(|place| number.checked_shr(place)).is_some_and(|rest| rest & 1 == 1)
}
