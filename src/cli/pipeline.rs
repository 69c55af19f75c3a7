//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use super::failure::PipelineError;
use super::progress::Stages;
use super::set_up::{SetUp, at_fault, contradictions, look_ahead};
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
/// Must not be called on a thread of a pool: pictures wait for frames here, and frames are computed there.
pub(super) fn run(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    simulating: &mut dyn Stages,
    picturing: &mut dyn Stages,
) -> Result<[Summary; 2], PipelineError> {
    let arrivals = Arrivals::default();
    let mut simulated = None;
    let pictured = rayon::in_place_scope(|scope| {
        scope.spawn(|_| {
            simulated = Some(simulate_for(scene, folder, false, &arrivals, simulating));
            arrivals.end();
        });
        let watch = &mut |event| pass_on(event, picturing);
        let made = film::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch);
        // Pictures may fail because no more frames come, but then frames failed first.
        made.map_err(|error| (arrivals.stop(), error))
    });
    match (simulated, pictured) {
        (Some(Err(error)), Ok(_) | Err((false, _))) => Err(error),
        (_, Err((_, error))) => Err(error.into()),
        (simulated, Ok(made)) => Ok([simulated.transpose()?.unwrap_or_default(), Summary { made, kept: 0 }]),
    }
}

/// Computes the frames that are not there yet.
pub(super) fn simulate(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    progress: &mut dyn Stages,
) -> Result<Summary, PipelineError> {
    // On a thread of the pool, where work in parallel begins and ends at less cost.
    let mut summary = None;
    rayon::scope(|_| summary = Some(simulate_for(scene, folder, restart, &Arrivals::default(), progress)));
    summary.transpose().map(Option::unwrap_or_default)
}

/// As [`simulate`], for pictures that are made meanwhile.
fn simulate_for(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    arrivals: &Arrivals,
    progress: &mut dyn Stages,
) -> Result<Summary, PipelineError> {
    progress.begin("set up", None);
    let mut set_up = SetUp::of(scene)?;
    Plan::of(scene)?; // nothing is computed for a picture that cannot be made
    look_ahead(scene, &mut set_up.simulation)?; // nor for a film that would end half way
    set_up.notes.iter().for_each(|note| progress.note(note));
    contradictions(scene, &set_up.simulation)?.iter().for_each(|warning| progress.note(warning));
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
    arrivals.reach(kept);
    for number in kept + 1..=scene.clock.frames {
        let mut watcher = Watcher { progress: &mut *progress, arrivals, phase: None };
        let frame = simulation.next_frame(&mut watcher).map_err(|error| at_fault(scene, error))?;
        film.write_frame(&frame)?;
        arrivals.reach(number);
    }
    Ok(Summary { made: scene.clock.frames - kept, kept })
}

/// Passes the progress of a relaxation on.
struct Watcher<'a> {
    progress: &'a mut dyn Stages,
    arrivals: &'a Arrivals,
    phase: Option<(usize, usize)>,
}

impl Observer for Watcher<'_> {
    fn after_step(&mut self, now: &evolve::Progress) -> ControlFlow<()> {
        let following = now.phase >= now.phases;
        let mut name =
            if following { format!("frame {}", now.frame) } else { format!("phase {}/{}", now.phase + 1, now.phases) };
        if now.components > 1 {
            name = format!("component {}/{}, {name}", now.component + 1, now.components);
        }
        if self.phase != Some((now.component, now.phase)) {
            self.phase = Some((now.component, now.phase));
            self.progress.begin(&name, Some(now.max_steps));
        }
        self.progress.advance(now.step, Some(now.l2_length_error));
        if self.arrivals.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Makes the pictures that the scene asks for of computed frames, given by number in order.
pub(super) fn render_frames(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    progress: &mut dyn Stages,
) -> Result<Summary, PipelineError> {
    let made = film::make_pictures(scene, folder, frames, &mut |event| pass_on(event, progress))?;
    Ok(Summary { made, kept: 0 })
}

/// Simulates a scene where it was not, and makes one picture that shows its film as a whole.
pub(super) fn poster(
    scene: &Scene,
    folder: &Path,
    path: &Path,
    progress: &mut dyn Stages,
) -> Result<(), PipelineError> {
    simulate(scene, folder, false, progress)?;
    Ok(film::make_poster(scene, folder, path, &mut |event| pass_on(event, progress))?)
}

/// Makes one picture of a simulated scene in all looks.
pub(super) fn look_sheet(
    scene: &Scene,
    folder: &Path,
    path: &Path,
    progress: &mut dyn Stages,
) -> Result<(), PipelineError> {
    Ok(film::make_look_sheet(scene, folder, path, &mut |event| pass_on(event, progress))?)
}

fn pass_on(event: film::Event, progress: &mut dyn Stages) {
    match event {
        film::Event::Begin(stage, parts) => progress.begin(stage, Some(parts)),
        film::Event::Done(done) => progress.advance(done, None),
        film::Event::Note(text) => progress.note(&text),
    }
}
