//! The scene that is kept with a film, for those who show the film and are not given one.

use super::disk::FilmFolder;
use super::error::FilmError;
use super::pictures::{Event, Watch};
use crate::scene::Scene;

/// The scene of the film, as far as its camera, lights and colours are concerned: without what only pictures have.
pub(super) fn scene_to_show(film: &FilmFolder, watch: &mut Watch) -> Result<Scene, FilmError> {
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
