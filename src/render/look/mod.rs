//! What a surface is to look like: plain values, and the colours that follow from them.

mod appearance;
mod color;
mod color_map;
mod field;
mod light;
mod lines;
mod matcap;
mod material;
mod pattern;
mod plane;
mod presets;
mod spread;

pub use appearance::{Look, Paint};
pub use color::{linear_from_srgb, srgb_bytes, srgb_words, tone_mapped};
pub use color_map::ColorMap;
pub use field::{Field, Wording, wording};
pub use light::{Light, Lights};
pub use lines::Lines;
pub use matcap::Matcap;
pub use material::Material;
pub use pattern::{Mark, Pattern, PatternKind, Spread};
pub use plane::Plane;
pub use presets::LookName;
pub use spread::FieldSpread;
