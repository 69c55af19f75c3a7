//! All that a simulation is asked for.

use super::pace::{Fold, Pace};
use super::relax::Schedule;
use crate::immersion::{Pins, TargetBending, spin_of_immersion};
use crate::mesh::Mesh;
use crate::metric::{Metric, MetricProgram};
use crate::spin::{Class, Homology, SpinError, SpinStructure};
use crate::timeline::Clock;
use crate::tuning::MAX_BENDING_GROWTH;
use glam::DVec3;

/// What the surface is to be over time, what it starts from, and how it gets there.
///
/// ```
/// # use immerse::{mesh::shapes, metric::{Lengths, MetricProgram}, evolve::{Program, AskedClass}};
/// let surface = shapes::torus(1.0, 0.4, 24, 10)?;
/// let metric = MetricProgram::of(Lengths::of_surface(&surface)?);
/// let program = Program { class: AskedClass::Of("01".parse()?), ..Program::of(metric) };
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Program {
    /// Edge lengths as a function of time.
    pub metric: MetricProgram,
    /// Target bending angles; without any the shell is flat at rest.
    pub bending: Option<TargetBending>,
    /// Vertices that are held in place or led along.
    pub pins: Pins,
    /// The regular homotopy class.
    pub class: AskedClass,
    /// The frames to start from.
    pub start: Start,
    /// Which of two mirror images random and spectral frames end in.
    pub orientation: Orientation,
    /// The phases of the relaxation of the first frame.
    pub schedule: Schedule,
    /// L2 length error at which a frame without rims is done; without it a frame is done when it has settled.
    pub accuracy: Option<f64>,
    /// Whether frames are settled with stiffer bending first, which smooths out what the metric does not ask for. Right
    /// where nothing asks for folds.
    pub is_smooth: bool,
    /// The times of the frames.
    pub clock: Clock,
    /// What happens between two frames.
    pub pace: Pace,
    /// Whether something may fold on the way from one frame to the next.
    pub fold: Fold,
    /// Which frames are polished.
    pub polish: Polishing,
    /// By which share polish may make the mean bending angle grow.
    pub max_bending_growth: f64,
}

impl Program {
    /// One frame with these edge lengths, from random frames through the default phases.
    pub fn of(metric: MetricProgram) -> Program {
        Program {
            metric,
            bending: None,
            pins: Pins::default(),
            class: AskedClass::OfMesh,
            start: Start::default(),
            orientation: Orientation::default(),
            schedule: Schedule::default(),
            accuracy: None,
            is_smooth: true,
            clock: Clock::STILL,
            pace: Pace::default(),
            fold: Fold::default(),
            polish: Polishing::default(),
            max_bending_growth: MAX_BENDING_GROWTH,
        }
    }
}

/// Which frames of a film are polished.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Polishing {
    /// None: positions are those that frames integrate to.
    Off,
    /// The last one, and of a film with a class a frame all: nothing follows after them, so that they may go far for what they gain.
    #[default]
    Last,
    /// Every one, each by as little as it takes, so that frames lie as near to each other as before.
    Every,
}

/// The class that is asked for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AskedClass {
    /// That of the positions of the mesh, or zeros where it has none.
    #[default]
    OfMesh,
    /// That of the positions of the mesh, which it must have.
    OfPositions,
    /// This one.
    Of(Class),
    /// Every class in turn, one a frame, each relaxed from the start. Goes with [`Pace::EachClass`].
    All,
}

impl AskedClass {
    /// The spin structure in this class; `positions` are those of the mesh, |V|, if it has any.
    pub(super) fn spin(
        &self,
        mesh: &Mesh,
        metric: &Metric,
        homology: &Homology,
        positions: Option<&[DVec3]>,
    ) -> Result<SpinStructure, SpinError> {
        let of = |class: &Class| SpinStructure::of_class(mesh, metric, homology, class.digits());
        match (self, positions) {
            (AskedClass::Of(class), _) => of(class),
            // There is nothing to read where there is but one class.
            (AskedClass::OfMesh, _) if homology.betti() == 0 => Ok(SpinStructure::new(mesh, metric, homology)),
            (AskedClass::OfMesh, None) | (AskedClass::All, _) => of(&Class::zeros(homology.betti())),
            (AskedClass::OfPositions, None) => Err(SpinError::NoPositions),
            (AskedClass::OfMesh | AskedClass::OfPositions, Some(positions)) => {
                spin_of_immersion(mesh, metric, positions)
            }
        }
    }
}

/// Where frames start.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// Independent uniform frames from this seed.
    Random(u64),
    /// The lowest modes of the connection Laplacian.
    Spectral,
    /// The frames of a shape.
    Shape {
        /// Its vertices, |V|.
        positions: Vec<DVec3>,
        /// Whether it is the mirror image of where the film is going, so that it cannot be laid upon it.
        is_mirrored: bool,
    },
}

impl Start {
    /// The frames of a shape with these vertices, |V|.
    pub fn at(positions: Vec<DVec3>) -> Start {
        Start::Shape { positions, is_mirrored: false }
    }

    /// The positions, if there are any.
    pub fn positions(&self) -> Option<&[DVec3]> {
        match self {
            Start::Shape { positions, .. } => Some(positions),
            Start::Random(_) | Start::Spectral => None,
        }
    }
}

impl Default for Start {
    fn default() -> Start {
        Start::Random(0)
    }
}

/// Which of two mirror images is taken. Lengths cannot tell them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Orientation {
    /// That of the mesh's positions where their lengths are asked for, else the one whose front is outside: of
    /// positive enclosed volume.
    #[default]
    Outward,
    /// Whichever comes.
    AsItComes,
}
