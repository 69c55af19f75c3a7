//! From where a surface is seen.

mod extent;
mod eye;
mod framing;
mod lens;
mod moments;
mod motion;
mod view;

pub use extent::Extent;
pub use eye::Camera;
pub use motion::CameraMotion;
pub use view::{View, ViewKey};
