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
mod error;
mod file;
mod fingerprint;
mod foreign;
mod look_section;
mod metric_section;
mod motion_sections;
mod names;
mod number;
mod picture_sections;
mod problems;
mod schema;
mod sections;
mod shapes;
mod source;
mod spelling;
mod table;
mod value;

pub use build::{clock_of, phases_as_text};
pub use data::*;
pub use error::{SceneError, SceneErrors};
pub use source::{Location, Source};
