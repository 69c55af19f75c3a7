//! Planes in space.

/// The points x with normal · x = offset; beyond it, normal · x is larger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal in world space.
    pub normal: glam::DVec3,
    /// Distance from the origin.
    pub offset: f64,
}
