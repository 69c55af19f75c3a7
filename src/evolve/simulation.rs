//! Algorithm 2 in time: a surface whose metric changes, frame by frame.

use super::ahead::contradictions;
use super::ahead::{LookAhead, keys_of, origin_of};
use super::course::Course;
use super::error::{EvolveError, ResumeError, SetupError};
use super::finish::{Finished, Which, finish};
use super::frame::{Frame, check_face_frames};
use super::over_a_pass::BothWays;
use super::pace::{Fold, Pace};
use super::places::Row;
use super::program::{Polishing, Program};
use super::progress::Observer;
use super::relax::{Among, Beginning, Phase, PhaseError, Relaxation, Schedule, split};
use super::report::{compare, measure};
use crate::algebra::Complex;
use crate::digest::Key;
use crate::immersion::spin_of_immersion;
use crate::mesh::{Component, Mesh, Surface, VertexId, first_out_of_reach};
use crate::metric::{Metric, MetricPart, MetricProgram, NoMetric};
use crate::spin::{Class, Homology, SpinError, SpinStructure};
use crate::timeline::Clock;
use glam::{DQuat, DVec3};
use std::sync::Arc;
use std::time::Instant;

/// A thin shell whose metric, bending and pins follow a program, and its state: one unit quaternion per face.
///
/// ```
/// # use immerse::{mesh::shapes, metric::{Lengths, MetricProgram}, evolve::{Program, Simulation, Unobserved}};
/// let surface = shapes::sphere(1.0, 4)?;
/// let program = Program::of(MetricProgram::of(Lengths::of_surface(&surface)?));
/// let mut simulation = Simulation::new(surface, program)?;
/// let frame = simulation.next_frame(&mut Unobserved)?;
/// assert!(frame.report.l2_length_error < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    pub(super) mesh: Arc<Mesh>,
    /// Positions of the mesh, |V|, if it has any.
    mesh_positions: Option<Vec<DVec3>>,
    /// Positions that frames start from, |V|, if they do.
    start_positions: Option<Vec<DVec3>>,
    pub(super) homology: Arc<Homology>,
    pub(super) course: Course,
    pub(super) clock: Clock,
    pub(super) pace: Pace,
    pub(super) fold: Fold,
    pub(super) both_ways: Option<BothWays>,
    polish: Polishing,
    max_bending_growth: f64,
    /// Stands for what all frames depend on, see [`Simulation::frame_keys`].
    origin: Key,
    /// The components, each relaxed on its own.
    pub(super) components: Vec<Relaxation>,
    /// The last frame that was made; 0 before the first.
    pub(super) frame: usize,
    /// Edge lengths and what they determine, at the time of the last frame.
    pub(super) metric: Arc<Metric>,
    pub(super) curvature_error: Option<f64>,
    /// The last frame, which the next one is compared with.
    pub(super) previous: Option<Arc<Frame>>,
}

impl Simulation {
    /// Lines 1 to 6 of Algorithm 2.
    ///
    /// # Errors
    /// [`SetupError`] saying which part of the program does not fit the surface.
    pub fn new(surface: Surface, program: Program) -> Result<Simulation, SetupError> {
        surface.check().map_err(SetupError::Surface)?;
        let origin = origin_of(&surface, &program);
        let Surface { mesh, positions: mesh_positions, .. } = surface;
        let Program { metric, bending, pins, class, start, clock, pace, fold, polish, max_bending_growth, .. } =
            program;
        if let Some(found) = start.positions().map(<[DVec3]>::len).filter(|found| *found != mesh.vertex_count()) {
            return Err(SetupError::StartCount { found, vertices: mesh.vertex_count() });
        }
        if let Some((index, place)) = start.positions().and_then(first_out_of_reach) {
            return Err(SetupError::StartPlace { vertex: mesh.file_vertex(VertexId::new(index)), place });
        }
        let both_ways = BothWays::of(pace, &mesh, mesh_positions.as_deref())?;
        let mesh = Arc::new(mesh);
        let time = clock.time(1);
        let course = Course::new(mesh.clone(), metric, bending, pins, time)?;
        let (metric, curvature_error) = course.last();
        let homology = Arc::new(Homology::new(&mesh, &metric));
        let spin = class.spin(&mesh, &metric, &homology, mesh_positions.as_deref())?;
        let beginning = Beginning {
            course: &course,
            time,
            metric: &metric,
            homology: &homology,
            spin: &spin,
            positions: mesh_positions.as_deref(),
            start: &start,
            schedule: &program.schedule,
            accuracy: program.accuracy,
            orientation: program.orientation,
            is_smooth: program.is_smooth,
        };
        let components = Component::all_of(&mesh);
        let of = components.len();
        let relaxation = |(number, component)| Relaxation::new(component, Among { number, of }, &beginning);
        let components = components.into_iter().enumerate().map(relaxation).collect::<Result<_, _>>()?;
        Ok(Simulation {
            mesh,
            mesh_positions,
            start_positions: start.positions().map(<[DVec3]>::to_vec),
            homology,
            course,
            clock,
            pace,
            fold,
            both_ways,
            polish,
            max_bending_growth,
            origin,
            components,
            frame: 0,
            metric,
            curvature_error,
            previous: None,
        })
    }

    /// Relaxes the frames at the present time through all phases that are left, and integrates the surface.
    ///
    /// # Errors
    /// [`EvolveError`] if the observer stops it or frames are no longer finite.
    pub fn relax(&mut self, observer: &mut dyn Observer) -> Result<Arc<Frame>, EvolveError> {
        let begin = Instant::now();
        self.components.iter_mut().try_for_each(|relaxation| relaxation.relax(observer))?;
        self.frame_since(begin, observer)
    }

    /// Takes so many steps of the relaxation at the present time, or fewer until all phases are done, and integrates the
    /// surface.
    ///
    /// # Errors
    /// As [`Simulation::relax`].
    pub fn advance(&mut self, steps: usize, observer: &mut dyn Observer) -> Result<Arc<Frame>, EvolveError> {
        let begin = Instant::now();
        self.components.iter_mut().try_for_each(|relaxation| relaxation.advance(steps, observer))?;
        self.frame_since(begin, observer)
    }

    /// Goes on after a frame of an earlier run of the same program, to the same bits.
    ///
    /// # Errors
    /// [`ResumeError`] if the frame does not belong to this film.
    pub fn resume(&mut self, from: Arc<Frame>) -> Result<(), ResumeError> {
        from.fits(&self.mesh)?;
        let (frame, time) = (from.report.frame, self.clock.time(from.report.frame));
        if frame == 0 || frame > self.clock.frames() || from.report.time != time {
            return Err(ResumeError::NoSuchFrame { frame, frames: self.clock.frames(), time: from.report.time });
        }
        let cursors = from.report.cursors();
        if cursors.len() != self.components.len() {
            return Err(ResumeError::Components { found: cursors.len(), components: self.components.len() });
        }
        let no_metric = |error| NoMetric { time, part: MetricPart::Lengths, error };
        let metric = Arc::new(Metric::new(&self.mesh, from.edge_lengths.clone()).map_err(no_metric)?);
        let classes = match self.pace {
            Pace::EachClass => split(&self.components, &Class::of_number(frame - 1, self.homology.betti())),
            Pace::Steps(_) | Pace::Settle(_) | Pace::BothWays(_) => {
                self.components.iter().map(|relaxation| relaxation.state().class().clone()).collect()
            }
        };
        for ((relaxation, cursor), class) in self.components.iter_mut().zip(cursors).zip(classes) {
            relaxation.resume(&self.course, &from, &metric, cursor, class)?;
            relaxation.state().verify_class()?;
        }
        (self.frame, self.metric, self.previous) = (frame, metric, Some(from));
        Ok(())
    }

    /// Sentences about pins that no surface with the lengths of the metric can keep, at the time of any frame. Surfaces are
    /// found all the same, but do not have all lengths.
    ///
    /// # Errors
    /// [`EvolveError`] where there is no metric or no place for a pin.
    pub fn pin_contradictions(&self) -> Result<Vec<String>, EvolveError> {
        contradictions(&self.mesh, &self.course, &self.clock)
    }

    /// The class of the positions that frames start from; `None` where they come from none. The error is
    /// [`SpinError::NotAnImmersion`] where those are in no class.
    pub fn class_of_start(&self) -> Option<Result<Class, SpinError>> {
        let Simulation { mesh, metric, homology, .. } = self;
        let spin = spin_of_immersion(mesh, metric, self.start_positions.as_deref()?);
        Some(spin.map(|spin| Class::new(spin.class(mesh, metric, homology))))
    }

    /// The class that is asked for, of all components together.
    pub fn class(&self) -> Class {
        Class::new(self.components.iter().flat_map(|part| part.state().class().digits()).copied().collect())
    }

    /// Connectivity.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// Edge lengths and what they determine, at the time of the last frame.
    pub fn metric(&self) -> &Metric {
        &self.metric
    }

    /// The pinned vertices, each once, in order.
    pub fn pinned(&self) -> &[VertexId] {
        self.course.pins().vertices()
    }

    /// Generators of the homology of the whole surface.
    pub fn homology(&self) -> &Homology {
        &self.homology
    }

    /// Edge lengths as a function of time, and what was found of them so far.
    pub fn metric_program(&self) -> &MetricProgram {
        self.course.program()
    }

    /// The times of the frames.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// The key of every frame of the film, in order, found without simulating. So this is also where a film is refused
    /// that has no metric, bending angles or places for pins at the time of some frame.
    ///
    /// # Errors
    /// [`EvolveError::Metric`], [`EvolveError::Pin`], [`EvolveError::Bending`] at the first time at which there is none.
    pub fn frame_keys(&mut self) -> Result<Vec<Key>, EvolveError> {
        let components = self.components.iter().map(|relaxation| relaxation.state().component()).collect();
        keys_of(self.origin, &self.clock, &mut LookAhead::new(&mut self.course, components, self.pace, self.fold))
    }

    /// The number of the last frame that was made or gone on after; 0 before the first.
    pub fn last_frame(&self) -> usize {
        self.frame
    }

    /// The state: unit quaternions, |F|.
    pub fn face_frames(&self) -> Vec<DQuat> {
        let mut whole = vec![DQuat::IDENTITY; self.mesh.face_count()];
        self.components.iter().map(Relaxation::state).for_each(|state| {
            state.component().faces.put(state.face_frames(), &mut whole);
        });
        whole
    }

    /// Takes other frames for the state, |F|.
    ///
    /// # Errors
    /// [`ResumeError::Unfit`] unless there is one unit quaternion per face.
    pub fn set_face_frames(&mut self, frames: &[DQuat]) -> Result<(), ResumeError> {
        check_face_frames(frames, self.mesh.face_count())?;
        for relaxation in &mut self.components {
            let own = relaxation.state().component().faces.pick(frames);
            relaxation.state_mut().set_face_frames(own);
        }
        Ok(())
    }

    /// The regular homotopy class, as signs of τ.
    pub fn spin(&self) -> SpinStructure {
        let mut whole = vec![Complex::ONE; self.mesh.edge_count()];
        self.components.iter().map(Relaxation::state).for_each(|state| {
            state.component().edges.put(state.spin().transports(), &mut whole);
        });
        SpinStructure::of_known(whole)
    }

    /// The phases of the relaxation of the first frame, the same for every component.
    pub fn phases(&self) -> &[Phase] {
        self.components.first().map_or(&[], |part| part.phases())
    }

    /// Changes the phases of every component.
    ///
    /// # Errors
    /// [`PhaseError`] if they are not in order then; nothing is changed.
    pub fn change_phases(&mut self, change: impl FnOnce(&mut Vec<Phase>)) -> Result<(), PhaseError> {
        let mut phases = self.phases().to_vec();
        change(&mut phases);
        let schedule = Schedule::new(phases)?;
        self.components.iter_mut().for_each(|part| part.set_phases(&schedule));
        Ok(())
    }

    /// The frame as it is now, polished if it is to be; the work on it began at a time of the wall clock.
    ///
    /// # Errors
    /// [`EvolveError::Unfit`] if it could not be read again: some number is not finite. [`EvolveError::Stopped`] if the
    /// observer stops it.
    pub(super) fn frame_since(
        &mut self,
        begin: Instant,
        observer: &mut dyn Observer,
    ) -> Result<Arc<Frame>, EvolveError> {
        let row = Row {
            mesh_positions: self.mesh_positions.as_deref(),
            previous: self.previous.as_ref().map(|previous| &*previous.positions),
            is_looping: self.clock.is_looping(),
            is_of_relaxation: matches!(self.pace, Pace::Steps(_)),
        };
        let positions = match self.both_ways.iter().find_map(|film| film.frame(self.frame)) {
            Some(places) => places.to_vec(),
            None => row.place(&mut self.components, self.mesh.vertex_count()),
        };
        let which = Which { frame: self.frame.max(1), of: self.clock.frames(), pace: self.pace };
        let Finished { positions, face_frames, reports } = match self.polish.reach(which, &self.components) {
            Some(reach) => finish(&self.components, positions, reach, self.max_bending_growth, observer)?,
            None => Finished::unpolished(positions),
        };
        let Simulation { mesh, metric, homology, components, .. } = self;
        let (rims, mut report) = measure(mesh, metric, homology, components, &positions, &reports);
        report.frame = self.frame;
        report.time = self.clock.time(self.frame.max(1));
        report.curvature_error = self.curvature_error;
        report.on_the_way = matches!(self.pace, Pace::Steps(_) | Pace::BothWays(_))
            && (self.course.changes() || self.components.iter().any(Relaxation::is_on_the_way));
        let mut frame = Frame {
            positions,
            face_frames: face_frames.unwrap_or_else(|| self.face_frames()),
            spin: self.spin(),
            edge_lengths: self.metric.edge_lengths().to_vec(),
            rims,
            report,
        };
        if let Some(previous) = &self.previous {
            compare(&self.mesh, previous, &mut frame);
        }
        frame.report.seconds = begin.elapsed().as_secs_f64();
        frame.fits(&self.mesh).map_err(|fault| EvolveError::Unfit { time: frame.report.time, fault })?;
        let frame = Arc::new(frame);
        self.previous = Some(frame.clone());
        Ok(frame)
    }
}
