//! A software renderer: a triangulated surface and the curves on it become a picture.
//!
//! The passage of a frame: the surface is moved before the eye ([`Scenery`], [`Camera`]), it is found
//! out how much light each part of it sees, triangles and lines are drawn into tiles of samples that
//! remember who is seen and how far, each primitive is shaded once per pixel, and the samples are
//! filtered into a [`Film`].

mod bins;
mod camera;
mod camera_motion;
mod canvas;
mod color;
mod color_map;
mod error;
mod extent;
mod field;
mod film;
mod filter;
mod fragments;
mod frame;
mod framing;
mod gaps;
mod ground;
mod intersect;
mod lanes;
mod layers;
mod legend;
mod light;
mod lines;
mod look;
mod material;
mod metadata;
mod moments;
mod openexr;
mod output;
mod overlay;
mod pattern;
mod png;
mod presets;
mod project;
mod raster;
mod samples;
mod scenery;
mod shade;
mod stage;
mod text;
mod ticks;
mod tile;
mod trace;
mod tube;
mod visibility;

pub use camera::Camera;
pub use camera_motion::CameraMotion;
pub use color_map::ColorMap;
pub use error::RenderError;
pub use extent::Extent;
pub use field::{Field, FieldSpread, FieldValues};
pub(crate) use film::temporary_beside;
pub use film::{Exposure, Film, Layers};
pub use frame::render;
pub use legend::Legend;
pub use light::{Light, Lights};
pub use look::{Lines, Look, Matcap, Material, Paint, Pattern, Plane};
pub use metadata::Metadata;
pub use output::Output;
pub use overlay::Overlay;
pub use png::Png;
pub use scenery::Scenery;
pub use text::{Anchor, TextStyle, fill_in, text_width};
