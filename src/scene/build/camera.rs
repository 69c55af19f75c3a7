//! `[camera]` as a view.

use glam::DVec3;

use crate::{
    render::{RenderError, View, ViewElement, ViewKey},
    scene::{CameraKeySection, CameraSection, Scene, SceneError},
};

/// The view that a scene asks for.
///
/// # Errors
/// A [`SceneError`] at the key that is at fault.
pub fn view(scene: &Scene) -> Result<View, SceneError> {
    of_section(&scene.camera).map_err(|error| scene.complain_about(&key(&error), &error))
}

fn of_section(section: &CameraSection) -> Result<View, RenderError> {
    let mut view = View::default();
    if let Some(direction) = section.direction {
        view = view.with_direction(DVec3::from_array(direction))?;
    }
    if let Some(up) = section.up {
        view = view.with_up(DVec3::from_array(up))?;
    }
    if let Some(degrees) = section.field_of_view {
        view = view.with_field_of_view(degrees.to_radians())?;
    }
    if let Some(fill) = section.fill {
        view = view.with_fill(fill)?;
    }
    if let Some(target) = section.target {
        view = view.with_target(DVec3::from_array(target))?;
    }
    let keys = section.keys.iter().map(view_key).collect();
    view.with_turntable(section.turntable.to_radians())?.with_keys(keys, section.ease)
}

fn view_key(section: &CameraKeySection) -> ViewKey {
    ViewKey {
        time: section.time,
        orbit: section.orbit.to_radians(),
        rise: section.rise.to_radians(),
        dolly: section.dolly,
        target: section.target.map(DVec3::from_array),
    }
}

/// Where a scene says what is at fault.
fn key(error: &RenderError) -> String {
    let element = match error {
        RenderError::NoDirection { element, .. }
        | RenderError::ViewRange { element, .. }
        | RenderError::ViewNotFinite { element } => *element,
        RenderError::UpAlongView { .. } => ViewElement::Up,
        RenderError::ViewKeyOrder { .. } => return "camera.key".into(),
        _ => return "camera".into(),
    };
    match element {
        ViewElement::Direction => "camera.direction".into(),
        ViewElement::Up => "camera.up".into(),
        ViewElement::FieldOfView => "camera.field_of_view".into(),
        ViewElement::Fill => "camera.fill".into(),
        ViewElement::Target => "camera.target".into(),
        ViewElement::Turntable => "camera.turntable".into(),
        ViewElement::Key(index) => format!("camera.key[{index}]"),
    }
}
