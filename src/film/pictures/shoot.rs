//! Pictures of frames, made in parallel and taken in order.

use std::ops::Range;

use rayon::prelude::*;

use super::keys::Contents;
use super::passes::{Frames, Reel, Survey, at_a_time, in_order, picture_bytes};
use super::plan::Plan;
use super::shots::Shots;
use super::subject::Beside;
use crate::digest::Key;
use crate::film::error::FilmError;
use crate::render::{Metadata, Output, Picture};

/// The frame that a picture is of.
pub(super) struct Shown {
    pub number: usize,
    pub metadata: Metadata,
    /// Of the picture, without layers and with them.
    pub key: Key,
    pub key_of_layers: Key,
    /// Of the state of the frame.
    pub state: Key,
}

/// Pictures that are next.
struct Wave<T> {
    first: usize,
    /// Those that are to be made, and those beside them that they take.
    frames: Frames,
    shown: Vec<(Shown, Option<T>)>,
}

/// Takes pictures of frames in parallel. `kept` gives what was made of one before; of all others `finish` makes what is
/// kept. `take` gets that in order, with the number of the frame, and how many triangles were left out if it was made now.
pub(super) fn shoot<T: Clone + Send + Sync>(
    plan: &Plan,
    Survey { reel, subject, extent, spreads }: &mut Survey,
    frames: &[usize],
    output: &Output,
    kept: impl Fn(&Shown) -> Option<T> + Sync,
    finish: impl Fn(&Picture, &Shown) -> Result<T, FilmError> + Sync,
    mut take: impl FnMut(usize, Option<usize>, T) -> Result<(), FilmError> + Send,
) -> Result<(), FilmError> {
    let shots = Shots::new(plan, subject, extent, spreads, *output)?;
    let of_film = shots.key_of_film(reel.film())?;
    let at_a_time = at_a_time(picture_bytes(plan, output) + reel.frame_bytes());
    let go_on = reel.watch();
    let prepare = |wave: Range<usize>| {
        let here = &frames[wave.clone()];
        reel.wait_for(&with_neighbours(plan, here))?;
        let show = |&number: &usize| {
            let contents = contents(plan, reel, number)?;
            let key = shots.key(of_film, &contents);
            let key_of_layers = shots.key_of_layers(key, &contents);
            let (state, report) = contents.here;
            let shown = Shown { number, metadata: shots.metadata(&report), key, key_of_layers, state };
            let made = kept(&shown);
            Ok::<_, FilmError>((shown, made))
        };
        let shown = here.par_iter().map(show).collect::<Result<Vec<_>, _>>()?;
        let to_make: Vec<usize> =
            shown.iter().filter(|(_, made)| made.is_none()).map(|(shown, _)| shown.number).collect();
        Ok(Wave { first: wave.start, frames: reel.load(&with_neighbours(plan, &to_make))?, shown })
    };
    let make = |Wave { first, frames: loaded, shown }: &Wave<T>, index: usize| {
        let (shown, made) = &shown[index - first];
        if let Some(made) = made {
            return Ok((shown.number, None, made.clone()));
        }
        go_on()?;
        let other = |number: Option<usize>| number.and_then(|number| loaded.get(&number)).map(AsRef::as_ref);
        let beside = Beside { before: other(plan.before(shown.number)), next: other(after(plan, shown.number)) };
        let picture = shots.take(&loaded[&shown.number], beside)?;
        go_on()?;
        Ok((shown.number, Some(picture.skipped_triangles()), finish(&picture, shown)?))
    };
    in_order(frames.len(), at_a_time, prepare, make, |(frame, skipped, kept)| take(frame, skipped, kept))
}

/// The keys of the pictures of some frames, when all of them are there.
pub(super) fn keys_of(
    plan: &Plan,
    Survey { reel, subject, extent, spreads }: &Survey,
    frames: &[usize],
    output: &Output,
) -> Result<Vec<Key>, FilmError> {
    let shots = Shots::new(plan, subject, extent, spreads, *output)?;
    let of_film = shots.key_of_film(reel.film())?;
    reel.wait_for(&with_neighbours(plan, frames))?;
    frames.par_iter().map(|&frame| Ok(shots.key(of_film, &contents(plan, reel, frame)?))).collect()
}

fn contents(plan: &Plan, reel: &Reel, frame: usize) -> Result<Contents, FilmError> {
    let here = reel.contents(frame)?;
    let state = |other: Option<usize>| {
        let contents = other.map(|other| reel.contents(other)).transpose()?;
        Ok::<_, FilmError>(contents.map(|(state, _)| state))
    };
    Ok(Contents { here, before: state(plan.before(frame))?, next: state(after(plan, frame))? })
}

/// The frame that a picture takes beside its own.
fn after(plan: &Plan, frame: usize) -> Option<usize> {
    if plan.looks_ahead() { plan.after(frame) } else { None }
}

/// Frames and those beside them that their pictures take, in order, each once.
fn with_neighbours(plan: &Plan, frames: &[usize]) -> Vec<usize> {
    let beside = |&frame: &usize| [plan.before(frame), Some(frame), after(plan, frame)];
    let mut wanted: Vec<usize> = frames.iter().flat_map(beside).flatten().collect();
    wanted.sort_unstable();
    wanted.dedup();
    wanted
}
