//! One connected component that is relaxed as if it were alone.

use super::cursor::Cursor;
use super::draws::Draws;
use super::phase::{Phase, Schedule};
use crate::evolve::course::{Course, metric_of};
use crate::evolve::error::{EvolveError, SetupError};
use crate::evolve::frame::Frame;
use crate::evolve::places::Placement;
use crate::evolve::program::{Orientation, Start};
use crate::evolve::state::{Mark, State};
use crate::frames::{Shell, Stepper, random_frames, spectral_frames};
use crate::immersion::rimless_frames;
use crate::mesh::{Component, Mesh};
use crate::metric::Metric;
use crate::spin::{Class, Homology, SpinStructure};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A component in units, steps, phases and random frames of its own. So it ends as it would alone, whatever the others
/// are.
#[derive(Debug)]
pub(in crate::evolve) struct Relaxation {
    pub(super) state: State,
    pub(super) among: Among,
    /// The stages of the relaxation of the first frame.
    pub(super) phases: Vec<Phase>,
    pub(super) cursor: Cursor,
    pub(super) stepper: Stepper,
    /// How far frames go of the way that a step is, 1 unless something would fold on it.
    pub(super) share_of_step: f64,
    /// Random frames; `None` for other starts.
    pub(super) draws: Option<Draws>,
    /// L2 length error at which a frame without rims is done.
    pub(super) accuracy: Option<f64>,
    /// Whether nothing that is asked for asks for folds.
    pub(super) is_smooth: bool,
    pub(super) orientation: Orientation,
    pub(super) placement: Placement,
    /// The frame of the film that is being made, from 1.
    pub(super) frame: usize,
    start: Start,
}

/// Which of how many components.
#[derive(Clone, Copy, Debug)]
pub(in crate::evolve) struct Among {
    /// From 0.
    pub number: usize,
    pub of: usize,
}

/// What all components are relaxed from, and with.
pub(in crate::evolve) struct Beginning<'a> {
    pub course: &'a Course,
    pub time: f64,
    pub metric: &'a Arc<Metric>,
    pub homology: &'a Arc<Homology>,
    pub spin: &'a SpinStructure,
    /// Positions of the mesh, |V|, if it has any.
    pub positions: Option<&'a [DVec3]>,
    pub start: &'a Start,
    pub schedule: &'a Schedule,
    pub accuracy: Option<f64>,
    pub orientation: Orientation,
    pub is_smooth: bool,
}

impl Relaxation {
    /// Lines 1 to 6 of Algorithm 2 for one of the components.
    pub fn new(component: Component, among: Among, beginning: &Beginning) -> Result<Relaxation, SetupError> {
        let Beginning { course, time, .. } = *beginning;
        let mesh = component.mesh.clone();
        let metric = metric_of(&component, beginning.metric, time)?;
        let homology = match among.of {
            1 => beginning.homology.clone(),
            _ => Arc::new(Homology::new(&mesh, &metric)),
        };
        let spin = SpinStructure::of_known(component.edges.pick(beginning.spin.transports()));
        let phases = beginning.schedule.phases().to_vec();
        let stepper = |shell: &Shell| {
            let mut stepper = Stepper::new(shell);
            phases.first().inspect(|first| {
                stepper.prepare(shell, &first.step_options(first.dt.in_face_areas(shell.face_count())));
            });
            stepper
        };
        let start = match beginning.start {
            Start::Shape { positions, is_mirrored } => {
                Start::Shape { positions: component.vertices.pick(positions), is_mirrored: *is_mirrored }
            }
            other => other.clone(),
        };
        let original = beginning.positions.map(|whole| component.vertices.pick(whole));
        let placement = Placement::new(&mesh, &metric, &start, original);
        let frames = |shell: &Shell| frames_of(&start, &mesh, &metric, shell);
        let (state, stepper) = State::new(component, homology, metric.clone(), spin, (course, time), stepper, frames)?;
        Ok(Relaxation {
            state,
            among,
            phases,
            cursor: Cursor::default(),
            stepper,
            share_of_step: 1.0,
            draws: if let Start::Random(seed) = start { Some(Draws::new(seed)) } else { None },
            accuracy: beginning.accuracy,
            is_smooth: beginning.is_smooth,
            orientation: beginning.orientation,
            placement,
            frame: 1,
            start,
        })
    }

    pub fn state(&self) -> &State {
        &self.state
    }

    /// For a change of what is asked for.
    pub fn state_mut(&mut self) -> &mut State {
        &mut self.state
    }

    pub fn among(&self) -> Among {
        self.among
    }

    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Positions as they lie in space, |V|, see [`Placement::place`].
    pub fn placed(
        &mut self,
        previous: Option<Vec<DVec3>>,
        is_looping: bool,
        is_of_relaxation: bool,
    ) -> (Vec<DVec3>, bool) {
        let from_nowhere = is_of_relaxation && self.draws.is_some();
        let always = is_looping || from_nowhere;
        self.placement.place(&mut self.state, previous, always, from_nowhere)
    }

    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// Other phases in place of those that are left; the cursor stays.
    pub fn set_phases(&mut self, schedule: &Schedule) {
        self.phases = schedule.phases().to_vec();
    }

    pub fn cursor(&self) -> Cursor {
        self.cursor
    }

    /// Begins to make a frame of the film, from 1.
    pub fn begin_frame(&mut self, frame: usize) {
        self.frame = frame;
    }

    /// Starts over in the class with these values of q.
    pub fn begin_class(&mut self, course: &Course, class: Class) -> Result<(), EvolveError> {
        self.state.change_class(course, class)?;
        let frames = frames_of(&self.start, self.state.mesh(), self.state.metric(), self.state.shell());
        self.state.set_face_frames(frames);
        self.cursor = Cursor::default();
        Ok(())
    }

    /// Goes on after a frame of an earlier run, which is in this class.
    pub fn resume(
        &mut self,
        course: &Course,
        frame: &Frame,
        whole: &Arc<Metric>,
        cursor: Cursor,
        class: Class,
    ) -> Result<(), EvolveError> {
        self.state.restore(course, frame, whole, class)?;
        (self.cursor, self.frame) = (cursor, frame.report.frame);
        Ok(())
    }

    /// What there is to go back to.
    pub fn mark(&self) -> (Mark, Cursor) {
        (self.state.mark(), self.cursor)
    }

    /// Goes back to where it was.
    pub fn go_back(&mut self, course: &Course, (mark, cursor): &(Mark, Cursor)) -> Result<(), EvolveError> {
        self.cursor = *cursor;
        self.state.go_back(course, mark)
    }

    /// Takes the last phase up again if it is over.
    pub fn stay_in_last_phase(&mut self) {
        if self.cursor.phase >= self.phases.len() {
            self.cursor = self.cursor.at_start_of(self.phases.len().saturating_sub(1));
        }
    }

    /// Whether some phases are not done.
    pub fn is_on_the_way(&self) -> bool {
        self.cursor.phase < self.phases.len()
    }

    /// Whether all phases are done and the last one met its tolerance.
    pub fn has_converged(&self) -> bool {
        !self.is_on_the_way() && self.cursor.settled
    }
}

/// What a class of the whole surface is on each component. Generators come component by component.
pub(in crate::evolve) fn split(components: &[Relaxation], class: &Class) -> Vec<Class> {
    let mut rest = class.digits();
    let own = |relaxation: &Relaxation| {
        let own;
        (own, rest) = rest.split_at(relaxation.state().betti());
        Class::new(own.to_vec())
    };
    components.iter().map(own).collect()
}

/// The frames to start from, |F|.
fn frames_of(start: &Start, mesh: &Mesh, metric: &Metric, shell: &Shell) -> Vec<DQuat> {
    match start {
        Start::Random(seed) => random_frames(mesh.face_count(), *seed),
        Start::Spectral => spectral_frames(shell),
        Start::Shape { positions, .. } => rimless_frames(mesh, metric, shell, positions),
    }
}
