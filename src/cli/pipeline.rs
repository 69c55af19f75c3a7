//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use super::failure::PipelineError;
use super::preview::Preview;
use super::process::Session;
use super::progress::Log;
use super::results::ranges;
use super::set_up::{SetUp, at_fault, contradictions, frame_keys};
use crate::advice::Advice;
use crate::evolve::{self, Observer, Simulation};
use crate::film::{self, Arrivals, DiskError, FilmFolder, FilmSpec, Pictured, Plan};
use crate::polish::PolishStep;
use crate::scene::Scene;

/// What a command has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Frames made now.
    pub made: usize,
    /// Frames that were there and verified.
    pub kept: usize,
}

/// How the frames of a film are computed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Making {
    /// Anew, whatever is there.
    pub restart: bool,
    /// With a small picture of the newest one.
    pub preview: bool,
}

/// Computes the frames that are not there yet and makes pictures of some, given by number in order, at the same time.
/// Tells of both, in this order. If one fails the other ends; what is complete stays.
///
/// Pictures wait for frames on the thread that calls this, and frames are computed on those of the pool. Where this
/// thread is all there is of the pool, one is done after the other.
pub(super) fn run(
    scene: &Scene,
    folder: &Path,
    making: Making,
    frames: &[usize],
    session: &Session,
) -> Result<[Summary; 2], PipelineError> {
    if rayon::current_thread_index().is_some() {
        let simulated = simulate(scene, folder, making, session)?;
        return Ok([simulated, render_frames(scene, folder, frames, session)?]);
    }
    let arrivals = Arrivals::default().unless(session.signals.flag());
    let (simulated, pictured) = side_by_side(
        &arrivals,
        || simulate_for(scene, folder, making, &arrivals, &session.log),
        || {
            let watch = &mut |event| session.log.pictures(event);
            film::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch)
        },
    );
    match (simulated, pictured) {
        (Some(Err(error)), Ok(_) | Err((false, _))) => Err(error),
        (_, Err((_, error))) => Err(error.into()),
        (simulated, Ok(pictured)) => Ok([simulated.transpose()?.unwrap_or_default(), pictured.into()]),
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
    making: Making,
    session: &Session,
) -> Result<Summary, PipelineError> {
    let arrivals = Arrivals::default().unless(session.signals.flag());
    // On a thread of the pool, where work in parallel begins and ends at less cost.
    let mut summary = None;
    rayon::scope(|_| summary = Some(simulate_for(scene, folder, making, &arrivals, &session.log)));
    summary.transpose().map(Option::unwrap_or_default)
}

/// As [`simulate`], for pictures that are made meanwhile.
fn simulate_for(
    scene: &Scene,
    folder: &Path,
    Making { restart, preview }: Making,
    arrivals: &Arrivals,
    log: &Log,
) -> Result<Summary, PipelineError> {
    Plan::of(scene)?; // nothing is computed for a picture that cannot be made
    let unchanged = if restart { None } else { FilmFolder::open_unchanged(folder, scene)? };
    let (film, valid, mut ready) = match unchanged {
        Some(film) => {
            let valid = film.valid_frames()?;
            (film, valid, None)
        }
        None => {
            let (film, valid, set_up) = begin(scene, folder, restart, log)?;
            (film, valid, Some(set_up))
        }
    };
    let kept = valid.iter().filter(|&&valid| valid).count();
    log.begin_film(kept, valid.len());
    // Whoever makes pictures then knows at once how far the film goes.
    arrivals.reach(valid.iter().take_while(|&&valid| valid).count());
    let mut preview = Preview::begin(preview, scene, folder)?;
    for (number, valid) in (1..).zip(&valid) {
        if !valid {
            let SetUp { mut simulation, places, notes } = match ready.take() {
                Some(set_up) if set_up.simulation.last_frame() + 1 == number => set_up,
                _ => set_up_after(scene, &film, number - 1, log)?,
            };
            let mut watcher = Watcher { log, arrivals };
            let frame = simulation.next_frame(&mut watcher).map_err(|error| at_fault(scene, error))?;
            film.write_frame(&frame)?;
            log.frame_done(&frame.report);
            ready = Some(SetUp { simulation, places, notes });
        }
        arrivals.reach(number);
        // Of frames that are there already, the last one is enough.
        if !valid || number == scene.clock.frames {
            preview.iter_mut().try_for_each(|preview| preview.show(number))?;
        }
    }
    Ok(Summary { made: valid.len() - kept, kept })
}

/// Sets a film up and opens its folder. Gives per frame whether it is there, and says of a film that has changed which
/// frames are kept and why the others are not.
fn begin(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    log: &Log,
) -> Result<(FilmFolder, Vec<bool>, SetUp), PipelineError> {
    let mut set_up = set_up(scene, log)?;
    let keys = frame_keys(scene, &mut set_up.simulation)?;
    if restart {
        film::clear_film(folder)?;
    }
    let (spec, mesh) = (FilmSpec::of(scene, keys), set_up.film_mesh(scene));
    let (film, changes) = FilmFolder::open_or_create(folder, &spec, &mesh)?;
    let valid = film.valid_frames()?;
    if !changes.is_empty() {
        retime(&film, &valid, &set_up.simulation)?;
        let (kept, stale): (Vec<usize>, Vec<usize>) = (1..=valid.len()).partition(|&frame| valid[frame - 1]);
        let (kept, stale) = (frames_in_words(&kept), frames_in_words(&stale));
        let (folder, changes) = (folder.display(), in_words(&changes));
        log.note(format_args!("{folder}: {changes} changed since; {kept} kept, {stale} to be computed"));
    }
    Ok((film, valid, set_up))
}

/// Where time is but a label, frames that are kept get the one they have now.
fn retime(film: &FilmFolder, valid: &[bool], simulation: &Simulation) -> Result<(), PipelineError> {
    for (frame, _) in (1..).zip(valid).filter(|(_, valid)| **valid) {
        let time = simulation.clock().time(frame);
        if film.contents(frame)?.1.time != time {
            let mut frame = film.read_frame(frame)?;
            frame.report.time = time;
            film.write_frame(&frame)?;
        }
    }
    Ok(())
}

/// A simulation, with all that is worth saying of it said.
fn set_up(scene: &Scene, log: &Log) -> Result<SetUp, PipelineError> {
    log.setting_up();
    let set_up = SetUp::of(scene)?;
    set_up.notes.iter().for_each(|note| log.note(note));
    // A time without a metric is told when the keys of the frames are found.
    contradictions(scene, &set_up.simulation).iter().flatten().for_each(|warning| log.warning(warning));
    Ok(set_up)
}

/// A simulation that goes on after a frame of a film; after frame 0 it begins.
fn set_up_after(scene: &Scene, film: &FilmFolder, frame: usize, log: &Log) -> Result<SetUp, PipelineError> {
    let mut set_up = set_up(scene, log)?;
    if frame > 0 {
        set_up.simulation.resume(Arc::new(film.read_frame(frame)?)).map_err(|error| DiskError::Damaged {
            path: film.folder().to_owned(),
            reason: format!("the film cannot go on after frame {frame}: {}", error.reason()),
            remedy: "pass --restart to begin anew",
        })?;
    }
    Ok(set_up)
}

/// "frames 1-49, 52", or that there is none.
fn frames_in_words(frames: &[usize]) -> String {
    match frames {
        [] => "no frames".to_owned(),
        [frame] => format!("frame {frame}"),
        _ => format!("frames {}", ranges(frames)),
    }
}

/// "[metric] and [clock]"
fn in_words(changes: &[String]) -> String {
    match changes {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => changes.concat(),
    }
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

    fn after_polish_step(&mut self, now: &PolishStep) -> ControlFlow<()> {
        self.log.polish_step(now);
        if self.arrivals.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Makes sure that the folder holds the film of the scene, as far as it was computed: its frames are known by their keys. A
/// folder with an earlier version of the film is brought up to date, so that frames which are no longer of it are told.
fn is_of_scene(scene: &Scene, folder: &Path) -> Result<(), PipelineError> {
    if FilmFolder::open_unchanged(folder, scene)?.is_none() {
        let mut set_up = SetUp::of(scene)?;
        let keys = frame_keys(scene, &mut set_up.simulation)?;
        let (film, _) = FilmFolder::open_or_create(folder, &FilmSpec::of(scene, keys), &set_up.film_mesh(scene))?;
        retime(&film, &film.valid_frames()?, &set_up.simulation)?;
    }
    Ok(())
}

/// Makes the pictures that the scene asks for of computed frames, given by number in order. There must be a film.
pub(super) fn render_frames(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    session: &Session,
) -> Result<Summary, PipelineError> {
    is_of_scene(scene, folder)?;
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    Ok(film::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch)?.into())
}

/// As [`render_frames`], beside others that do the same with other frames. The film is left as it is: it must be the one of the
/// scene already.
pub(super) fn render_beside_others(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    session: &Session,
) -> Result<Summary, PipelineError> {
    if !FilmFolder::open(folder)?.manifest().is_of(scene) {
        return Err(DiskError::Changed { path: folder.to_owned() }.into());
    }
    let arrivals = Arrivals::over().unless(session.signals.flag());
    let watch = &mut |event| session.log.pictures(event);
    Ok(film::make_stills_beside_others(scene, folder, frames, &arrivals, watch)?.into())
}

/// Simulates a scene where it was not, and makes one picture that shows its film as a whole.
pub(super) fn poster(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    path: &Path,
    session: &Session,
) -> Result<(), PipelineError> {
    simulate(scene, folder, Making { restart, preview: false }, session)?;
    Ok(film::make_poster(scene, folder, path, &mut |event| session.log.pictures(event))?)
}

/// Makes one picture of a simulated scene in all looks.
pub(super) fn look_sheet(scene: &Scene, folder: &Path, path: &Path, session: &Session) -> Result<(), PipelineError> {
    Ok(film::make_look_sheet(scene, folder, path, &mut |event| session.log.pictures(event))?)
}

impl From<Pictured> for Summary {
    fn from(Pictured { made, kept }: Pictured) -> Summary {
        Summary { made, kept }
    }
}

#[cfg(test)]
mod tests;
