//! `[[light]]` as lights.

use glam::Vec3;

use crate::{
    render::{Light, Lights, RenderError},
    scene::{LightSection, Scene, SceneError},
};

/// The lights that a scene asks for; without any they are those of the studio.
///
/// # Errors
/// A [`SceneError`] at the key of the light that is at fault.
pub fn lights(scene: &Scene) -> Result<Lights, SceneError> {
    if scene.lights.is_empty() {
        return Ok(Lights::default());
    }
    let light = |(index, section): (usize, &LightSection)| {
        light(section).map_err(|error| {
            let key = if matches!(error, RenderError::LightColor { .. }) { "color" } else { "direction" };
            scene.complain_about(&format!("light[{index}].{key}"), &error)
        })
    };
    Ok(Lights::new(scene.lights.iter().enumerate().map(light).collect::<Result<_, _>>()?))
}

fn light(section: &LightSection) -> Result<Light, RenderError> {
    let [direction, color] = [section.direction, section.color].map(|of| Vec3::from_array(of.map(|part| part as f32)));
    Light::new(direction, color, section.shadow)
}
