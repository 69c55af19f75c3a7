//! Algorithm 2 in time: a surface whose metric changes, frame by frame.

use super::discretization::Discretization;
use super::{Cursor, EvolveError, FrameReport, Observer, Pace, Phase, SetupError, phases_from_scene};
use crate::frames::{Shell, Stepper, random_frames, spectral_frames};
use crate::immersion::{Pins, TargetBending, initial_positions, rimless_frames, spin_from_scene, spin_of_immersion};
use crate::mesh::{self, EdgeId, Mesh, Surface, VertexId};
use crate::metric::{Metric, MetricAt, MetricProgram, lengths_of_positions};
use crate::scene::{AtKey, ClockSection, Scene, SpinSection, StartFrom};
use crate::spin::{Homology, SpinError, SpinStructure};
use crate::timeline::{Clock, Parameters};
use glam::{DQuat, DVec3};

/// A thin shell whose metric, bending and pins follow a scene, and its state: one unit quaternion per face.
#[derive(Debug)]
pub struct Simulation {
    /// Connectivity.
    pub mesh: Mesh,
    /// What had to be repaired in the mesh, in words.
    pub repairs: Vec<String>,
    /// What x, y and z of each vertex mean in the scene, |V|: positions or coordinates of the mesh, if it has any.
    pub mesh_places: Option<Vec<DVec3>>,
    /// Edge lengths and what they determine, now.
    pub metric: Metric,
    /// Generators of the homology.
    pub homology: Homology,
    /// The regular homotopy class, as signs of τ.
    pub spin: SpinStructure,
    /// Stages of the relaxation of the first frame.
    pub phases: Vec<Phase>,
    /// The state: one unit quaternion per face.
    pub frames: Vec<DQuat>,
    pub(super) program: MetricProgram,
    pub(super) bending: Option<TargetBending>,
    pub(super) pins: Pins,
    pub(super) clock: Clock,
    /// Whether anything in the scene depends on time.
    pub(super) changes: bool,
    pub(super) pace: Pace,
    /// L2 length error at which a frame without rims is done.
    pub(super) accuracy: Option<f64>,
    /// The last frame that was made; 0 before the first.
    pub(super) frame: usize,
    pub(super) time: f64,
    pub(super) cursor: Cursor,
    /// q on every generator, which must stay.
    pub(super) class: Vec<bool>,
    pub(super) places: Vec<(VertexId, DVec3)>,
    pub(super) curvature_error: Option<f64>,
    pub(super) parts: Discretization,
    pub(super) stepper: Stepper,
    /// What random frames are drawn with; `None` for other starts.
    pub(super) seed: Option<u64>,
    /// The best attempt so far: its number of rims, and its frames.
    pub(super) fewest_rims: Option<(usize, Vec<DQuat>)>,
    /// Positions of the mesh, where the metric at the start is theirs.
    pub(super) original: Option<Vec<DVec3>>,
    pub(super) start: StartFrom,
    /// Positions that frames start from.
    pub(super) shape: Option<Vec<DVec3>>,
    /// Of the last frame.
    pub(super) previous: Option<Previous>,
}

/// What the next frame is compared with.
#[derive(Debug)]
pub(super) struct Previous {
    pub positions: Vec<DVec3>,
    pub rims: Vec<EdgeId>,
    pub edge_lengths: Vec<f64>,
}

/// A relaxed surface.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Vertex positions, |V|.
    pub positions: Vec<DVec3>,
    /// Edges with rim bit 1.
    pub rims: Vec<EdgeId>,
    /// Interior vertices with figure-8 star.
    pub pinch_points: Vec<VertexId>,
    /// Measures.
    pub report: FrameReport,
}

/// What must be kept of a frame to go on after it.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// The frame, from 1.
    pub frame: usize,
    /// Unit quaternions, |F|.
    pub frames: Vec<DQuat>,
    /// The spin connection and
    pub spin: SpinStructure,
    /// the lengths it belongs to, |E|.
    pub edge_lengths: Vec<f64>,
    /// |V|
    pub positions: Vec<DVec3>,
    /// Edges with rim bit 1.
    pub rims: Vec<EdgeId>,
    /// How far the relaxation was.
    pub cursor: Cursor,
}

impl Simulation {
    /// Lines 1 to 6 of Algorithm 2.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the scene is at fault.
    pub fn from_scene(scene: &Scene) -> Result<Simulation, SetupError> {
        Simulation::new(scene, mesh::from_scene(&scene.mesh, &scene.folder)?)
    }

    /// As [`Simulation::from_scene`], with a surface from memory in place of the scene's `[mesh]`.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the scene does not fit the surface.
    pub fn new(scene: &Scene, surface: Surface) -> Result<Simulation, SetupError> {
        let parameters = Parameters::from_scene(&scene.parameters)
            .map_err(|(name, error)| AtKey { key: format!("parameters.{name}"), error })?;
        let section = clock_of(scene, &surface.mesh)?;
        let clock = Clock::from_scene(&section);
        let time = clock.time(1);
        let mut program = MetricProgram::from_scene(&scene.metric, &scene.folder, &surface, &parameters)?;
        let MetricAt { metric, curvature_error } = program.at(&surface.mesh, time)?;
        let shape = initial_positions(&scene.start, &scene.folder, &surface, &parameters, time)?;
        let bending = match &scene.bending {
            None => None,
            Some(section) => {
                Some(TargetBending::from_scene(section, &scene.folder, &surface, shape.as_deref(), &parameters)?)
            }
        };
        let pins = Pins::from_scene(&scene.pins, &surface, &parameters, time)?;
        let mesh_places = surface.places().map(<[DVec3]>::to_vec);
        let Surface { mesh, positions, repairs, .. } = surface;
        let positions = positions.as_deref();
        let homology = Homology::new(&mesh, &metric);
        let spin = spin_from_scene(&scene.spin, &mesh, &metric, &homology, positions)?;
        let pinned = pins.at(time)?;
        let angles = bending.as_ref().map(|bending| bending.at(time)).transpose()?;
        let phases = phases_from_scene(scene, mesh.face_count())?;
        let stepper = |shell: &Shell| {
            let mut stepper = Stepper::new(shell);
            phases.first().inspect(|first| stepper.prepare(shell, &first.step));
            stepper
        };
        let (parts, stepper) =
            Discretization::new(&mesh, &metric, &spin, &homology, angles.as_deref(), pins.vertices(), stepper)?;

        let (frames, seed) = start(&scene.start.from, &mesh, &metric, &parts.shell, shape.as_deref());
        let original = positions.filter(|positions| are_lengths_of(&mesh, &metric, positions)).map(<[DVec3]>::to_vec);
        let changes = program.changes() || pins.changes() || bending.as_ref().is_some_and(TargetBending::changes);
        let class = spin.class(&mesh, &metric, &homology);
        Ok(Simulation {
            mesh,
            repairs,
            mesh_places,
            metric,
            homology,
            spin,
            phases,
            frames,
            program,
            bending,
            pins,
            clock,
            changes,
            accuracy: section.accuracy,
            pace: Pace::from_scene(&section, &scene.spin, changes),
            frame: 0,
            time,
            cursor: Cursor::default(),
            class,
            places: pinned,
            curvature_error,
            parts,
            stepper,
            seed,
            fewest_rims: None,
            original,
            start: scene.start.from.clone(),
            shape,
            previous: None,
        })
    }

    /// Makes the next frame of the film. The first one of a scene that changes with time, or does not and has but one
    /// frame, goes through all phases; the others follow the metric.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it, frames are no longer finite, or the scene gives no metric or no place
    /// for its pins at the time of the frame.
    pub fn next_frame(&mut self, observer: &mut dyn Observer) -> Result<Frame, EvolveError> {
        let time = self.clock.time(self.frame + 1);
        match (self.pace, self.frame) {
            (Pace::EachClass, made) => {
                self.move_to(time)?;
                self.begin_class(made)?;
                self.run_all_phases(observer)?;
            }
            (Pace::Settle(settling), 0) => {
                self.run_all_phases(observer)?;
                if self.clock.is_looping() {
                    self.run_a_lap(&settling, observer)?;
                }
            }
            (Pace::Settle(settling), _) => self.follow(time, &settling, observer)?,
            // The first frame of a film of the relaxation is where it starts.
            (Pace::Steps(_), 0) => {}
            (Pace::Steps(steps), _) => {
                self.move_to(time)?;
                if self.changes {
                    self.stay_in_last_phase();
                }
                self.run_steps(steps, observer)?;
            }
        }
        self.verify_class()?;
        self.frame += 1;
        Ok(self.frame_now())
    }

    /// Relaxes the frames at the present time, by some steps or through all phases, and realizes the surface.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it or frames are no longer finite.
    pub fn relax(&mut self, steps: Option<usize>, observer: &mut dyn Observer) -> Result<Frame, EvolveError> {
        match steps {
            None => self.run_all_phases(observer)?,
            Some(steps) => self.run_steps(steps, observer)?,
        }
        Ok(self.frame_now())
    }

    /// The class of the positions that frames start from, as q on every generator; `None` where they come from none. The
    /// error is [`SpinError::NotAnImmersion`] where those are in no class.
    pub fn class_of_start(&self) -> Option<Result<Vec<bool>, SpinError>> {
        let Simulation { mesh, metric, homology, .. } = self;
        let spin = spin_of_immersion(mesh, metric, self.shape.as_deref()?);
        Some(spin.map(|spin| spin.class(mesh, metric, homology)))
    }

    /// Starts over in the class with this number, the last generator being its last binary digit.
    fn begin_class(&mut self, number: usize) -> Result<(), EvolveError> {
        let betti = self.homology.betti();
        self.class = (0..betti).map(|k| digit(number, betti - 1 - k)).collect();
        self.spin = SpinStructure::of_class(&self.mesh, &self.metric, &self.homology, &self.class)?;
        self.discretize()?;
        (self.frames, _) = start(&self.start, &self.mesh, &self.metric, &self.parts.shell, self.shape.as_deref());
        self.cursor = Cursor::default();
        self.previous = None;
        Ok(())
    }

    fn frame_now(&mut self) -> Frame {
        let mut positions = self.integrate();
        self.place(&mut positions);
        self.realize(positions)
    }

    /// Goes on after a frame of an earlier run of the same scene, to the same bits.
    ///
    /// # Errors
    /// [`EvolveError`] if the scene gives no metric at that time.
    pub fn resume(&mut self, from: Checkpoint) -> Result<(), EvolveError> {
        debug_assert_eq!(from.frames.len(), self.frames.len());
        self.frame = from.frame;
        self.time = self.clock.time(from.frame);
        self.metric = Metric::new(&self.mesh, from.edge_lengths.clone())
            .map_err(|error| EvolveError::Metric { time: self.time, error: AtKey { key: "metric".into(), error } })?;
        self.spin = from.spin;
        self.discretize()?;
        self.frames = from.frames;
        self.cursor = from.cursor;
        self.previous = Some(Previous { positions: from.positions, rims: from.rims, edge_lengths: from.edge_lengths });
        Ok(())
    }
}

/// The clock of a scene on its mesh, which says how many classes there are where each has a frame.
///
/// # Errors
/// [`SetupError::TooManyClasses`], [`SetupError::MoreFramesThanClasses`]
pub fn clock_of(scene: &Scene, mesh: &Mesh) -> Result<ClockSection, SetupError> {
    let ClockSection { frames, a_frame_for_each_class, .. } = scene.clock;
    if scene.spin != SpinSection::All {
        return Ok(scene.clock);
    }
    let betti = mesh.betti();
    let classes = u32::try_from(betti).ok().and_then(|betti| 1_usize.checked_shl(betti));
    match classes {
        Some(classes) if a_frame_for_each_class && classes <= ClockSection::MOST_FRAMES => {
            Ok(ClockSection { frames: classes, a_frame_for_each_class: false, ..scene.clock })
        }
        _ if a_frame_for_each_class => Err(SetupError::TooManyClasses { betti }),
        Some(classes) if frames > classes => Err(SetupError::MoreFramesThanClasses { frames, betti }),
        _ => Ok(scene.clock),
    }
}

/// The binary digit of a number at a place, 0 beyond all that it has.
fn digit(number: usize, place: usize) -> bool {
    u32::try_from(place).ok().and_then(|place| number.checked_shr(place)).is_some_and(|rest| rest & 1 == 1)
}

/// Whether the lengths of a metric are those of positions, up to rounding.
fn are_lengths_of(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> bool {
    let lengths = lengths_of_positions(mesh, positions);
    metric.edge_lengths().iter().zip(lengths).all(|(a, b)| (a - b).abs() <= 1e-9 * a)
}

/// The frames to start from, and the seed of random ones. `shape` is that of [`initial_positions`].
fn start(
    from: &StartFrom,
    mesh: &Mesh,
    metric: &Metric,
    shell: &Shell,
    shape: Option<&[DVec3]>,
) -> (Vec<DQuat>, Option<u64>) {
    match (from, shape) {
        (_, Some(shape)) => (rimless_frames(mesh, metric, shell, shape), None),
        (StartFrom::Random(seed), _) => (random_frames(mesh.face_count(), *seed), Some(*seed)),
        _ => (spectral_frames(shell), None),
    }
}
