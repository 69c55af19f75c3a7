//! A software renderer: a triangulated surface and the curves on it become a picture.
//!
//! A pixel passes through the folders of this room in this order.
//!
//! 1. `camera` finds out from where the eye sees the whole surface: the [`Extent`] of a film is measured, and a
//!    [`CameraMotion`] keeps it in the picture.
//! 2. `look` holds what the surface is to look like: its colours, material, pattern, lines and [`Lights`].
//! 3. `stage` moves the surface in front of the eye, works out its normals, and projects its triangles onto the grid of
//!    pixels.
//! 4. `raster` sorts the triangles into tiles and finds out which of them each sample of a pixel sees, and how far away.
//! 5. `lines` turns outlines, creases, self-intersections and other curves into thin tubes, which are drawn into the
//!    same samples.
//! 6. `shade` finds out how much light arrives at each place, and gives every triangle and tube that a pixel sees its
//!    colour there. What one can see through is laid over what lies behind it, and a filter makes one pixel of its
//!    samples.
//! 7. `text` writes labels and a legend over the finished [`Picture`].
//! 8. `write` puts it into a PNG or OpenEXR file.
//!
//! [`render()`] does steps 3 to 6: `passage.rs` makes a picture tile by tile, and `tile.rs` makes one tile.

mod camera;
mod error;
mod exposure;
mod layers;
mod lines;
mod look;
mod output;
mod passage;
mod picture;
mod raster;
mod scenery;
mod shade;
mod sky;
mod stage;
mod text;
mod tile;
mod write;

pub use camera::{Camera, CameraMotion, Extent, View, ViewKey};
pub use error::{LabelFault, LookElement, RenderError, ViewElement};
pub use exposure::Exposure;
pub use layers::Layers;
pub use lines::self_intersections;
pub use look::{
    ColorMap, Field, FieldSpread, Light, Lights, Lines, Look, LookName, Matcap, Material, Paint, Pattern, PatternKind,
    Plane, linear_from_srgb, srgb_bytes,
};
pub use output::Output;
pub use passage::render;
pub use picture::Picture;
pub use scenery::Scenery;
pub use sky::sky_all_around;
pub use stage::smooth_normals;
pub use text::{Anchor, Corner, Legend, Overlay, TextStyle, fill_in, text_width};
pub use write::{Metadata, Png};
