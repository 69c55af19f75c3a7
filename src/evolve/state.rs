//! The state of one connected component: its frames, the metric and class they belong to, and what follows from those.

use super::course::{Course, metric_of};
use super::discretization::Discretization;
use super::error::{EvolveError, SetupError};
use super::frame::Frame;
use crate::frames::Shell;
use crate::immersion::{class_of_positions, edge_vectors, frames_of_positions, l2_length_error, rimless_frames, rims};
use crate::mesh::{Component, EdgeId, Mesh, VertexId};
use crate::metric::Metric;
use crate::spin::{ChangeOfMetric, Class, Homology, SpinStructure};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// What Algorithm 2 works on. Elements are numbered as in the component.
///
/// Metric, spin structure and what is computed from both change together, and only here.
#[derive(Debug)]
pub(super) struct State {
    component: Component,
    homology: Arc<Homology>,
    /// q on every generator, which must stay.
    class: Class,
    time: f64,
    metric: Arc<Metric>,
    /// The regular homotopy class, as signs of τ.
    spin: SpinStructure,
    /// One unit quaternion per face.
    face_frames: Vec<DQuat>,
    /// Target bending angles in radians, |E|; `None` for a shell that is flat at rest.
    angles: Option<Vec<f64>>,
    /// Per edge: whether its angle is asked for.
    is_bent: Option<Vec<bool>>,
    /// Pinned vertices and their places.
    pins: Vec<(VertexId, DVec3)>,
    discretization: Discretization,
}

/// A state apart from what follows from it.
#[derive(Clone, Debug)]
pub(super) struct Mark {
    time: f64,
    metric: Arc<Metric>,
    spin: SpinStructure,
    face_frames: Vec<DQuat>,
}

impl State {
    /// Lines 1 to 6 of Algorithm 2: a component of a surface with this metric and spin structure at a time. `frames`
    /// makes the frames to start from, which may take what `beside` makes of the shell while the Poisson problem is
    /// factorized.
    pub fn new<R: Send>(
        component: Component,
        homology: Arc<Homology>,
        metric: Arc<Metric>,
        spin: SpinStructure,
        (course, time): (&Course, f64),
        beside: impl FnOnce(&Shell) -> R + Send,
        frames: impl FnOnce(&Shell) -> Vec<DQuat>,
    ) -> Result<(State, R), SetupError> {
        let mesh = component.mesh.clone();
        let angles = course.angles_of(&component, time)?;
        let pins = course.pins_of(&component, time)?;
        let pinned: Vec<VertexId> = pins.iter().map(|(v, _)| *v).collect();
        let (discretization, beside) =
            Discretization::new(&mesh, &metric, &spin, &homology, angles.as_deref(), &pinned, beside)?;
        let face_frames = frames(&discretization.shell);
        let state = State {
            class: Class::new(spin.class(&mesh, &metric, &homology)),
            is_bent: course.is_bent(&component),
            component,
            homology,
            time,
            metric,
            spin,
            face_frames,
            angles,
            pins,
            discretization,
        };
        Ok((state, beside))
    }

    /// The component among the others.
    pub fn component(&self) -> &Component {
        &self.component
    }

    /// Its connectivity.
    pub fn mesh(&self) -> &Mesh {
        &self.component.mesh
    }

    pub fn metric(&self) -> &Metric {
        &self.metric
    }

    pub fn spin(&self) -> &SpinStructure {
        &self.spin
    }

    /// The class that it must stay in.
    pub fn class(&self) -> &Class {
        &self.class
    }

    /// Number of generators.
    pub fn betti(&self) -> usize {
        self.homology.betti()
    }

    pub fn time(&self) -> f64 {
        self.time
    }

    pub fn shell(&self) -> &Shell {
        &self.discretization.shell
    }

    pub fn face_frames(&self) -> &[DQuat] {
        &self.face_frames
    }

    /// For a step, beside the shell that it is taken on.
    pub fn shell_and_frames(&mut self) -> (&Shell, &mut [DQuat]) {
        (&self.discretization.shell, &mut self.face_frames)
    }

    /// Other frames in the place of these, |F|.
    pub fn set_face_frames(&mut self, frames: Vec<DQuat>) {
        debug_assert_eq!(frames.len(), self.mesh().face_count());
        self.face_frames = frames;
    }

    /// The frames of the surface at these positions, |V|, in the place of its own.
    pub fn set_positions(&mut self, positions: &[DVec3]) {
        let frames = rimless_frames(self.mesh(), &self.metric, self.shell(), positions);
        self.set_face_frames(frames);
    }

    /// Target bending angles in radians, with which of them are asked for; both |E|.
    pub fn target_angles(&self) -> Option<(&[f64], &[bool])> {
        self.angles.as_deref().zip(self.is_bent.as_deref())
    }

    /// Pinned vertices and their places now.
    pub fn pins(&self) -> &[(VertexId, DVec3)] {
        &self.pins
    }

    /// Algorithm 7: positions from the averaged edge vectors.
    pub fn integrate(&self) -> Vec<DVec3> {
        let vectors = edge_vectors(self.mesh(), &self.metric, &self.face_frames);
        self.discretization.poisson.solve(self.mesh(), &self.metric, &vectors, &self.pins)
    }

    /// Frames of the surface at these positions, with the signs nearest to the state.
    pub fn frames_at(&self, positions: &[DVec3]) -> Vec<DQuat> {
        frames_of_positions(self.mesh(), &self.metric, positions, &self.face_frames)
    }

    /// Edges with rim bit 1 of the surface at these positions, in order.
    pub fn rims_at(&self, positions: &[DVec3]) -> Vec<EdgeId> {
        rims(self.shell(), &self.frames_at(positions))
    }

    /// As [`State::rims_at`], whatever the frames of the state are.
    pub fn rims_of_surface(&self, positions: &[DVec3]) -> Vec<EdgeId> {
        rims(self.shell(), &rimless_frames(self.mesh(), &self.metric, self.shell(), positions))
    }

    /// The class of the surface at these positions, which has no pinch points.
    pub fn class_at(&self, positions: &[DVec3]) -> Class {
        class_of_positions(self.mesh(), &self.homology, positions)
    }

    /// L2 length error of the surface at these positions.
    pub fn length_error_at(&self, positions: &[DVec3]) -> f64 {
        l2_length_error(self.mesh(), &self.metric, positions)
    }

    /// The harmonic part of edge vectors, three numbers per edge; `None` on a surface without generators.
    pub fn harmonic_part(&self, vectors: &[DVec3]) -> Option<Vec<DVec3>> {
        let periods = &self.discretization.periods;
        (!periods.is_empty()).then(|| periods.harmonic_part(self.mesh(), &self.metric, vectors))
    }

    /// Squared norms of the harmonic part of the edge vectors and of the edge lengths.
    pub fn period_norms(&self) -> [f64; 2] {
        let vectors = edge_vectors(self.mesh(), &self.metric, &self.face_frames);
        self.discretization.periods.squared_norms(self.mesh(), &self.metric, &vectors)
    }

    /// Takes metric, bending and pins to a time, with spin structure and frames (App. B.2).
    pub fn move_to(&mut self, course: &mut Course, time: f64) -> Result<(), EvolveError> {
        let there = course.metric_of(&self.component, time)?;
        self.take_on(course, time, there)
    }

    /// As [`State::move_to`], with the metric of that time.
    pub fn take_on(&mut self, course: &Course, time: f64, metric: Arc<Metric>) -> Result<(), EvolveError> {
        self.time = time;
        let changed = metric.edge_lengths() != self.metric.edge_lengths();
        if changed {
            let change = ChangeOfMetric::new(&self.component.mesh, &self.spin, &self.metric, &metric);
            change.carry(&mut self.face_frames);
            self.spin = change.spin;
            self.metric = metric;
        }
        if changed || course.changes_besides_metric() {
            self.discretize(course)?;
        }
        Ok(())
    }

    /// Passes to another class at the present time; frames are still those of the old one.
    pub fn change_class(&mut self, course: &Course, class: Class) -> Result<(), EvolveError> {
        self.spin = SpinStructure::of_class(&self.component.mesh, &self.metric, &self.homology, class.digits())?;
        self.class = class;
        self.discretize(course)
    }

    /// Goes back to what a frame says of the whole surface, with the metric of the frame. Whether it is in this class is
    /// asked by [`State::verify_class`].
    pub fn restore(
        &mut self,
        course: &Course,
        frame: &Frame,
        whole: &Arc<Metric>,
        class: Class,
    ) -> Result<(), EvolveError> {
        let (Component { edges, faces, .. }, time) = (&self.component, frame.report.time);
        self.spin = SpinStructure::of_known(edges.pick(frame.spin.transports()));
        self.face_frames = faces.pick(&frame.face_frames);
        self.metric = metric_of(&self.component, whole, time)?;
        (self.class, self.time) = (class, time);
        self.discretize(course)
    }

    /// What there is to go back to.
    pub fn mark(&self) -> Mark {
        let State { time, metric, spin, face_frames, .. } = self;
        Mark { time: *time, metric: metric.clone(), spin: spin.clone(), face_frames: face_frames.clone() }
    }

    /// Goes back to what it was.
    pub fn go_back(&mut self, course: &Course, mark: &Mark) -> Result<(), EvolveError> {
        let Mark { time, metric, spin, face_frames } = mark.clone();
        (self.time, self.metric, self.spin, self.face_frames) = (time, metric, spin, face_frames);
        self.discretize(course)
    }

    /// What follows from metric, spin structure, bending and pins at the present time.
    fn discretize(&mut self, course: &Course) -> Result<(), EvolveError> {
        self.angles = course.angles_of(&self.component, self.time)?;
        self.pins = course.pins_of(&self.component, self.time)?;
        let State { component, metric, spin, homology, angles, pins, .. } = self;
        let pinned: Vec<VertexId> = pins.iter().map(|(v, _)| *v).collect();
        (self.discretization, ()) =
            Discretization::new(&component.mesh, metric, spin, homology, angles.as_deref(), &pinned, |_| ())
                .map_err(EvolveError::of_discretization(self.time))?;
        Ok(())
    }

    /// Theorem: the class of every generator and the figure-0 stars are what they were. Rounding could break it.
    pub fn verify_class(&self) -> Result<(), EvolveError> {
        let State { metric, homology, spin, time, .. } = self;
        let mesh = self.mesh();
        if let Some(&vertex) = spin.figure_8_vertices(mesh, metric).first() {
            return Err(EvolveError::StarChanged { time: *time, vertex: mesh.file_vertex(VertexId::new(vertex)) });
        }
        let class = Class::new(spin.class(mesh, metric, homology));
        if class != self.class {
            return Err(EvolveError::ClassChanged { time: *time, before: self.class.clone(), after: class });
        }
        Ok(())
    }
}
