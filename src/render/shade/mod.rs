//! How much light arrives at a place, and what colour it has there.

mod directions;
mod ground;
mod layer_builder;
mod reflection;
mod shader;
mod sky;
mod trace;
mod visibility;

pub use ground::draw_ground_shadow;
pub use layer_builder::LayerBuilder;
pub use shader::Shader;
pub use sky::sky_all_around;
pub use visibility::Visibility;
