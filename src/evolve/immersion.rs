//! The front door: a mesh and a metric in, a surface out.

use super::error::{EvolveError, SetupError};
use super::frame::Frame;
use super::program::{AskedClass, Orientation, Polishing, Program, Start};
use super::progress::{Observer, Unobserved};
use super::relax::Schedule;
use super::report::FrameReport;
use super::simulation::Simulation;
use crate::advice::Advice;
use crate::immersion::{Pins, TargetBending};
use crate::mesh::{Mesh, Surface, WriteError, write_obj};
use crate::metric::{Lengths, Metric, MetricProgram};
use crate::spin::Class;
use crate::timeline::Clock;
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// An isometric immersion that is asked for: a metric, a class, and what frames start from.
///
/// ```
/// use immerse::{Immersion, Mesh, Metric};
///
/// // The boundary of a tetrahedron, with one edge shorter than the others.
/// let mesh = Mesh::from_faces(4, &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])?;
/// let metric = Metric::from_fn(&mesh, |a, b| if a + b == 1 { 0.8 } else { 1.0 })?;
/// let shape = Immersion::of(&mesh, &metric).seed(0).relax()?;
/// let [a, b] = [shape.positions()[0], shape.positions()[1]];
/// assert!((a.distance(b) - 0.8).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Immersion<'a> {
    mesh: &'a Mesh,
    positions: Option<&'a [DVec3]>,
    program: Program,
    has_schedule: bool,
}

/// Why there is no surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImmersionError {
    /// What is asked for does not fit the mesh.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The relaxation ended early.
    #[error(transparent)]
    Evolve(#[from] EvolveError),
}

impl Advice for ImmersionError {
    fn remedy(&self) -> String {
        match self {
            ImmersionError::Setup(error) => error.remedy(),
            ImmersionError::Evolve(error) => error.remedy(),
        }
    }
}

impl<'a> Immersion<'a> {
    /// Of a metric on a mesh, from random frames of seed 0, in the class of all zeros, through the default phases.
    pub fn of(mesh: &'a Mesh, metric: &Metric) -> Immersion<'a> {
        let lengths = Lengths::fixed(metric.edge_lengths().to_vec());
        let program = Program::of(MetricProgram::of(lengths));
        Immersion { mesh, positions: None, program, has_schedule: false }
    }

    /// In this regular homotopy class, one digit per generator. Left out, it is that of the positions which are known,
    /// or all zeros.
    pub fn class(mut self, class: Class) -> Self {
        self.program.class = AskedClass::Of(class);
        self
    }

    /// From independent uniform frames of this seed.
    pub fn seed(mut self, seed: u64) -> Self {
        self.program.start = Start::Random(seed);
        self
    }

    /// From the frames of a shape with these vertices, |V|. The class is theirs unless another one is asked for, and the
    /// surface is laid upon them. They are near to where they belong, so that only the last of the default phases is gone
    /// through.
    pub fn start_at(mut self, positions: &'a [DVec3]) -> Self {
        self.program.start = Start::at(positions.to_vec());
        self.positions = Some(positions);
        self
    }

    /// As this one of two mirror images.
    pub fn orientation(mut self, orientation: Orientation) -> Self {
        self.program.orientation = orientation;
        self
    }

    /// With vertices that are held in place or led along.
    pub fn pins(mut self, pins: Pins) -> Self {
        self.program.pins = pins;
        self
    }

    /// With target bending angles.
    pub fn bending(mut self, bending: TargetBending) -> Self {
        self.program.bending = Some(bending);
        self.program.is_smooth = false;
        self
    }

    /// Through these phases.
    pub fn schedule(mut self, schedule: Schedule) -> Self {
        self.program.schedule = schedule;
        self.has_schedule = true;
        self
    }

    /// With these frames polished; left out, it is the last one. Surfaces with many faces take long.
    pub fn polish(mut self, polish: Polishing) -> Self {
        self.program.polish = polish;
        self
    }

    /// Done as soon as the L2 length error is at most this and there are no rims.
    pub fn accuracy(mut self, l2_length_error: f64) -> Self {
        self.program.accuracy = Some(l2_length_error);
        self
    }

    /// Over time: a metric that changes, at the times of a clock. Its frames come from [`Immersion::simulation`].
    pub fn film(mut self, metric: MetricProgram, clock: Clock) -> Self {
        self.program.metric = metric;
        self.program.clock = clock;
        self
    }

    /// The simulation, to be gone through frame by frame or step by step.
    ///
    /// # Errors
    /// [`SetupError`] saying what does not fit the mesh.
    pub fn simulation(self) -> Result<Simulation, SetupError> {
        let Immersion { mesh, positions, mut program, has_schedule } = self;
        if !has_schedule && program.start.positions().is_some() {
            program.schedule = Schedule::of_last_phase();
        }
        let surface = Surface {
            mesh: mesh.clone(),
            positions: positions.map(<[DVec3]>::to_vec),
            coordinates: None,
            edge_lengths: None,
            repairs: Vec::new(),
        };
        Simulation::new(surface, program)
    }

    /// Finds the surface. Prints nothing; see [`Immersion::relax_observed`] to watch and to stop.
    ///
    /// # Errors
    /// [`ImmersionError`]
    pub fn relax(self) -> Result<ImmersedSurface, ImmersionError> {
        self.relax_observed(&mut Unobserved)
    }

    /// As [`Immersion::relax`]; the observer is told of every step and may end it with
    /// [`ControlFlow::Break`](std::ops::ControlFlow::Break).
    ///
    /// # Errors
    /// [`ImmersionError`]; [`EvolveError::Stopped`] if the observer said so.
    pub fn relax_observed(self, observer: &mut dyn Observer) -> Result<ImmersedSurface, ImmersionError> {
        let mut simulation = self.simulation()?;
        let frame = simulation.next_frame(observer)?;
        Ok(ImmersedSurface { mesh: simulation.mesh().clone(), frame })
    }
}

/// A surface in space, and what it is worth.
#[derive(Clone, Debug)]
pub struct ImmersedSurface {
    mesh: Arc<Mesh>,
    frame: Arc<Frame>,
}

impl ImmersedSurface {
    /// Connectivity.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Vertices, |V|.
    pub fn positions(&self) -> &[DVec3] {
        &self.frame.positions
    }

    /// Length errors, rims, pinch points, the class that was measured, and more.
    pub fn report(&self) -> &FrameReport {
        &self.frame.report
    }

    /// The whole state, with the quaternion field and the spin structure.
    pub fn frame(&self) -> &Arc<Frame> {
        &self.frame
    }

    /// Writes vertices and faces as a Wavefront OBJ file.
    ///
    /// # Errors
    /// [`WriteError`] if the system refuses; then no part of the file is left.
    pub fn write_obj(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        write_obj(path.as_ref(), &self.mesh, &self.frame.positions)
    }
}
