//! Pictures of frames, made in parallel and taken in order.

use super::passes::{Frames, Survey, at_a_time, in_order, picture_bytes};
use super::plan::Plan;
use super::shots::Shots;
use crate::film::error::FilmError;
use crate::render::{Metadata, Output, Picture};

/// The frame that a picture is of.
pub(super) struct Shown {
    pub number: usize,
    pub metadata: Metadata,
}

/// Takes pictures of frames in parallel; `finish` makes of each what is kept, and `take` gets that in order, with the
/// number of the frame and how many triangles were left out.
pub(super) fn shoot<T: Send>(
    plan: &Plan,
    Survey { reel, subject, extent, spreads }: &mut Survey,
    frames: &[usize],
    output: &Output,
    finish: impl Fn(&Picture, &Shown) -> Result<T, FilmError> + Sync,
    mut take: impl FnMut(usize, usize, T) -> Result<(), FilmError> + Send,
) -> Result<(), FilmError> {
    let shots = Shots::new(plan, subject, extent, spreads, *output)?;
    let after = |frame: usize| if plan.looks_ahead() { plan.after(frame) } else { None };
    let at_a_time = at_a_time(picture_bytes(plan, output) + reel.frame_bytes());
    let go_on = reel.watch();
    let load = |wave: std::ops::Range<usize>| {
        let here = &frames[wave];
        let mut wanted: Vec<usize> =
            here.iter().copied().chain(here.iter().filter_map(|&frame| after(frame))).collect();
        wanted.sort_unstable();
        wanted.dedup();
        reel.load(&wanted)
    };
    let make = |loaded: &Frames, index: usize| {
        go_on()?;
        let number = frames[index];
        let frame = &loaded[&number];
        let next = after(number).and_then(|next| loaded.get(&next));
        let picture = shots.take(frame, next.map(AsRef::as_ref))?;
        go_on()?;
        let shown = Shown { number, metadata: shots.metadata(frame) };
        Ok((number, picture.skipped_triangles(), finish(&picture, &shown)?))
    };
    in_order(frames.len(), at_a_time, load, make, |(frame, skipped, kept)| take(frame, skipped, kept))
}
