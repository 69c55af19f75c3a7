//! `[output]` as the size and sampling of pictures.

use crate::{
    render::{Output, RenderError},
    scene::{OutputSection, Scene, SceneError},
};

/// The size and the sampling that a scene asks for.
///
/// # Errors
/// A [`SceneError`] at the key that is at fault.
pub fn output(scene: &Scene) -> Result<Output, SceneError> {
    of_section(&scene.output).map_err(|error| {
        let key = match error {
            RenderError::Size { .. } => "output.size",
            RenderError::Samples { .. } => "output.samples",
            RenderError::Crop { .. } => "output.crop",
            _ => "output",
        };
        scene.complain_about(key, &error)
    })
}

fn of_section(section: &OutputSection) -> Result<Output, RenderError> {
    let whole = Output::new(section.size[0], section.size[1], section.samples)?.with_layers(section.exr);
    section.crop.map_or(Ok(whole), |window| whole.with_crop(window))
}
