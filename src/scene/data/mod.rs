//! A scene as plain data: what the file says, after types and keys were checked and defaults filled in.
//!
//! Angles are in degrees here, as in the file. Lengths and times are unit-free. Nothing in this module
//! computes; `scene::build` turns it into the validated values of the rooms.

use std::path::PathBuf;

use super::Source;
use crate::mesh::Weld;

mod checks;
mod files;
mod look;
mod mesh;
mod metric;
mod motion;
mod phase;
mod picture;
mod time;

pub use checks::{ChecksSection, FilmChecksSection};
pub use files::FilesSection;
pub use look::{
    ColorSection, CutSection, LineSection, LookSection, MaterialName, PatternAlong, PatternSection, TextSection,
};
pub use mesh::MeshSection;
pub use metric::{
    ChangeKind, CurvatureRegionSection, LengthSource, MetricChangeSection, MetricKeySection, MetricSection,
    RicciSection,
};
pub use motion::{
    BendingFrom, BendingRegionSection, BendingSection, MotionSection, PinSection, SpinSection, StartFrom, StartSection,
};
pub use phase::{LikeDefault, PhaseSection, RelaxationSection};
pub use picture::{
    AnimationFormat, CameraKeySection, CameraSection, ExportFormat, Framed, LightSection, OutputSection,
};
pub use time::{ClockSection, NumberSection, PolishSection};

/// A whole scene.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// File stem of the scene, the default name of its output folder.
    pub name: String,
    /// Folder of the scene file; relative paths in it start here.
    pub folder: PathBuf,
    /// The surface.
    pub mesh: MeshSection,
    /// What becomes of the seams of its file; left out, what is usual for the format.
    pub weld: Option<Weld>,
    /// Numbers by name, for formulas.
    pub parameters: Vec<(String, NumberSection)>,
    /// Its edge lengths.
    pub metric: MetricSection,
    /// Its regular homotopy class.
    pub spin: SpinSection,
    /// Where the frames start.
    pub start: StartSection,
    /// Stages of the relaxation; empty means the default ones.
    pub phases: Vec<PhaseSection>,
    /// What holds for all of them.
    pub relaxation: RelaxationSection,
    /// Target bending angles.
    pub bending: Option<BendingSection>,
    /// Point constraints.
    pub pins: Vec<PinSection>,
    /// Frames and their times.
    pub clock: ClockSection,
    /// Which frames are polished.
    pub polish: PolishSection,
    /// The view.
    pub camera: CameraSection,
    /// Lights; empty means the studio's three.
    pub lights: Vec<LightSection>,
    /// Colours and lines.
    pub look: LookSection,
    /// Picture size and format.
    pub output: OutputSection,
    /// What the result must satisfy.
    pub checks: ChecksSection,
    /// Where the file says it, for the messages of later stages.
    pub source: Source,
}
