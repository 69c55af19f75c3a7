//! Files that show a film as a whole: contact sheets, posters, a picture in all looks.

use std::path::Path;

use super::passes::{Arrivals, Event, Survey, Watch, metadata, survey};
use super::plan::Plan;
use super::sheet::{Sheet, evenly};
use super::shoot::shoot;
use crate::film::error::FilmError;
use crate::render::{LookName, Metadata, Output, Picture, Png};
use crate::scene::{LookSection, Scene};

/// Pixels across of a contact sheet, about.
pub(super) const SHEET_WIDTH: usize = 1920;
/// Frames on the sheet of a film that stands in a gallery.
const POSTER_FRAMES: usize = 12;
/// Longest side of a still that stands in a gallery.
const POSTER_SIDE: usize = 1200;

/// Makes one small file that shows a film as a whole: its only frame, or a contact sheet.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn make_poster(scene: &Scene, folder: &Path, path: &Path, watch: &mut Watch) -> Result<(), FilmError> {
    let plan = Plan::of(scene)?;
    let frames: Vec<usize> = (1..=scene.clock.frames).collect();
    let arrivals = Arrivals::over();
    let mut survey = survey(&plan, folder, &frames, &arrivals, watch)?;
    let count = if scene.output.sheet > 0 { scene.output.sheet } else { POSTER_FRAMES };
    let chosen = evenly(&frames, count, plan.clock.is_looping());
    let still = scaled(plan.size(), POSTER_SIDE);
    let sheet =
        if chosen.len() == 1 { Sheet::of(1, still, 0) } else { Sheet::of(chosen.len(), plan.size(), SHEET_WIDTH) };
    let film = contact_sheet(&plan, &mut survey, &chosen, sheet, watch)?;
    let png = Png { small: true, ..Png::default() };
    Ok(film.write_png(path, png, &metadata(&plan, &survey))?)
}

/// Makes one small file that shows the last frame of a film in all the looks that have a name.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn make_look_sheet(scene: &Scene, folder: &Path, path: &Path, watch: &mut Watch) -> Result<(), FilmError> {
    let last = [scene.clock.frames];
    let mut whole: Option<(Picture, Sheet)> = None;
    for (index, (_, preset)) in LookName::ALL.into_iter().enumerate() {
        let scene = Scene { look: LookSection { preset, ..LookSection::default() }, ..scene.clone() };
        let plan = Plan::of(&scene)?;
        let arrivals = Arrivals::over();
        let mut survey = survey(&plan, folder, &last, &arrivals, watch)?;
        let (film, sheet) = whole.get_or_insert_with(|| {
            let sheet = Sheet::of(LookName::ALL.len(), plan.size(), SHEET_WIDTH);
            let [width, height] = sheet.size();
            (Picture::blank(width, height, plan.look.background[0]), sheet)
        });
        let picture = contact_sheet(&plan, &mut survey, &last, Sheet::of(1, sheet.tile, 0), watch)?;
        film.paste(&picture, sheet.place(index));
    }
    let png = Png { small: true, ..Png::default() };
    let metadata = Metadata { scene: scene.name.clone(), ..Metadata::default() };
    whole.map_or(Ok(()), |(film, _)| Ok(film.write_png(path, png, &metadata)?))
}

/// Small pictures of some frames on one.
pub(super) fn contact_sheet(
    plan: &Plan,
    survey: &mut Survey,
    frames: &[usize],
    sheet: Sheet,
    watch: &mut Watch,
) -> Result<Picture, FilmError> {
    watch(Event::Begin("sheet", frames.len()));
    let [width, height] = sheet.size();
    let mut whole = Picture::blank(width, height, plan.look.background[0]);
    let mut done = 0;
    let output = Output::new(sheet.tile[0], sheet.tile[1], plan.output.samples())?;
    shoot(
        plan,
        survey,
        frames,
        &output,
        |picture, _| Ok(picture.clone()),
        |_, _, picture| {
            whole.paste(&picture, sheet.place(done));
            done += 1;
            watch(Event::Done(done));
            Ok(())
        },
    )?;
    Ok(whole)
}

/// A size of the same shape with this longest side, or less if it was smaller.
pub(super) fn scaled([width, height]: [usize; 2], longest: usize) -> [usize; 2] {
    let share = (longest as f64 / width.max(height) as f64).min(1.0);
    [width, height].map(|side| ((side as f64 * share).round() as usize).max(1))
}
