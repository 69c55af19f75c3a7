//! What the scene file says: TOML in, plain data with defaults filled in out, or every mistake at once.
//!
//! ```
//! use immerse::scene::Scene;
//!
//! let scene = Scene::parse("[mesh]\nshape = \"sphere\"\nradius = 2", "ball", ".".as_ref()).unwrap();
//! assert_eq!(scene.clock.frames, 1);
//!
//! let mistakes = Scene::parse("[mesh]\nshape = \"spere\"", "ball", ".".as_ref()).unwrap_err();
//! assert!(mistakes.to_string().contains("did you mean `sphere`?"));
//! ```

pub mod build;
mod complaints;
mod data;
mod digests;
mod error;
mod file;
mod foreign;
mod keys;
mod reference;
mod schema;
mod sections;
mod sequence;
mod source;
mod texts;

pub use build::{clock_of, phases_as_text};
pub use data::{
    AnimationFormat, BendingFrom, BendingRegionSection, BendingSection, CameraKeySection, CameraSection, ChangeKind,
    ChecksSection, ClockSection, ColorSection, CurvatureRegionSection, CutSection, ExportFormat, FilesSection,
    FilmChecksSection, Framed, LengthSource, LightSection, LikeDefault, LineSection, LookSection, MaterialName,
    MeshSection, MetricChangeSection, MetricKeySection, MetricSection, MotionSection, NumberSection, OutputSection,
    PatternAlong, PatternSection, PhaseSection, PinSection, RelaxationSection, RicciSection, Scene, SpinSection,
    StartFrom, StartSection, TextSection,
};
pub use error::{SceneError, SceneErrors};
pub(crate) use keys::{nearest, suggestion};
pub use source::{Location, Source};
pub(crate) use texts::split_setting;
