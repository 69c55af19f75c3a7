//! How a film is seen, as its pictures are.

use super::camera::{CameraPath, Pose, of_lights};
use super::colors::Colors;
use crate::digest::Key;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::kept_scene::scene_to_show;
use crate::film::pictures::{Arrivals, Plan, Views, Watch};

/// Camera, lights and colours, and how fast frames follow each other. The default is none of it.
#[derive(Default)]
pub(super) struct View {
    pub camera: CameraPath,
    pub colors: Colors,
    /// Frames a second.
    pub frame_rate: f64,
    /// Of all this but the places of the camera.
    pub key: Option<Key>,
}

impl View {
    /// That of the scene that is kept with a film.
    pub fn of(film: &FilmFolder, frames: &[usize], arrivals: &Arrivals, watch: &mut Watch) -> Result<View, FilmError> {
        let scene = scene_to_show(film, watch)?;
        let plan = Plan::of(&scene)?;
        let views = Views::of(&plan, film.folder(), frames, arrivals, watch)?;
        Ok(View {
            camera: CameraPath {
                poses: views.cameras.iter().map(Pose::of).collect(),
                lights: of_lights(&views.lights),
                sky: 0.5 * (views.look.sky + views.look.ground),
                up: views.up,
            },
            colors: Colors::of_look(&views.look, views.field),
            frame_rate: scene.output.frame_rate,
            key: Some(views.key),
        })
    }
}
