//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use super::Progress;
use super::diagnostics::say;
use super::selections::selection_notes;
use crate::algebra::Complex;
use crate::cache::{Cache, CacheError, Film, FrameState};
use crate::evolve::{self, Checkpoint, EvolveError, Observer, SetupError, Simulation, clock_of, phase_sections};
use crate::mesh::{longest_loops, outer_loops};
use crate::movie::{self, Arrivals, MovieError, Plan};
use crate::scene::{Scene, SceneError, SceneErrors, SpinSection};
use crate::spin::{SpinError, SpinStructure, class_digits};

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

/// Validates everything the scene names, without writing. Returns what is worth saying: sizes, generators, repairs.
pub(super) fn check(scene: &Scene) -> Result<Vec<String>, PipelineError> {
    let mut simulation = set_up(scene)?;
    simulation.check_all_times().map_err(|error| at_fault(scene, error))?;
    contradictions(scene, &simulation)?.iter().for_each(say);
    let plan = Plan::of(scene)?;
    let [width, height] = plan.size();
    let mesh = &simulation.mesh;
    let mut notes = vec![format!(
        "{} vertices, {} edges, {} faces, genus {}, {} boundary loops, {} components",
        mesh.vertex_count(),
        mesh.edge_count(),
        mesh.face_count(),
        mesh.genus(),
        mesh.boundary_loops().len(),
        mesh.components().len()
    )];
    if scene.spin == SpinSection::All {
        let frames = clock_of(scene, mesh).map_or(1, |clock| clock.frames);
        let betti = mesh.betti();
        let which = if betti < 20 && frames == 1 << betti { "each of" } else { "the first of" };
        notes.push(format!("{frames} frames, one for {which} the 2^{betti} classes"));
    }
    let class = simulation.spin().class(mesh, &simulation.metric, &simulation.homology);
    for (k, (generator, q)) in simulation.homology.generators().iter().zip(class).enumerate() {
        notes.push(format!(
            "generator {} of length {:.4} through {} faces: q = {}",
            k + 1,
            generator.length,
            generator.strip.exits().len(),
            u8::from(q)
        ));
    }
    let (loops, places) = (mesh.boundary_loops(), simulation.mesh_places.as_deref());
    let (outer, longest) = (outer_loops(mesh, places), longest_loops(mesh, places));
    for (k, cycle) in loops.iter().enumerate() {
        let length: f64 = cycle.iter().map(|&h| simulation.metric.length(mesh.edge(h))).sum();
        let names = if loops.len() == 1 { String::new() } else { names_of_loop(k, &outer, &longest) };
        notes.push(format!("boundary loop {k} of length {length:.4} with {} vertices{names}", cycle.len()));
    }
    notes.extend(selection_notes(scene, mesh, places));
    notes.extend(simulation.class_of_start().map(|start| start_and_target(start, &simulation)));
    notes.extend(simulation.repairs.iter().cloned());
    notes.push(format!("pictures of {width} x {height} pixels"));
    notes.extend(plan.notes());
    Ok(notes)
}

/// What a boundary loop is called beside its number.
fn names_of_loop(k: usize, outer: &[usize], longest: &[usize]) -> String {
    match (outer.contains(&k), longest.contains(&k)) {
        (true, true) => " (outer, longest)".to_owned(),
        (true, false) => " (outer)".to_owned(),
        (false, true) => " (longest)".to_owned(),
        (false, false) => String::new(),
    }
}

/// Warnings about pins that no surface with these lengths can keep.
fn contradictions(scene: &Scene, simulation: &Simulation) -> Result<Vec<String>, PipelineError> {
    let found = simulation.pin_contradictions().map_err(|error| at_fault(scene, error))?;
    Ok(found.into_iter().map(|sentence| format!("warning: {sentence}")).collect())
}

/// The phases of a scene as they can be pasted into one, where they replace the default ones and change nothing.
pub(super) fn phases(scene: &Scene) -> Result<String, PipelineError> {
    let simulation = set_up(scene)?;
    let phases = phase_sections(scene, simulation.mesh.face_count())
        .map_err(|error| complaint(scene, &error.key, &error.error.to_string()))?;
    let count = phases.len();
    let mut text = format!("# The {count} phases of {}.", scene.name);
    if scene.clock.frames > 1 {
        text += " Frames that follow in a film take the last one, with the tolerance and\n# max_steps of [clock].";
    }
    text.push('\n');
    for (k, phase) in phases.iter().enumerate() {
        text += &format!("\n# phase {} of {count}\n{phase}", k + 1);
    }
    Ok(text)
}

/// Whether what frames start from and what they go to are in one class. A film cannot pass from one to another.
fn start_and_target(start: Result<Vec<bool>, SpinError>, simulation: &Simulation) -> String {
    let target = simulation.spin().class(&simulation.mesh, &simulation.metric, &simulation.homology);
    match start {
        Ok(start) if start != target => format!(
            "start and target are not in one class: the start is in {}, the target in {}, so rims or pinch points will \
             stay; write class = {:?}, or start from another shape",
            class_digits(&start),
            class_digits(&target),
            class_digits(&start)
        ),
        Ok(_) if target.is_empty() => "start and target are in one class, there is no other".to_owned(),
        Ok(_) => format!("start and target are in one class, {}", class_digits(&target)),
        Err(SpinError::NotAnImmersion { pinch_points }) => format!(
            "the start is in no class: {pinch_points} of its vertex stars are figure-8, so it is no immersion; start \
             from a shape without, or expect that rims resolve on the way"
        ),
        Err(error) => error.to_string(),
    }
}

/// Counts the classes of a scene that has a frame for each of them, so that everybody knows how many frames there are.
pub(super) fn count_classes(scene: &mut Scene) -> Result<(), PipelineError> {
    if scene.clock.a_frame_for_each_class {
        let surface = scene.surface()?;
        scene.clock =
            clock_of(scene, &surface.mesh).map_err(|error| complaint(scene, error.key(), &error.to_string()))?;
    }
    Ok(())
}

/// The simulation of a scene; what is at fault is shown where the scene names it.
fn set_up(scene: &Scene) -> Result<Simulation, PipelineError> {
    Simulation::from_scene(scene).map_err(|error| match error {
        SetupError::Surface(mistake) => mistake.into(),
        error => complaint(scene, error.key(), &error.to_string()),
    })
}

/// Shows an error where the scene names what is at fault.
fn complaint(scene: &Scene, key: &str, message: &str) -> PipelineError {
    scene.complain_of(key, message).into()
}

/// An error of a running simulation, shown where the scene names what is at fault, if it does.
fn at_fault(scene: &Scene, error: EvolveError) -> PipelineError {
    match error.key() {
        Some(key) => complaint(scene, key, &error.to_string()),
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
    let mut simulation = set_up(scene)?;
    Plan::of(scene)?; // nothing is computed for a picture that cannot be made
    simulation.repairs.iter().for_each(|repair| progress.note(repair));
    // A time without a metric is told when its frame is made.
    contradictions(scene, &simulation).iter().flatten().for_each(|warning| progress.note(warning));
    let film = Film::of(scene);
    let places = simulation.mesh_places.as_deref();
    let cache = if restart {
        Cache::restart(folder, &film, &simulation.mesh, places)?
    } else {
        Cache::open_or_create(folder, &film, &simulation.mesh, places)?
    };
    let kept = cache.last_valid_frame()?.unwrap_or(0);
    if kept > 0 {
        let state = cache.read_frame(kept)?;
        let transports = state.transport.iter().map(|&[re, im]| Complex { re, im }).collect();
        let checkpoint = Checkpoint {
            frame: kept,
            cursors: state.report.cursors(),
            frames: state.frames,
            spin: SpinStructure::from_transports(transports),
            edge_lengths: state.edge_lengths,
            positions: state.positions,
            rims: simulation.mesh.edges().filter(|e| state.rims[e.index()]).collect(),
        };
        simulation.resume(checkpoint).map_err(|error| at_fault(scene, error))?;
    }
    arrivals.reach(kept);
    for number in kept + 1..=scene.clock.frames {
        let start = Instant::now();
        let mut watcher = Watcher { progress: &mut *progress, arrivals, phase: None };
        let frame = simulation.next_frame(&mut watcher).map_err(|error| at_fault(scene, error))?;
        let mut report = frame.report;
        report.seconds = start.elapsed().as_secs_f64();
        let mut rims = vec![false; simulation.mesh.edge_count()];
        frame.rims.iter().for_each(|e| rims[e.index()] = true);
        cache.write_frame(&FrameState {
            frame: number,
            time: report.time,
            positions: frame.positions,
            frames: simulation.face_frames(),
            transport: simulation.spin().transports().iter().map(|t| [t.re, t.im]).collect(),
            edge_lengths: simulation.metric.edge_lengths().to_vec(),
            rims,
            report,
        })?;
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
