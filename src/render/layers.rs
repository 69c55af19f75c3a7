//! What is known of each pixel besides its colour.

use glam::{Vec2, Vec3};

/// What else is known of each pixel, row by row: of the surface that most samples of the pixel see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Distance from the eye along the axis of view, infinite where nothing is seen.
    pub depth: Vec<f32>,
    /// Unit normal of the front in world space, zero where no surface is seen.
    pub normals: Vec<Vec3>,
    /// Place in world space, zero where no surface is seen.
    pub positions: Vec<Vec3>,
    /// Triangle of the scenery, `u32::MAX` where no surface is seen.
    pub face_ids: Vec<u32>,
    /// 1 where the front is seen, -1 where the back is, 0 where no surface is.
    pub sides: Vec<f32>,
    /// Pixels that the surface moves to the next frame, right and down.
    pub motion: Vec<Vec2>,
    /// Share of the sky that is seen, 1 where no surface is.
    pub occlusion: Vec<f32>,
    /// Name and values of each field of the scenery, not a number where no surface is seen.
    pub fields: Vec<(String, Vec<f32>)>,
}
