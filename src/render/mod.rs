//! A software renderer: a triangulated surface and the curves on it become a picture.
//!
//! The passage of a frame: the surface is moved before the eye ([`Scenery`], [`Camera`]), it is found
//! out how much light each part of it sees, triangles and lines are drawn into tiles of samples that
//! remember who is seen and how far, each primitive is shaded once per pixel, and the samples are
//! filtered into a [`Film`].

mod bins;
mod camera;
mod color;
mod color_map;
mod error;
mod extent;
mod field;
mod film;
mod filter;
mod fragments;
mod frame;
mod gaps;
mod intersect;
mod lanes;
mod layers;
mod light;
mod lines;
mod look;
mod openexr;
mod output;
mod project;
mod raster;
mod samples;
mod scenery;
mod shade;
mod stage;
mod tile;
mod trace;
mod tube;
mod visibility;

pub use camera::Camera;
pub use color_map::ColorMap;
pub use error::RenderError;
pub use extent::Extent;
pub use field::{Field, FieldValues};
pub use film::{Film, Layers};
pub use frame::render;
pub use light::{Light, Lights};
pub use look::{Lines, Look, Matcap, Material, Paint, Pattern, Plane};
pub use output::Output;
pub use scenery::Scenery;
