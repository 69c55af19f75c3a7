//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use super::failure::PipelineError;
use super::process::Session;
use super::progress::Log;
use super::set_up::{SetUp, at_fault, contradictions};
use crate::advice::Advice;
use crate::evolve::{self, Observer};
use crate::film::{self, Arrivals, DiskError, FilmFolder, FilmSpec, Plan};
use crate::scene::Scene;

/// What a command has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Frames made now.
    pub made: usize,
    /// Frames that were there and verified.
    pub kept: usize,
}

/// Computes the frames that are not there yet and makes pictures of some, given by number in order, at the same time.
/// Tells of both, in this order. If one fails the other ends; what is complete stays.
///
/// Pictures wait for frames on the thread that calls this, and frames are computed on those of the pool. Where this
/// thread is all there is of the pool, one is done after the other.
pub(super) fn run(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    frames: &[usize],
    session: &Session,
) -> Result<[Summary; 2], PipelineError> {
    if rayon::current_thread_index().is_some() {
        let simulated = simulate(scene, folder, restart, session)?;
        return Ok([simulated, render_frames(scene, folder, frames, session)?]);
    }
    let arrivals = Arrivals::default().unless(session.signals.flag());
    let (simulated, pictured) = side_by_side(
        &arrivals,
        || simulate_for(scene, folder, restart, &arrivals, &session.log),
        || {
            let watch = &mut |event| session.log.pictures(event);
            film::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch)
        },
    );
    match (simulated, pictured) {
        (Some(Err(error)), Ok(_) | Err((false, _))) => Err(error),
        (_, Err((_, error))) => Err(error.into()),
        (simulated, Ok(made)) => Ok([simulated.transpose()?.unwrap_or_default(), Summary { made, kept: 0 }]),
    }
}

/// Supplies arrivals on a thread of the pool and takes them on this one. If one of the two fails or panics the other
/// does not wait for it. An error of the one who takes comes with whether more would have arrived: otherwise the
/// supply failed first.
fn side_by_side<S: Send, T, E>(
    arrivals: &Arrivals,
    supply: impl FnOnce() -> S + Send,
    take: impl FnOnce() -> Result<T, E>,
) -> (Option<S>, Result<T, (bool, E)>) {
    let mut supplied = None;
    let taken = rayon::in_place_scope(|scope| {
        scope.spawn(|_| {
            let _ends = arrivals.supply();
            supplied = Some(supply());
        });
        let _stops = arrivals.demand();
        take().map_err(|error| (arrivals.stop(), error))
    });
    (supplied, taken)
}

/// Computes the frames that are not there yet.
pub(super) fn simulate(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    session: &Session,
) -> Result<Summary, PipelineError> {
    let arrivals = Arrivals::default().unless(session.signals.flag());
    // On a thread of the pool, where work in parallel begins and ends at less cost.
    let mut summary = None;
    rayon::scope(|_| summary = Some(simulate_for(scene, folder, restart, &arrivals, &session.log)));
    summary.transpose().map(Option::unwrap_or_default)
}

/// As [`simulate`], for pictures that are made meanwhile.
fn simulate_for(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    arrivals: &Arrivals,
    log: &Log,
) -> Result<Summary, PipelineError> {
    log.setting_up();
    let set_up = SetUp::of(scene)?;
    Plan::of(scene)?; // nothing is computed for a picture that cannot be made
    set_up.notes.iter().for_each(|note| log.note(note));
    // A time without a metric is told when its frame is made.
    contradictions(scene, &set_up.simulation).iter().flatten().for_each(|warning| log.warning(warning));
    let (spec, mesh) = (FilmSpec::of(scene), set_up.film_mesh(scene));
    let mut simulation = set_up.simulation;
    let film = if restart {
        FilmFolder::restart(folder, &spec, &mesh)?
    } else {
        FilmFolder::open_or_create(folder, &spec, &mesh)?
    };
    let kept = film.last_valid_frame()?.unwrap_or(0);
    if kept > 0 {
        simulation.resume(Arc::new(film.read_frame(kept)?)).map_err(|error| {
            let reason = format!("the film cannot go on after it: {}", error.reason());
            DiskError::Damaged {
                path: folder.to_owned(),
                reason,
                remedy: "pass --restart to `immerse simulate` to begin anew",
            }
        })?;
    }
    log.begin_film(kept, scene.clock.frames);
    arrivals.reach(kept);
    for number in kept + 1..=scene.clock.frames {
        let mut watcher = Watcher { log, arrivals };
        let frame = simulation.next_frame(&mut watcher).map_err(|error| at_fault(scene, error))?;
        film.write_frame(&frame)?;
        log.frame_done(&frame.report);
        arrivals.reach(number);
    }
    Ok(Summary { made: scene.clock.frames - kept, kept })
}

/// Passes the progress of a relaxation on.
struct Watcher<'a> {
    log: &'a Log,
    arrivals: &'a Arrivals,
}

impl Observer for Watcher<'_> {
    fn after_step(&mut self, now: &evolve::Progress) -> ControlFlow<()> {
        self.log.step(now);
        if self.arrivals.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Makes the pictures that the scene asks for of computed frames, given by number in order.
pub(super) fn render_frames(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    session: &Session,
) -> Result<Summary, PipelineError> {
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    let made = film::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch)?;
    Ok(Summary { made, kept: 0 })
}

/// Simulates a scene where it was not, and makes one picture that shows its film as a whole.
pub(super) fn poster(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    path: &Path,
    session: &Session,
) -> Result<(), PipelineError> {
    simulate(scene, folder, restart, session)?;
    Ok(film::make_poster(scene, folder, path, &mut |event| session.log.pictures(event))?)
}

/// Makes one picture of a simulated scene in all looks.
pub(super) fn look_sheet(scene: &Scene, folder: &Path, path: &Path, session: &Session) -> Result<(), PipelineError> {
    Ok(film::make_look_sheet(scene, folder, path, &mut |event| session.log.pictures(event))?)
}

#[cfg(test)]
mod tests;
