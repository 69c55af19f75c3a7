//! The surface in front of the eye.

mod normals;
mod project;
mod sight;
mod surface;

pub use normals::smooth_normals;
pub use project::{Projection, SUBPIXELS, ScreenTriangle};
pub use surface::Stage;
