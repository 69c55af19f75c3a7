//! One picture of a film, in memory.

use std::path::Path;

use super::passes::{Arrivals, Watch, survey};
use super::plan::Plan;
use super::shoot::shoot;
use crate::film::error::FilmError;
use crate::render::Picture;
use crate::scene::Scene;

/// Takes the picture of a computed frame as a scene asks for it. Nothing is written; what
/// [`make_pictures`](crate::film::make_pictures) writes as PNG has the same pixels.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn take_picture(scene: &Scene, folder: &Path, frame: usize, watch: &mut Watch) -> Result<Picture, FilmError> {
    let plan = Plan::of(scene)?;
    let arrivals = Arrivals::over();
    let mut survey = survey(&plan, folder, &[frame], &arrivals, watch)?;
    let mut taken = None;
    shoot(
        &plan,
        &mut survey,
        &[frame],
        &plan.output,
        |_| None,
        |picture, _| Ok(picture.clone()),
        |_, _, picture| {
            taken = Some(picture);
            Ok(())
        },
    )?;
    taken.ok_or_else(|| FilmError::NoSuchFrame { folder: folder.to_owned(), frame })
}
