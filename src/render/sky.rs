//! How much of the sky a surface sees, for pictures that others make.

use super::{Camera, Look, Output, RenderError, Scenery, shade, stage::Stage};

/// Share of the sky that each vertex sees on its front and on its back, within the reach of the look, from 0 to 1. The
/// camera says how large what is framed is.
///
/// # Errors
/// Those of [`render`](super::render), of the lists of the scenery.
pub fn sky_all_around(
    scenery: &Scenery,
    camera: &Camera,
    look: &Look,
    output: &Output,
) -> Result<[Vec<f32>; 2], RenderError> {
    scenery.validate()?;
    Ok(shade::sky_all_around(&Stage::new(scenery, camera, look, output), look.occlusion_reach))
}
