//! One picture of a film: in memory, or a small one of its newest frame.

use std::path::Path;

use super::passes::{Arrivals, Watch, metadata, survey};
use super::plan::Plan;
use super::sheets::{SMALL, scaled};
use super::shoot::shoot;
use crate::film::error::FilmError;
use crate::render::Picture;
use crate::scene::Scene;
use crate::whole_file;

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

/// The small picture of the newest frame of a film.
pub(in crate::film) const PREVIEW: &str = "preview.png";
/// Its longest side.
const PREVIEW_SIDE: usize = 480;

/// Writes a small picture of a computed frame into the folder of its film, as it looks while later frames are not known.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn make_preview(scene: &Scene, folder: &Path, frame: usize) -> Result<(), FilmError> {
    let path = folder.join(PREVIEW);
    let png = small_picture(scene, folder, frame, PREVIEW_SIDE)?;
    whole_file::write(&path, &png).map_err(|error| FilmError::write(&path, error))
}

/// A picture of a computed frame with this longest side, as the bytes of a PNG file.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub(in crate::film) fn small_picture(
    scene: &Scene,
    folder: &Path,
    frame: usize,
    side: usize,
) -> Result<Vec<u8>, FilmError> {
    let mut small = scene.clone();
    (small.output.size, small.output.crop) = (scaled(scene.output.size, side), None);
    // A shutter that is open until the next frame would wait for it.
    small.camera.shutter = 0.0;
    let picture = take_picture(&small, folder, frame, &mut |_| ())?;
    Ok(picture.to_png(SMALL, &metadata(&Plan::of(&small)?))?)
}
