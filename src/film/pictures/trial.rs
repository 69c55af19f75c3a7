//! What pictures of a film will cost, found by making one of something else.

use std::time::{Duration, Instant};

use super::plan::Plan;
use super::sheets::scaled;
use crate::film::error::FilmError;
use crate::mesh::shapes;
use crate::render::{Camera, Extent, Look, Metadata, Output, Png, Scenery, render};
use crate::scene::Scene;

/// What a picture costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureCost {
    /// To make it and to write it as PNG, in as many threads as there are.
    pub time: Duration,
    /// Of a PNG file.
    pub bytes: usize,
}

/// The longest side of a picture that is made to find that out. What larger ones cost is in proportion to their pixels.
const TRIAL_SIDE: usize = 1280;
/// Triangles of what is seen there.
const MOST_FACES: usize = 1_000_000;

/// Makes a picture of a sphere with about as many faces, of the size and look that a scene asks for.
///
/// # Errors
/// [`FilmError`] if the scene asks for pictures that cannot be made.
pub fn try_a_picture(scene: &Scene, faces: usize) -> Result<PictureCost, FilmError> {
    let plan = Plan::of(scene)?;
    let [width, height] = scaled(plan.size(), TRIAL_SIDE);
    let output = Output::new(width, height, plan.output.samples())?;
    let subdivisions = ((faces.min(MOST_FACES) as f64 / 20.0).sqrt().round() as usize).max(1);
    let Ok(surface) = shapes::sphere(1.0, subdivisions) else {
        return Ok(PictureCost { time: Duration::ZERO, bytes: 0 });
    };
    let (triangles, positions) = (surface.mesh.triangles(), surface.positions.unwrap_or_default());
    let camera = Camera::framing(&plan.view, &Extent::of_surface(&positions, &triangles), &output)?;
    let scenery = Scenery { triangles: &triangles, positions: &positions, ..Scenery::default() };
    let begin = Instant::now();
    let picture = render(&scenery, &camera, &plan.lights, &plan.look, &output)
        // Colours and patterns of fields take the fields of a film.
        .or_else(|_| render(&scenery, &camera, &plan.lights, &Look::default(), &output))?;
    let bytes = picture.to_png(Png::default(), &Metadata::default())?.len();
    let larger = plan.size().iter().product::<usize>() as f64 / (width * height) as f64;
    Ok(PictureCost { time: begin.elapsed().mul_f64(larger), bytes: (bytes as f64 * larger) as usize })
}
