//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use super::check::contradictions;
use super::progress::Progress;
use crate::advice::Advice;
use crate::cache::{Cache, CacheError, Film};
use crate::evolve::{self, EvolveError, Observer, Simulation};
use crate::movie::{self, Arrivals, MovieError, Plan};
use crate::scene::{Scene, SceneError, SceneErrors, clock_of};

/// Why a command did not do what it should.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The scene file cannot be read, or has mistakes, or what it names is at fault.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// The simulation ended without a frame.
    #[error(transparent)]
    Evolve(#[from] EvolveError),
    /// The folder of the film is at fault.
    #[error(transparent)]
    Cache(#[from] CacheError),
    /// Pictures cannot be made.
    #[error(transparent)]
    Movie(MovieError),
}

impl From<MovieError> for PipelineError {
    fn from(error: MovieError) -> Self {
        match error {
            MovieError::Scene(errors) => PipelineError::Scene(errors),
            other => PipelineError::Movie(other),
        }
    }
}

impl From<SceneError> for PipelineError {
    fn from(mistake: SceneError) -> Self {
        PipelineError::Scene(SceneErrors::Mistakes(vec![mistake]))
    }
}

impl PipelineError {
    /// Whether another input would help, rather than another machine or another try.
    pub fn is_fault_of_input(&self) -> bool {
        match self {
            PipelineError::Scene(_) => true,
            PipelineError::Cache(error) => !matches!(error, CacheError::Io { .. } | CacheError::Unfit { .. }),
            PipelineError::Movie(error) => error.is_fault_of_input(),
            PipelineError::Evolve(_) => false,
        }
    }
}

/// What a command has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Frames made now.
    pub made: usize,
    /// Frames that were there and verified.
    pub kept: usize,
}

/// A simulation, and what was known of its surface before.
pub(super) struct SetUp {
    pub simulation: Simulation,
    /// What x, y and z of each vertex mean in the scene, |V|: positions or coordinates of the mesh, if it has any.
    pub places: Option<Vec<DVec3>>,
    /// What had to be repaired in the mesh, and what else is worth saying.
    pub notes: Vec<String>,
}

impl SetUp {
    /// Of a scene; what is at fault is shown where the scene names it.
    pub fn of(scene: &Scene) -> Result<SetUp, PipelineError> {
        let surface = scene.surface()?;
        let places = surface.places().map(<[DVec3]>::to_vec);
        let mut notes = surface.repairs.clone();
        let simulation = scene.simulation_of(surface)?;
        let of_metric = simulation.metric_program().notes();
        notes.extend(of_metric.into_iter().map(|(change, note)| format!("metric.change[{change}]: {note}")));
        Ok(SetUp { simulation, places, notes })
    }
}

/// Counts the classes of a scene that has a frame for each of them, so that everybody knows how many frames there are.
pub(super) fn count_classes(scene: &mut Scene) -> Result<(), PipelineError> {
    if scene.clock.a_frame_for_each_class {
        scene.clock = clock_of(scene, &scene.surface()?.mesh)?;
    }
    Ok(())
}

/// An error of a running simulation, shown where the scene names what is at fault, if it does.
pub(super) fn at_fault(scene: &Scene, error: EvolveError) -> PipelineError {
    match scene.fault(&error) {
        Some(mistake) => mistake.into(),
        None => error.into(),
    }
}

/// Computes the frames that are not there yet and makes pictures of some, given by number in order, at the same time.
/// Tells of both, in this order. If one fails the other ends; what is complete stays.
///
/// Must not be called on a thread of a pool: pictures wait for frames here, and frames are computed there.
pub(super) fn run(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    simulating: &mut dyn Progress,
    picturing: &mut dyn Progress,
) -> Result<[Summary; 2], PipelineError> {
    let arrivals = Arrivals::default();
    let mut simulated = None;
    let pictured = rayon::in_place_scope(|scope| {
        scope.spawn(|_| {
            simulated = Some(simulate_for(scene, folder, false, &arrivals, simulating));
            arrivals.end();
        });
        let watch = &mut |event| pass_on(event, picturing);
        let made = movie::make_pictures_of_arrivals(scene, folder, frames, &arrivals, watch);
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
    progress: &mut dyn Progress,
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
    progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    progress.begin("set up", None);
    let SetUp { mut simulation, places, notes } = SetUp::of(scene)?;
    Plan::of(scene)?; // nothing is computed for a picture that cannot be made
    notes.iter().for_each(|note| progress.note(note));
    // A time without a metric is told when its frame is made.
    contradictions(scene, &simulation).iter().flatten().for_each(|warning| progress.note(warning));
    let film = Film::of(scene);
    let (mesh, places) = (simulation.mesh().clone(), places.as_deref());
    let cache = if restart {
        Cache::restart(folder, &film, &mesh, places)?
    } else {
        Cache::open_or_create(folder, &film, &mesh, places)?
    };
    let kept = cache.last_valid_frame()?.unwrap_or(0);
    if kept > 0 {
        simulation.resume(Arc::new(cache.read_frame(kept)?)).map_err(|error| {
            let reason = format!("the film cannot go on after it: {}", error.reason());
            CacheError::Damaged {
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
        cache.write_frame(&frame)?;
        arrivals.reach(number);
    }
    Ok(Summary { made: scene.clock.frames - kept, kept })
}

/// Passes the progress of a relaxation on.
struct Watcher<'a> {
    progress: &'a mut dyn Progress,
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
    progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    let made = movie::make_pictures(scene, folder, frames, &mut |event| pass_on(event, progress))?;
    Ok(Summary { made, kept: 0 })
}

/// Simulates a scene where it was not, and makes one picture that shows its film as a whole.
pub(super) fn poster(
    scene: &Scene,
    folder: &Path,
    path: &Path,
    progress: &mut dyn Progress,
) -> Result<(), PipelineError> {
    simulate(scene, folder, false, progress)?;
    Ok(movie::make_poster(scene, folder, path, &mut |event| pass_on(event, progress))?)
}

/// Makes one picture of a simulated scene in all looks.
pub(super) fn look_sheet(
    scene: &Scene,
    folder: &Path,
    path: &Path,
    progress: &mut dyn Progress,
) -> Result<(), PipelineError> {
    Ok(movie::make_look_sheet(scene, folder, path, &mut |event| pass_on(event, progress))?)
}

fn pass_on(event: movie::Event, progress: &mut dyn Progress) {
    match event {
        movie::Event::Begin(stage, parts) => progress.begin(stage, Some(parts)),
        movie::Event::Done(done) => progress.advance(done, None),
        movie::Event::Note(text) => progress.note(&text),
    }
}
