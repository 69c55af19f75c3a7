//! A film is passed over before pictures of it are made.

use std::path::Path;

use super::arrivals::Arrivals;
use super::event::{Event, Watch};
use super::memory::at_a_time;
use super::reel::{Passed, Reel};
use crate::film::error::FilmError;
use crate::film::pictures::plan::Plan;
use crate::film::pictures::quantities::Spreads;
use crate::film::pictures::subject::Subject;
use crate::render::{Extent, Metadata};
use crate::scene::Framed;

/// A film that was passed over once.
pub(in crate::film::pictures) struct Survey<'a> {
    pub reel: Reel<'a>,
    pub subject: Subject,
    pub extent: Extent,
    pub spreads: Spreads,
}

/// Passes over all frames, or the first one if nothing depends on the others, and makes sure that the wanted ones are
/// there if it comes by them.
pub(in crate::film::pictures) fn survey<'a>(
    plan: &Plan,
    folder: &Path,
    frames: &[usize],
    arrivals: &'a Arrivals,
    watch: &mut Watch,
) -> Result<Survey<'a>, FilmError> {
    let reel = Reel::open(folder, arrivals)?;
    let subject = Subject::of(plan, reel.film())?;
    let depends_on_all = plan.scene.camera.framed == Framed::Film || subject.spreads_matter(plan);
    let count = if depends_on_all { reel.film().manifest().frame_count } else { 1 };
    watch(Event::Begin("camera", count));
    let at_a_time = at_a_time(reel.frame_bytes());
    let passed = reel.pass(plan, &subject, count, at_a_time, |frame| watch(Event::Done(frame)))?;
    let Passed { frames: ready, ended_by, extent, spreads } = passed;
    match ended_by {
        Some(error) if frames.iter().any(|&frame| frame > ready) => Err(error),
        _ => Ok(Survey { reel, subject, extent, spreads }),
    }
}

/// What a file that shows the whole film says of itself.
pub(in crate::film::pictures) fn metadata(plan: &Plan) -> Metadata {
    Metadata { scene: plan.scene.name.clone(), ..Metadata::default() }
}
