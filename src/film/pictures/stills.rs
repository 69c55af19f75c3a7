//! Stills and moving pictures of the frames of a film.

use std::path::Path;

use super::passes::{Arrivals, Event, Survey, Watch, metadata, survey};
use super::plan::Plan;
use super::sheet::{Sheet, evenly};
use super::sheets::{SHEET_WIDTH, contact_sheet, scaled};
use super::shoot::{Shown, shoot};
use crate::film::animation::{Animation, Palette, Reeling, begin};
use crate::film::error::FilmError;
use crate::render::{Output, Picture};
use crate::scene::{AnimationFormat, Scene};

/// Frames from which the colours of a GIF are taken, and their longest side.
const PALETTE_FRAMES: usize = 8;
const PALETTE_SIDE: usize = 320;

/// Makes the pictures that a scene asks for, of computed frames given by number in order, in the folder of its film:
/// `000001.png`, `000001.exr`, `film.gif`, `film.apng`, `film.mp4`, `sheet.png`. Returns how many frames were made.
///
/// # Errors
/// [`FilmError`]; pictures that are finished stay, and none is left unfinished.
pub fn make_pictures(scene: &Scene, folder: &Path, frames: &[usize], watch: &mut Watch) -> Result<usize, FilmError> {
    make_pictures_of_arrivals(scene, folder, frames, &Arrivals::over(), watch)
}

/// As [`make_pictures`], of frames that are still being computed: each is passed over, and pictures of it are made, as
/// soon as it is there and the camera and all that holds for the whole film are known.
///
/// # Errors
/// As [`make_pictures`], and [`FilmError::NoSuchFrame`] if no more frames come.
pub fn make_pictures_of_arrivals(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    arrivals: &Arrivals,
    watch: &mut Watch,
) -> Result<usize, FilmError> {
    let plan = Plan::of(scene)?;
    let mut survey = survey(&plan, folder, frames, arrivals, watch)?;
    if plan.png.is_some() || plan.output.has_layers() || !scene.output.animation.is_empty() {
        film(&plan, &mut survey, folder, frames, watch)?;
    }
    if scene.output.sheet > 0 {
        let chosen = evenly(frames, scene.output.sheet, plan.clock.is_looping());
        let sheet = Sheet::of(chosen.len(), plan.size(), SHEET_WIDTH);
        let film = contact_sheet(&plan, &mut survey, &chosen, sheet, watch)?;
        film.write_png(&folder.join("sheet.png"), plan.png.unwrap_or_default(), &metadata(&plan, &survey))?;
    }
    Ok(frames.len())
}

/// Stills and moving pictures.
fn film(plan: &Plan, survey: &mut Survey, folder: &Path, frames: &[usize], watch: &mut Watch) -> Result<(), FilmError> {
    let output = &plan.scene.output;
    let [_, _, width, height] = plan.output.window();
    let scene_hash = survey.subject.scene_hash();
    let reeling = Reeling { width, height, frames: frames.len(), rate: output.frame_rate, scene_hash };
    plan.notes().into_iter().for_each(|note| watch(Event::Note(note)));
    let palette = match output.animation.contains(&AnimationFormat::Gif) {
        true => palette(plan, survey, frames, watch)?,
        false => Palette::default(),
    };
    let mut animations: Vec<Box<dyn Animation>> =
        output.animation.iter().map(|&format| begin(format, folder, reeling, &palette)).collect::<Result<_, _>>()?;
    let moving = !animations.is_empty();

    watch(Event::Begin("render", frames.len()));
    let mut done = 0;
    let finish = |picture: &Picture, shown: &Shown| -> Result<Option<Vec<u8>>, FilmError> {
        let name = folder.join(format!("{:06}", shown.number));
        if let Some(png) = plan.png {
            picture.write_png(&name.with_extension("png"), png, &shown.metadata)?;
        }
        if plan.output.has_layers() {
            picture.write_exr(&name.with_extension("exr"), &shown.metadata)?;
        }
        Ok(moving.then(|| picture.srgb_bytes()))
    };
    shoot(plan, survey, frames, &plan.output, finish, |frame, skipped, pixels| {
        if skipped > 0 {
            watch(Event::Note(format!("frame {frame}: {skipped} triangles have no area and are not drawn")));
        }
        if let Some(pixels) = pixels {
            animations.iter_mut().try_for_each(|animation| animation.push(&pixels))?;
        }
        done += 1;
        watch(Event::Done(done));
        Ok(())
    })?;
    animations.into_iter().try_for_each(|animation| animation.finish())
}

/// The colours of a GIF, from small pictures of some frames.
fn palette(plan: &Plan, survey: &mut Survey, frames: &[usize], watch: &mut Watch) -> Result<Palette, FilmError> {
    let chosen = evenly(frames, PALETTE_FRAMES, plan.clock.is_looping());
    watch(Event::Begin("colours", chosen.len()));
    let [width, height] = scaled(plan.size(), PALETTE_SIDE);
    let output = Output::new(width, height, plan.output.samples())?;
    let background = Picture::blank(1, 1, plan.look.background[0]).srgb_bytes();
    let mut pixels = Vec::new();
    let mut done = 0;
    shoot(
        plan,
        survey,
        &chosen,
        &output,
        |picture, _| Ok(picture.srgb_bytes()),
        |_, _, bytes| {
            pixels.extend(bytes);
            done += 1;
            watch(Event::Done(done));
            Ok(())
        },
    )?;
    Ok(Palette::of(&pixels, [background[0], background[1], background[2]]))
}
