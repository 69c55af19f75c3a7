//! Rays of sight through the pixels of a picture.

use glam::{DVec3, Vec3A};

use crate::render::{Camera, Output};

/// Rays of sight in stage space: what belongs to the upper left corner of the picture, and how it
/// changes per pixel to the right and down.
#[derive(Clone, Debug)]
pub struct Sight {
    origin: [Vec3A; 3],
    direction: [Vec3A; 3],
}

impl Sight {
    pub fn new(camera: &Camera, output: &Output, of_view: impl Fn(DVec3) -> Vec3A) -> Self {
        let [corner, right, down] = [[-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0]].map(|[x, y]| camera.view_ray(x, y));
        let (width, height) = (output.width() as f32, output.height() as f32);
        let planes =
            |corner: Vec3A, right: Vec3A, down: Vec3A| [corner, (right - corner) / width, (down - corner) / height];
        Self {
            origin: planes(of_view(corner.0), of_view(right.0), of_view(down.0)),
            direction: planes(corner.1.as_vec3a(), right.1.as_vec3a(), down.1.as_vec3a()),
        }
    }

    /// Origin and unit direction.
    pub fn ray(&self, at: [f32; 2]) -> (Vec3A, Vec3A) {
        let seen = |planes: &[Vec3A; 3]| planes[0] + planes[1] * at[0] + planes[2] * at[1];
        (seen(&self.origin), seen(&self.direction).normalize())
    }
}
