//! The camera of a film as exports have it.

use glam::{DAffine3, DVec3, Vec3};

use crate::render::{Camera, Lights};

/// A camera for each exported frame, and the lights that go with it.
#[derive(Default)]
pub(super) struct CameraPath {
    /// In the order of the frames.
    pub poses: Vec<Pose>,
    /// Toward each light in the space of the eye (x right, y up, z toward the eye), with its linear colour times strength.
    pub lights: Vec<(Vec3, Vec3)>,
    /// Light from all around.
    pub sky: Vec3,
    /// What is up in the film.
    pub up: DVec3,
}

/// Where the eye is, and what it sees.
#[derive(Clone, Copy)]
pub(super) struct Pose {
    /// From the space of the eye (x right, y up, z toward the eye) to the world.
    pub world_from_eye: DAffine3,
    /// Tangent of half the vertical field of view, or half the height of the picture in lengths.
    pub half_height: f64,
    pub is_perspective: bool,
    /// Width over height.
    pub aspect: f64,
    /// Distances between which all is seen.
    pub clipping: [f64; 2],
}

impl Pose {
    pub fn of(camera: &Camera) -> Pose {
        let clip = camera.clip_from_view();
        let world_from_eye = camera.view_from_world().inverse();
        let (middle, radius) = camera.subject();
        let distance = middle.distance(world_from_eye.translation);
        Pose {
            world_from_eye,
            half_height: 1.0 / clip.y_axis.y,
            is_perspective: camera.field_of_view() > 0.0,
            aspect: clip.y_axis.y / clip.x_axis.x,
            clipping: [1e-2 * radius.max(1e-9), distance + 100.0 * radius],
        }
    }
}

/// Directions and colours.
pub(super) fn of_lights(lights: &Lights) -> Vec<(Vec3, Vec3)> {
    lights.all().iter().map(|light| (Vec3::from(light.direction()), light.color())).collect()
}
