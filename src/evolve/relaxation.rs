//! One connected component and its state: what Algorithm 2 works on.

use super::course::{Course, metric_of};
use super::discretization::Discretization;
use super::{Cursor, EvolveError, Phase, SetupError};
use crate::frames::{Shell, Stepper, random_frames, spectral_frames};
use crate::immersion::rimless_frames;
use crate::mesh::{Component, Mesh, VertexId};
use crate::metric::{Metric, MetricError, lengths_of_positions};
use crate::scene::{AtKey, Orientation, StartFrom};
use crate::spin::{Homology, SpinStructure};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A component that is relaxed as if it were alone: in units, steps, phases and random frames of its own. So it ends as
/// it would alone, whatever the others are. Elements are numbered as in the component.
#[derive(Debug)]
pub(super) struct Relaxation {
    pub component: Component,
    /// Which of how many, from 0.
    pub number: usize,
    /// See `number`.
    pub of: usize,
    /// Edge lengths and what they determine, now.
    pub metric: Arc<Metric>,
    pub homology: Arc<Homology>,
    /// The regular homotopy class, as signs of τ.
    pub spin: SpinStructure,
    /// The state: one unit quaternion per face.
    pub face_frames: Vec<DQuat>,
    /// Stages of the relaxation of the first frame.
    pub phases: Vec<Phase>,
    pub cursor: Cursor,
    /// The frame that is being made, from 1.
    pub frame: usize,
    pub time: f64,
    /// L2 length error at which a frame without rims is done.
    pub accuracy: Option<f64>,
    /// q on every generator, which must stay.
    pub class: Vec<bool>,
    /// Target bending angles now, |E|.
    pub angles: Option<Vec<f64>>,
    /// Per edge: whether its angle is asked for.
    pub is_bent: Option<Vec<bool>>,
    /// Pins now.
    pub places: Vec<(VertexId, DVec3)>,
    pub parts: Discretization,
    pub stepper: Stepper,
    pub start: StartFrom,
    pub orientation: Orientation,
    /// Whether nothing in the scene asks for folds.
    pub is_smooth: bool,
    /// What random frames are drawn with; `None` for other starts.
    pub seed: Option<u64>,
    /// The best attempt so far: its number of rims, and its frames.
    pub fewest_rims: Option<(usize, Vec<DQuat>)>,
    /// Positions of the mesh, where the metric at the start is theirs.
    pub original: Option<Vec<DVec3>>,
    /// Positions that frames start from.
    pub shape: Option<Vec<DVec3>>,
}

/// What a component is to be relaxed from, with.
pub(super) struct Beginning<'a> {
    /// Of the whole surface.
    pub spin: &'a SpinStructure,
    /// Of the whole surface.
    pub metric: &'a Arc<Metric>,
    /// Of the whole surface; shared where it is the component.
    pub homology: &'a Arc<Homology>,
    /// Positions of the whole surface, if it has any.
    pub positions: Option<&'a [DVec3]>,
    /// Positions that frames start from, of the whole surface.
    pub shape: Option<&'a [DVec3]>,
    pub start: &'a StartFrom,
    pub orientation: Orientation,
    pub is_smooth: bool,
    pub accuracy: Option<f64>,
    pub time: f64,
}

impl Relaxation {
    /// Lines 1 to 6 of Algorithm 2, with the phases of a component of so many faces.
    pub fn new(
        component: Component,
        [number, of]: [usize; 2],
        beginning: &Beginning,
        course: &Course,
        phases: impl Fn(usize) -> Result<Vec<Phase>, SetupError>,
    ) -> Result<Relaxation, SetupError> {
        let Beginning { start, time, .. } = *beginning;
        let mesh = component.mesh.clone();
        let metric = metric_of(&component, beginning.metric).map_err(AtKey::<MetricError>::of("metric"))?;
        let homology = match of {
            1 => beginning.homology.clone(),
            _ => Arc::new(Homology::new(&mesh, &metric)),
        };
        let spin = SpinStructure::from_transports(component.edges.pick(beginning.spin.transports()));
        let angles = course.angles_of(&component, time)?;
        let places = course.pins_of(&component, time)?;
        let phases = phases(mesh.face_count())?;
        let stepper = |shell: &Shell| {
            let mut stepper = Stepper::new(shell);
            phases.first().inspect(|first| stepper.prepare(shell, &first.step));
            stepper
        };
        let pinned: Vec<VertexId> = places.iter().map(|(v, _)| *v).collect();
        let (parts, stepper) =
            Discretization::new(&mesh, &metric, &spin, &homology, angles.as_deref(), &pinned, stepper)?;
        let here = |whole: &[DVec3]| component.vertices.pick(whole);
        let shape = beginning.shape.map(here);
        let original = beginning.positions.map(here).filter(|here| are_lengths_of(&mesh, &metric, here));
        let (face_frames, seed) = frames_of(start, &mesh, &metric, &parts.shell, shape.as_deref());
        Ok(Relaxation {
            number,
            of,
            class: spin.class(&mesh, &metric, &homology),
            is_bent: course.is_bent(&component),
            component,
            metric,
            homology,
            spin,
            face_frames,
            phases,
            cursor: Cursor::default(),
            frame: 1,
            time,
            accuracy: beginning.accuracy,
            angles,
            places,
            parts,
            stepper,
            start: start.clone(),
            orientation: beginning.orientation,
            is_smooth: beginning.is_smooth,
            seed,
            fewest_rims: None,
            original,
            shape,
        })
    }

    /// Starts over in the class with these values of q.
    pub fn begin_class(&mut self, course: &Course, class: Vec<bool>) -> Result<(), EvolveError> {
        let mesh = self.component.mesh.clone();
        self.spin = SpinStructure::of_class(&mesh, &self.metric, &self.homology, &class)?;
        self.class = class;
        self.discretize(course)?;
        (self.face_frames, _) = frames_of(&self.start, &mesh, &self.metric, &self.parts.shell, self.shape.as_deref());
        self.cursor = Cursor::default();
        Ok(())
    }

    /// Whether some phases are not done.
    pub fn is_on_the_way(&self) -> bool {
        self.cursor.phase < self.phases.len()
    }

    /// Whether all phases are done and the last one met its tolerance.
    pub fn has_converged(&self) -> bool {
        self.cursor.phase >= self.phases.len() && self.cursor.settled
    }
}

/// Whether the lengths of a metric are those of positions, up to rounding.
fn are_lengths_of(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> bool {
    let lengths = lengths_of_positions(mesh, positions);
    metric.edge_lengths().iter().zip(lengths).all(|(a, b)| (a - b).abs() <= 1e-9 * a)
}

/// The frames to start from, and the seed of random ones.
fn frames_of(
    start: &StartFrom,
    mesh: &Mesh,
    metric: &Metric,
    shell: &Shell,
    shape: Option<&[DVec3]>,
) -> (Vec<DQuat>, Option<u64>) {
    match (start, shape) {
        (_, Some(shape)) => (rimless_frames(mesh, metric, shell, shape), None),
        (StartFrom::Random(seed), _) => (random_frames(mesh.face_count(), *seed), Some(*seed)),
        _ => (spectral_frames(shell), None),
    }
}
