//! From a scene to frames and from frames to pictures.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::Progress;
use crate::algebra::Complex;
use crate::cache::{Cache, CacheError, Film, FrameState};
use crate::evolve::{self, Checkpoint, EvolveError, Observer, SetupError, Simulation};
use crate::mesh::Mesh;
use crate::render::{Camera, Extent, Lights, Look, Output, RenderError, Scenery, render};
use crate::scene::{Scene, SceneError, SceneErrors};
use crate::spin::SpinStructure;

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
    /// The picture cannot be made.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Pictures are wanted of a frame that has not been computed.
    #[error("{}: frame {frame} has not been computed; run `immerse simulate` first", folder.display())]
    NoSuchFrame {
        /// The film.
        folder: PathBuf,
        /// The frame.
        frame: usize,
    },
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
            PipelineError::Scene(_) | PipelineError::NoSuchFrame { .. } => true,
            PipelineError::Cache(error) => !matches!(error, CacheError::Io { .. } | CacheError::Unfit { .. }),
            PipelineError::Render(error) => !matches!(error, RenderError::Write { .. }),
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
    let picture = Picture::of(scene)?;
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
    let class = simulation.spin.class(mesh, &simulation.metric, &simulation.homology);
    for (k, (generator, q)) in simulation.homology.generators().iter().zip(class).enumerate() {
        notes.push(format!(
            "generator {} of length {:.4} through {} faces: q = {}",
            k + 1,
            generator.length,
            generator.strip.exits().len(),
            u8::from(q)
        ));
    }
    for (k, cycle) in mesh.boundary_loops().iter().enumerate() {
        let length: f64 = cycle.iter().map(|&h| simulation.metric.length(mesh.edge(h))).sum();
        notes.push(format!("boundary loop {k} of length {length:.4} with {} vertices", cycle.len()));
    }
    notes.extend(simulation.repairs.iter().cloned());
    notes.push(format!("pictures of {} x {} pixels", picture.output.width(), picture.output.height()));
    Ok(notes)
}

/// The simulation of a scene; what is at fault is shown where the scene names it.
fn set_up(scene: &Scene) -> Result<Simulation, PipelineError> {
    Simulation::from_scene(scene).map_err(|error: SetupError| complaint(scene, error.key(), &error.to_string()))
}

/// Shows an error where the scene names what is at fault.
fn complaint(scene: &Scene, key: &str, message: &str) -> PipelineError {
    // Messages end with what to do.
    let (reason, remedy) = message.rsplit_once("; ").unwrap_or((message, "correct it"));
    scene.complain(key, reason, remedy).into()
}

/// An error of a running simulation, shown where the scene names what is at fault, if it does.
fn at_fault(scene: &Scene, error: EvolveError) -> PipelineError {
    match error.key() {
        Some(key) => complaint(scene, key, &error.to_string()),
        None => error.into(),
    }
}

/// Computes the frames that are not there yet.
pub(super) fn simulate(
    scene: &Scene,
    folder: &Path,
    restart: bool,
    progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    progress.begin("set up", None);
    let mut simulation = set_up(scene)?;
    Picture::of(scene)?; // nothing is computed for a picture that cannot be made
    simulation.repairs.iter().for_each(|repair| progress.note(repair));
    let film = Film::of(scene);
    let places = simulation.mesh_places.as_deref();
    let cache = if restart {
        Cache::restart(folder, &film, &simulation.mesh, places)?
    } else {
        Cache::open_or_create(folder, &film, &simulation.mesh, places)?
    };
    let kept = cache.last_valid_frame()?.unwrap_or(0);
    let mut restarts = 0;
    if kept > 0 {
        let state = cache.read_frame(kept)?;
        restarts = state.report.cursor.restarts;
        let transports = state.transport.iter().map(|&[re, im]| Complex { re, im }).collect();
        let checkpoint = Checkpoint {
            frame: kept,
            frames: state.frames,
            spin: SpinStructure::from_transports(transports),
            edge_lengths: state.edge_lengths,
            positions: state.positions,
            rims: simulation.mesh.edges().filter(|e| state.rims[e.index()]).collect(),
            cursor: state.report.cursor,
        };
        simulation.resume(checkpoint).map_err(|error| at_fault(scene, error))?;
    }
    for number in kept + 1..=scene.clock.frames {
        let start = Instant::now();
        let mut watcher = Watcher { progress: &mut *progress, phase: None, restarts };
        let frame = simulation.next_frame(&mut watcher).map_err(|error| at_fault(scene, error))?;
        let mut report = frame.report;
        restarts = report.cursor.restarts;
        report.seconds = start.elapsed().as_secs_f64();
        let mut rims = vec![false; simulation.mesh.edge_count()];
        frame.rims.iter().for_each(|e| rims[e.index()] = true);
        cache.write_frame(&FrameState {
            frame: number,
            time: report.time,
            positions: frame.positions,
            frames: simulation.frames.clone(),
            transport: simulation.spin.transports().iter().map(|t| [t.re, t.im]).collect(),
            edge_lengths: simulation.metric.edge_lengths().to_vec(),
            rims,
            report,
        })?;
    }
    Ok(Summary { made: scene.clock.frames - kept, kept })
}

/// Passes the progress of a relaxation on.
struct Watcher<'a> {
    progress: &'a mut dyn Progress,
    phase: Option<usize>,
    restarts: usize,
}

impl Observer for Watcher<'_> {
    fn after_step(&mut self, now: &evolve::Progress) -> ControlFlow<()> {
        let following = now.phase >= now.phases;
        let name =
            if following { format!("frame {}", now.frame) } else { format!("phase {}/{}", now.phase + 1, now.phases) };
        if self.phase != Some(now.phase) {
            self.phase = Some(now.phase);
            self.progress.begin(&name, Some(now.max_steps));
        }
        self.progress.advance(now.step, Some(now.l2_length_error));
        if now.restarts > self.restarts {
            self.restarts = now.restarts;
            self.progress.note(&format!("frame {}: rims were left, so frames were drawn anew at random", now.frame));
        }
        if now.step >= now.max_steps && !now.settled && !following {
            self.progress.note(&format!(
                "frame {}: {name} did not converge in {} steps: frames still turn by {:.3} degrees a step, more than \
                 the tolerance of {}",
                now.frame, now.step, now.turn, now.tolerance
            ));
        }
        ControlFlow::Continue(())
    }
}

/// What a scene says of its pictures, validated.
struct Picture {
    look: Look,
    lights: Lights,
    output: Output,
}

impl Picture {
    fn of(scene: &Scene) -> Result<Picture, RenderError> {
        Ok(Picture {
            look: Look::from_scene(&scene.look, &scene.folder)?,
            lights: Lights::from_scene(&scene.lights)?,
            output: Output::from_scene(&scene.output)?,
        })
    }
}

/// Makes pictures of computed frames, given by number in order.
pub(super) fn render_frames(
    scene: &Scene,
    folder: &Path,
    frames: &[usize],
    progress: &mut dyn Progress,
) -> Result<Summary, PipelineError> {
    let Picture { look, lights, output } = Picture::of(scene)?;
    let cache = Cache::open(folder)?;
    let triangles = cache.triangles()?;
    let ready = cache.last_valid_frame()?.unwrap_or(0);
    if let Some(&frame) = frames.iter().find(|&&frame| frame > ready) {
        return Err(PipelineError::NoSuchFrame { folder: folder.to_owned(), frame });
    }
    let vertices = cache.manifest().mesh.vertices;
    let mesh = Mesh::from_faces(vertices, &triangles).map_err(|error| CacheError::Damaged {
        path: folder.to_owned(),
        reason: error.to_string(),
        remedy: "run `immerse simulate --restart`",
    })?;
    let ends = |e: crate::mesh::EdgeId| mesh.edge_vertices(e).map(|v| v.0);
    let boundary: Vec<[u32; 2]> = mesh.edges().filter(|&e| mesh.is_boundary_edge(e)).map(ends).collect();

    progress.begin("camera", Some(ready));
    let mut extent: Option<Extent> = None;
    for frame in 1..=ready {
        let of_frame = Extent::of(&cache.read_frame(frame)?.positions);
        match &mut extent {
            Some(extent) => extent.merge(&of_frame),
            None => extent = Some(of_frame),
        }
        progress.advance(frame, None);
    }
    let Some(extent) = extent else { return Ok(Summary::default()) };
    let camera = Camera::framing(&scene.camera, &extent, &output)?;

    progress.begin("render", Some(frames.len()));
    for (done, &frame) in frames.iter().enumerate() {
        let state = cache.read_frame(frame)?;
        let rims: Vec<[u32; 2]> = mesh.edges().filter(|e| state.rims[e.index()]).map(ends).collect();
        let pinch_points: Vec<u32> =
            crate::immersion::pinch_points(&mesh, &state.positions).into_iter().map(|v| v.0).collect();
        let scenery = Scenery {
            triangles: &triangles,
            positions: &state.positions,
            rims: &rims,
            boundary: &boundary,
            pinch_points: &pinch_points,
            ground: Some(crate::render::Plane {
                normal: glam::DVec3::Z,
                offset: state.positions.iter().map(|p| p.z).fold(f64::MAX, f64::min),
            }),
            ..Scenery::default()
        };
        let film = render(&scenery, &camera, &lights, &look, &output)?;
        if film.skipped_triangles() > 0 {
            progress
                .note(&format!("frame {frame}: {} triangles have no area and are not drawn", film.skipped_triangles()));
        }
        let name = folder.join(format!("{frame:06}"));
        if scene.output.png {
            film.write_png(&name.with_extension("png"))?;
        }
        if scene.output.exr {
            film.write_exr(&name.with_extension("exr"))?;
        }
        progress.advance(done + 1, None);
    }
    Ok(Summary { made: frames.len(), kept: 0 })
}
