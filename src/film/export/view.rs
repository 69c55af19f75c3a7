//! How a film is seen, as its pictures are.

use super::camera::{CameraPath, Pose, of_lights};
use super::colors::Colors;
use crate::digest::Key;
use crate::film::disk::FilmFolder;
use crate::film::error::FilmError;
use crate::film::pictures::{Arrivals, Event, Plan, Views, Watch};
use crate::scene::Scene;

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
        let scene = scene_of(film, watch)?;
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

/// The scene of the film, as far as its camera, lights and colours are concerned.
fn scene_of(film: &FilmFolder, watch: &mut Watch) -> Result<Scene, FilmError> {
    let mut scene = match film.scene()? {
        Some(scene) => scene,
        None => {
            let reason = "no scene that can be read is kept with the film, so that camera, lights and colours are the usual ones";
            watch(Event::Note(format!("{}: {reason}; run the scene again to have its own", film.folder().display())));
            Scene { name: film.manifest().scene.clone(), ..Scene::default() }
        }
    };
    scene.clock.frames = film.manifest().frame_count;
    scene.output.crop = None;
    scene.output.animation.clear();
    // What only pictures have, and files beside the scene.
    let look = &mut scene.look;
    (look.matcap, look.hide, look.pattern, look.cut, look.explode) = (None, None, None, None, 0.0);
    look.hide_faces.clear();
    Ok(scene)
}
