//! Files that show a film as a whole: contact sheets, posters, a picture in all looks.

use std::path::Path;

use super::passes::{Arrivals, Event, Survey, Watch, metadata, survey};
use super::plan::Plan;
use super::sheet::{Sheet, evenly};
use super::shoot::{keys_of, shoot};
use crate::digest::{Digest, Key};
use crate::film::error::FilmError;
use crate::film::ledger::Ledger;
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
    let key = key_of_sheet(&plan, &survey, &chosen, sheet, SMALL)?;
    make_unless_fresh(folder, path, key, || contact_sheet(&plan, &mut survey, &chosen, sheet, watch), &metadata(&plan))
}

/// Makes one small file that shows the last frame of a film in all the looks that have a name.
///
/// # Errors
/// As [`make_pictures`](crate::film::make_pictures).
pub fn make_look_sheet(scene: &Scene, folder: &Path, path: &Path, watch: &mut Watch) -> Result<(), FilmError> {
    let last = [scene.clock.frames];
    let in_look = |(_, preset)| Scene { look: LookSection { preset, ..LookSection::default() }, ..scene.clone() };
    let scenes: Vec<Scene> = LookName::ALL.into_iter().map(in_look).collect();
    let plans = scenes.iter().map(Plan::of).collect::<Result<Vec<_>, _>>()?;
    let arrivals = Arrivals::over();
    let mut surveys = Vec::new();
    for plan in &plans {
        surveys.push(survey(plan, folder, &last, &arrivals, watch)?);
    }
    let Some(first) = plans.first() else { return Ok(()) };
    let sheet = Sheet::of(plans.len(), first.size(), SHEET_WIDTH);
    let tile = Sheet::of(1, sheet.tile, 0);
    let mut digest = Digest::of("looks").shown(&sheet);
    for (plan, survey) in plans.iter().zip(&surveys) {
        digest = digest.key(key_of_sheet(plan, survey, &last, tile, SMALL)?);
    }
    let make = || {
        let [width, height] = sheet.size();
        let mut whole = Picture::blank(width, height, first.look.background[0]);
        for (index, (plan, survey)) in plans.iter().zip(&mut surveys).enumerate() {
            whole.paste(&contact_sheet(plan, survey, &last, tile, watch)?, sheet.place(index));
        }
        Ok(whole)
    };
    make_unless_fresh(folder, path, digest.finish(), make, &metadata(first))
}

/// Makes a file beside a film, if it is not there or made of something else.
fn make_unless_fresh(
    folder: &Path,
    path: &Path,
    key: Key,
    make: impl FnOnce() -> Result<Picture, FilmError>,
    metadata: &Metadata,
) -> Result<(), FilmError> {
    let ledger = Ledger::open(folder)?;
    let name = std::path::absolute(path).map_err(|error| FilmError::write(path, error))?;
    let name = name.to_string_lossy();
    if ledger.fresh(&name, key).is_none() {
        make()?.write_png(path, SMALL, metadata)?;
        ledger.enter(&name, key, key)?;
    }
    ledger.close()
}

/// How files are written that stand in a gallery.
pub(super) const SMALL: Png = Png { sixteen_bits: false, small: true };

/// The key of a contact sheet.
pub(super) fn key_of_sheet(
    plan: &Plan,
    survey: &Survey,
    frames: &[usize],
    sheet: Sheet,
    png: Png,
) -> Result<Key, FilmError> {
    let output = Output::new(sheet.tile[0], sheet.tile[1], plan.output.samples())?;
    let digest = Digest::of("sheet").shown(&sheet).shown(&png).shown(&plan.look.background[0]);
    Ok(keys_of(plan, survey, frames, &output)?.into_iter().fold(digest, Digest::key).finish())
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
        |_| None,
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
