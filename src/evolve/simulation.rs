//! Algorithm 2 in time: a surface whose metric changes, frame by frame.

use super::classes::{clock_of, digit};
use super::course::{Course, metric_of};
use super::relaxation::{Beginning, Relaxation};
use super::{Cursor, EvolveError, FrameReport, Observer, Pace, Phase, SetupError, phases_from_scene};
use crate::algebra::Complex;
use crate::immersion::{Pins, TargetBending, initial_positions, spin_from_scene, spin_of_immersion};
use crate::mesh::{Component, EdgeId, Mesh, Surface, VertexId};
use crate::metric::{Metric, MetricAt, MetricProgram};
use crate::scene::{AtKey, Scene, StartFrom, StartSection};
use crate::spin::{Homology, SpinError, SpinStructure};
use crate::timeline::{Clock, Parameters};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A thin shell whose metric, bending and pins follow a scene, and its state: one unit quaternion per face.
#[derive(Debug)]
pub struct Simulation {
    /// Connectivity.
    pub mesh: Arc<Mesh>,
    /// What had to be repaired in the mesh, and what else is worth saying of the scene, in words.
    pub repairs: Vec<String>,
    /// What x, y and z of each vertex mean in the scene, |V|: positions or coordinates of the mesh, if it has any.
    pub mesh_places: Option<Vec<DVec3>>,
    /// Edge lengths and what they determine, at the time of the last frame.
    pub metric: Arc<Metric>,
    /// Generators of the homology.
    pub homology: Arc<Homology>,
    /// Positions that frames start from, |V|, if they do.
    shape: Option<Vec<DVec3>>,
    /// Positions of the mesh, |V|, if it has any.
    pub(super) mesh_positions: Option<Vec<DVec3>>,
    /// The components, each relaxed on its own.
    pub(super) components: Vec<Relaxation>,
    pub(super) course: Course,
    pub(super) clock: Clock,
    pub(super) pace: Pace,
    /// The last frame that was made; 0 before the first.
    pub(super) frame: usize,
    pub(super) time: f64,
    pub(super) curvature_error: Option<f64>,
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
    /// How far the relaxation of each component was.
    pub cursors: Vec<Cursor>,
}

impl Simulation {
    /// Lines 1 to 6 of Algorithm 2.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the scene is at fault.
    pub fn from_scene(scene: &Scene) -> Result<Simulation, SetupError> {
        Simulation::new(scene, scene.surface()?)
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
        let now = program.at(&surface.mesh, time)?;
        let shape = initial_positions(&scene.start, &scene.folder, &surface, &parameters, time)?;
        let bending = match &scene.bending {
            None => None,
            Some(section) => {
                Some(TargetBending::from_scene(section, &scene.folder, &surface, shape.as_deref(), &parameters)?)
            }
        };
        let pins = Pins::from_scene(&scene.pins, &surface, &parameters, time)?;
        let mesh_places = surface.places().map(<[DVec3]>::to_vec);
        let Surface { mesh, positions: mesh_positions, mut repairs, .. } = surface;
        repairs.extend(program.notes());
        let mesh = Arc::new(mesh);
        let MetricAt { metric, curvature_error } = now;
        let metric = Arc::new(metric);
        let homology = Arc::new(Homology::new(&mesh, &metric));
        let spin = spin_from_scene(&scene.spin, &mesh, &metric, &homology, mesh_positions.as_deref())?;
        let course = Course::new(mesh.clone(), program, bending, pins, (time, metric.clone(), curvature_error));
        let beginning = Beginning {
            spin: &spin,
            metric: &metric,
            homology: &homology,
            positions: mesh_positions.as_deref(),
            shape: shape.as_deref(),
            start: &scene.start.from,
            orientation: scene.start.orientation,
            is_smooth: starts_smooth(scene),
            accuracy: section.accuracy,
            time,
        };
        let phases = |faces| Ok(phases_from_scene(scene, faces)?);
        let components = Component::all_of(&mesh);
        let of = components.len();
        let components = components
            .into_iter()
            .enumerate()
            .map(|(k, component)| Relaxation::new(component, [k, of], &beginning, &course, phases))
            .collect::<Result<_, _>>()?;
        Ok(Simulation {
            mesh,
            repairs,
            mesh_places,
            metric,
            homology,
            shape,
            mesh_positions,
            components,
            clock,
            pace: Pace::from_scene(&section, &scene.spin, course.changes()),
            course,
            frame: 0,
            time,
            curvature_error,
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
        let (pace, made, clock) = (self.pace, self.frame, self.clock);
        if let Pace::EachClass = pace {
            self.begin_class(made, time)?;
        }
        let Simulation { components, course, .. } = self;
        for relaxation in components {
            relaxation.frame = made + 1;
            match (pace, made) {
                (Pace::EachClass, _) => relaxation.run_all_phases(observer)?,
                (Pace::Settle(settling), 0) => {
                    relaxation.run_all_phases(observer)?;
                    relaxation.take_out_dents(&settling, observer)?;
                    if clock.is_looping() {
                        relaxation.run_a_lap(course, &clock, &settling, observer)?;
                    }
                }
                (Pace::Settle(settling), _) => relaxation.follow(course, time, &settling, observer)?,
                // The first frame of a film of the relaxation is where it starts.
                (Pace::Steps(_), 0) => {}
                (Pace::Steps(steps), _) => {
                    relaxation.move_to(course, time)?;
                    if course.changes() {
                        relaxation.stay_in_last_phase();
                    }
                    relaxation.run_steps(steps, observer)?;
                }
            }
            relaxation.verify_class()?;
        }
        self.frame += 1;
        self.take_metric(time)?;
        Ok(self.frame_now())
    }

    /// Relaxes the frames at the present time, by some steps or through all phases, and realizes the surface.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it or frames are no longer finite.
    pub fn relax(&mut self, steps: Option<usize>, observer: &mut dyn Observer) -> Result<Frame, EvolveError> {
        for relaxation in &mut self.components {
            match steps {
                None => relaxation.run_all_phases(observer)?,
                Some(steps) => relaxation.run_steps(steps, observer)?,
            }
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
    fn begin_class(&mut self, number: usize, time: f64) -> Result<(), EvolveError> {
        let betti = self.homology.betti();
        let class: Vec<bool> = (0..betti).map(|k| digit(number, betti - 1 - k)).collect();
        let mut rest = class.as_slice();
        for relaxation in &mut self.components {
            let own;
            // Generators come component by component.
            (own, rest) = rest.split_at(relaxation.homology.betti());
            relaxation.move_to(&mut self.course, time)?;
            relaxation.begin_class(&self.course, own.to_vec())?;
        }
        self.previous = None;
        Ok(())
    }

    fn take_metric(&mut self, time: f64) -> Result<(), EvolveError> {
        let asked = self.course.metric(time)?;
        (self.metric, self.curvature_error) = (asked.metric.clone(), asked.curvature_error);
        self.time = time;
        Ok(())
    }

    fn frame_now(&mut self) -> Frame {
        let positions = self.placed();
        self.realize(positions)
    }

    /// Goes on after a frame of an earlier run of the same scene, to the same bits.
    ///
    /// # Errors
    /// [`EvolveError`] if the scene gives no metric at that time.
    pub fn resume(&mut self, from: Checkpoint) -> Result<(), EvolveError> {
        debug_assert_eq!(from.frames.len(), self.mesh.face_count());
        self.frame = from.frame;
        self.time = self.clock.time(from.frame);
        let at_time = |time| move |error| EvolveError::Metric { time, error: AtKey { key: "metric".into(), error } };
        self.metric = Arc::new(Metric::new(&self.mesh, from.edge_lengths.clone()).map_err(at_time(self.time))?);
        for (relaxation, cursor) in self.components.iter_mut().zip(from.cursors) {
            let component = &relaxation.component;
            relaxation.metric = metric_of(component, &self.metric).map_err(at_time(self.time))?;
            relaxation.spin = SpinStructure::from_transports(component.edges.pick(from.spin.transports()));
            relaxation.face_frames = component.faces.pick(&from.frames);
            (relaxation.cursor, relaxation.time, relaxation.frame) = (cursor, self.time, from.frame);
            relaxation.discretize(&self.course)?;
        }
        self.previous = Some(Previous { positions: from.positions, rims: from.rims, edge_lengths: from.edge_lengths });
        Ok(())
    }

    /// Whether the scene gives a metric, bending angles and places for pins at the times of all frames, found without
    /// simulating.
    ///
    /// # Errors
    /// [`EvolveError::Metric`], [`EvolveError::Pin`], [`EvolveError::Bending`] at the first time at which it does not.
    pub fn check_all_times(&mut self) -> Result<(), EvolveError> {
        self.clock.times().try_for_each(|time| self.course.check(time))
    }

    /// The state: unit quaternions, |F|.
    pub fn face_frames(&self) -> Vec<DQuat> {
        let mut whole = vec![DQuat::IDENTITY; self.mesh.face_count()];
        self.components.iter().for_each(|part| part.component.faces.put(&part.face_frames, &mut whole));
        whole
    }

    /// Takes other frames for the state, |F|.
    pub fn set_face_frames(&mut self, frames: &[DQuat]) {
        self.components.iter_mut().for_each(|part| part.face_frames = part.component.faces.pick(frames));
    }

    /// The regular homotopy class, as signs of τ.
    pub fn spin(&self) -> SpinStructure {
        let mut whole = vec![Complex::ONE; self.mesh.edge_count()];
        self.components.iter().for_each(|part| part.component.edges.put(part.spin.transports(), &mut whole));
        SpinStructure::from_transports(whole)
    }

    /// Stages of the relaxation of the first frame, of the first component.
    pub fn phases(&self) -> &[Phase] {
        self.components.first().map_or(&[], |part| &part.phases)
    }

    /// Changes the stages of every component.
    pub fn change_phases(&mut self, change: impl Fn(&mut Vec<Phase>)) {
        self.components.iter_mut().for_each(|part| change(&mut part.phases));
    }
}

/// Whether the scene asks for no folds: neither by a start that was made for them, nor by target bending angles, nor by
/// phases of its own.
fn starts_smooth(scene: &Scene) -> bool {
    let StartSection { from, formula, noise, .. } = &scene.start;
    matches!(from, StartFrom::Mesh | StartFrom::Random(_) | StartFrom::Spectral)
        && formula.is_none()
        && noise.is_none()
        && scene.bending.is_none()
        && scene.phases.is_empty()
}
