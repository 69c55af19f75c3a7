//! What a scene says, as the values of the rooms that do it.

mod camera;
mod light;
mod look;
mod output;

pub use camera::view;
pub use light::lights;
pub use look::look;
pub use output::output;
