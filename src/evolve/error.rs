//! Why a simulation cannot start, go on after a frame, or ends early.

use super::discretization::DiscretizationError;
use super::frame::UnfitFrame;
use super::over_a_pass::NoPass;
use crate::advice::Advice;
use crate::algebra::CholeskyError;
use crate::frames::ShellError;
use crate::homotopy::{Element, Event};
use crate::immersion::{NoAngle, PinError};
use crate::mesh::{LARGEST_COORDINATE, Mesh, SurfaceError};
use crate::metric::NoMetric;
use crate::polish::PassError;
use crate::spin::{Class, SpinError};
use glam::DVec3;
use std::fmt;

/// What to do about a Poisson problem that cannot be factorized.
const EVEN_OUT: &str = "even out the edge lengths, the weights differ by too many orders of magnitude";

/// Why a program does not fit a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SetupError {
    /// There is no metric at the time of the first frame.
    #[error("{}", .0.error)]
    Metric(#[from] NoMetric),
    /// Its class.
    #[error(transparent)]
    Spin(#[from] SpinError),
    /// Its pins.
    #[error(transparent)]
    Pin(#[from] PinError),
    /// Its target bending angles.
    #[error(transparent)]
    Bending(#[from] NoAngle),
    /// The surface holds arrays of another mesh.
    #[error(transparent)]
    Surface(SurfaceError),
    /// The shape that frames start from is not one of the mesh.
    #[error("the frames are to start from {found} positions, but the mesh has {vertices} vertices; {}", self.remedy())]
    StartCount {
        /// Number of positions.
        found: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// The shape that frames start from is out of reach.
    #[error("the frames are to start with vertex {vertex} at {place:?}; {}", self.remedy())]
    StartPlace {
        /// Its number in the mesh file.
        vertex: usize,
        /// Not finite, or too far away to compute with.
        place: [f64; 3],
    },
    /// Target bending angles of another mesh.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The Poisson problem.
    #[error("{}; {}", .0, self.remedy())]
    Poisson(#[from] CholeskyError),
    /// It has no way over a pass.
    #[error(transparent)]
    Pass(#[from] NoPass),
}

impl From<DiscretizationError> for SetupError {
    fn from(error: DiscretizationError) -> SetupError {
        match error {
            DiscretizationError::Shell(error) => error.into(),
            DiscretizationError::Poisson(error) => error.into(),
        }
    }
}

impl Advice for SetupError {
    fn remedy(&self) -> String {
        match self {
            SetupError::Metric(error) => error.remedy(),
            SetupError::Spin(error) => error.remedy(),
            SetupError::Pin(error) => error.remedy(),
            SetupError::Bending(error) => error.remedy(),
            SetupError::Surface(error) => error.remedy(),
            SetupError::StartCount { .. } => "give one position per vertex".into(),
            SetupError::StartPlace { .. } => {
                format!(
                    "coordinates must be finite and at most {LARGEST_COORDINATE:e}, correct them or use another unit"
                )
            }
            SetupError::Shell(error) => error.remedy(),
            SetupError::Poisson(_) => EVEN_OUT.into(),
            SetupError::Pass(error) => error.remedy(),
        }
    }
}

/// Why a simulation cannot go on after a frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ResumeError {
    /// Its arrays are not those of the mesh.
    #[error(transparent)]
    Unfit(#[from] UnfitFrame),
    /// It has another number or time than the frames of the film.
    #[error("the film of {frames} frames has no frame {frame} at time {time}; {}", self.remedy())]
    NoSuchFrame {
        /// Its number.
        frame: usize,
        /// Number of frames of the film.
        frames: usize,
        /// Its time.
        time: f64,
    },
    /// It is of a surface of other components.
    #[error("it says how far {found} components are, and the surface has {components}; {}", self.remedy())]
    Components {
        /// Of the frame.
        found: usize,
        /// Of the surface.
        components: usize,
    },
    /// Its lengths are no metric.
    #[error(transparent)]
    Metric(#[from] NoMetric),
    /// It is in another class, or what follows from it cannot be computed.
    #[error(transparent)]
    State(#[from] EvolveError),
}

impl Advice for ResumeError {
    fn remedy(&self) -> String {
        match self {
            ResumeError::Unfit(error) => error.remedy(),
            ResumeError::NoSuchFrame { .. } | ResumeError::Components { .. } => "take a frame of this film".into(),
            ResumeError::Metric(error) => error.remedy(),
            ResumeError::State(error) => error.remedy(),
        }
    }
}

/// What changes more between two frames than a film can follow. Vertices are those of the mesh file.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum FarMove {
    /// An edge, by this factor.
    Edge { ends: [u32; 2], factor: f64 },
    /// A pinned vertex.
    Pin { vertex: usize, distance: f64, mean_length: f64 },
}

impl fmt::Display for FarMove {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FarMove::Edge { ends, factor } => {
                write!(f, "the edge between vertices {ends:?} changes its length by the factor {factor:.3e}")
            }
            FarMove::Pin { vertex, distance, mean_length } => write!(
                f,
                "pinned vertex {vertex} is led {distance:.3e} away from where it was at the frame before, and edges are \
                 {mean_length:.3e} long on average"
            ),
        }
    }
}

/// What folds on the way from one frame to the next. Vertices are those of the mesh file.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum FoldedWay {
    /// A hinge: its faces come to lie upon each other.
    Hinge { ends: [usize; 2], place: DVec3 },
    /// A face: its corners come to lie on a line.
    Face { corners: [usize; 3], place: DVec3 },
}

impl FoldedWay {
    /// What an event of a mesh is in the numbers of its file.
    pub(super) fn of(mesh: &Mesh, Event { element, place, .. }: &Event) -> FoldedWay {
        match *element {
            Element::Hinge(edge) => {
                FoldedWay::Hinge { ends: mesh.edge_vertices(edge).map(|v| mesh.file_vertex(v)), place: *place }
            }
            Element::Face(face) => {
                FoldedWay::Face { corners: mesh.corners(face).map(|v| mesh.file_vertex(v)), place: *place }
            }
        }
    }
}

impl fmt::Display for FoldedWay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = match self {
            FoldedWay::Hinge { ends, place } => {
                write!(f, "the edge between vertices {ends:?} folds over")?;
                place
            }
            FoldedWay::Face { corners, place } => {
                write!(f, "the face with vertices {corners:?} vanishes")?;
                place
            }
        };
        write!(f, ", near ({:.3}, {:.3}, {:.3})", place.x, place.y, place.z)
    }
}

/// Why a running simulation ended without a frame.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EvolveError {
    /// The observer said so.
    #[error("stopped after {steps} steps; {}", self.remedy())]
    Stopped {
        /// Steps taken.
        steps: usize,
    },
    /// Frames became NaN.
    #[error(
        "at time {time} the frame of face {face} is no longer finite after {steps} steps, in phase {phase}; {}",
        self.remedy()
    )]
    Diverged {
        /// When.
        time: f64,
        /// The first face whose frame is not finite, by its number in the mesh file.
        face: usize,
        /// Steps taken.
        steps: usize,
        /// Phase, from 0.
        phase: usize,
    },
    /// The class to begin.
    #[error(transparent)]
    Spin(#[from] SpinError),
    /// There is no metric.
    #[error(transparent)]
    Metric(#[from] NoMetric),
    /// There are no places for the pins.
    #[error(transparent)]
    Pin(#[from] PinError),
    /// There are no target bending angles.
    #[error(transparent)]
    Bending(#[from] NoAngle),
    /// Target bending angles of another mesh.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The Poisson problem.
    #[error("at time {time}: {error}; {}", self.remedy())]
    Poisson {
        /// When.
        time: f64,
        /// Why.
        error: CholeskyError,
    },
    /// There is no way over the pass.
    #[error("at time {time} {error}; {}", self.remedy())]
    Pass {
        /// When.
        time: f64,
        /// Why.
        error: PassError,
    },
    /// A frame of the film holds numbers that cannot be kept.
    #[error("at time {time} {}; {}", fault.reason(), self.remedy())]
    Unfit {
        /// When.
        time: f64,
        /// What is wrong with it.
        fault: UnfitFrame,
    },
    /// The way from one frame to the next would take more parts than a film can wait for.
    #[error(
        "on the way to time {time} {what}, so that it would take {parts:.0} parts, and {most} are the limit; {}",
        self.remedy()
    )]
    TooFar {
        /// Of the frame that is to be made.
        time: f64,
        /// How many parts it would take.
        parts: f64,
        /// How many there may be.
        most: usize,
        /// What goes so far.
        what: FarMove,
    },
    /// No regular homotopy leads from a frame to the next, and folds are refused.
    #[error("on the way to frame {frame}, at time {time}, {way}, also when that way is halved {halvings} times; {}", self.remedy())]
    Folds {
        /// The frame that is to be made, from 1.
        frame: usize,
        /// Its time.
        time: f64,
        /// What folds first.
        way: FoldedWay,
        /// How often the way was halved.
        halvings: usize,
    },
    /// A vertex star became figure-8.
    #[error("at time {time} rounding has changed the spin structure at vertex {vertex}; {}", self.remedy())]
    StarChanged {
        /// When.
        time: f64,
        /// Its number in the mesh file.
        vertex: usize,
    },
    /// The class is another.
    #[error("at time {time} rounding has changed the class from {before} to {after}; {}", self.remedy())]
    ClassChanged {
        /// When.
        time: f64,
        /// The class of the film.
        before: Class,
        /// That of the frame.
        after: Class,
    },
}

impl EvolveError {
    /// Whether a shorter way to the same place may not meet this.
    pub(super) fn is_of_step(&self) -> bool {
        matches!(
            self,
            EvolveError::Diverged { .. }
                | EvolveError::StarChanged { .. }
                | EvolveError::ClassChanged { .. }
                | EvolveError::Poisson { .. }
        )
    }

    /// At a time.
    pub(super) fn of_discretization(time: f64) -> impl FnOnce(DiscretizationError) -> EvolveError {
        move |error| match error {
            DiscretizationError::Shell(error) => error.into(),
            DiscretizationError::Poisson(error) => EvolveError::Poisson { time, error },
        }
    }
}

impl Advice for EvolveError {
    fn remedy(&self) -> String {
        match self {
            EvolveError::Stopped { .. } => "run again to resume at the last finished frame".into(),
            EvolveError::Diverged { .. } => "lower `dt` of that phase, or give the film more frames".into(),
            EvolveError::Unfit { .. } => "lower `dt` of the last phase, or use another unit of length".into(),
            EvolveError::TooFar { what: FarMove::Pin { .. }, .. } => {
                "give the film more `frames`, or lead the pin more slowly".into()
            }
            EvolveError::TooFar { what: FarMove::Edge { .. }, .. } => {
                "give the film more `frames`, or raise `max_strain` of the clock".into()
            }
            EvolveError::Folds { .. } => {
                "raise `bending_stiffness`, use a finer mesh there, or give the film more `frames`".into()
            }
            EvolveError::Spin(error) => error.remedy(),
            EvolveError::Metric(error) => error.remedy(),
            EvolveError::Pin(error) => error.remedy(),
            EvolveError::Bending(error) => error.remedy(),
            EvolveError::Shell(error) => error.remedy(),
            EvolveError::Pass { .. } => "use a finer mesh, or change `bending_stiffness`: what is too stiff for its mesh locks, what is too soft does not leave the pass".into(),
            EvolveError::Poisson { .. } => EVEN_OUT.into(),
            EvolveError::StarChanged { .. } => "lower `max_strain` of the clock, or use better triangles there".into(),
            EvolveError::ClassChanged { .. } => "lower `max_strain` of the clock, or use better triangles".into(),
        }
    }
}
