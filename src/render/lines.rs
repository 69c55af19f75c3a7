//! Which edges are drawn as lines.

use glam::DVec3;
use rayon::prelude::*;

use super::{
    Camera, Output, Scenery,
    project::Projection,
    stage::Stage,
    tube::{Ink, ScreenTube},
};

/// Radius of silhouettes in pixels at 1080p. The surface hides the inner half.
const SILHOUETTE: f32 = 1.5;
/// Radius of boundary edges.
const BOUNDARY: f32 = 1.2;
/// Radius of rims.
const RIM: f32 = 3.0;
/// Radius of pinch points.
const PINCH: f32 = 6.0;

/// The lines of a picture, in a fixed order: silhouettes, boundary, rims, pinch points.
pub fn tubes(scenery: &Scenery, stage: &Stage, camera: &Camera, output: &Output) -> Vec<ScreenTube> {
    let projection = Projection::new(camera, output);
    let tube = |ends: [u32; 2], radius: f32, ink: Ink| {
        let ends: [DVec3; 2] = ends.map(|vertex| scenery.positions[vertex as usize]);
        if !ends.iter().all(|end| end.is_finite()) {
            return None;
        }
        let tube = ScreenTube::new(projection.segment(ends)?, output.line_pixels(radius), ink, camera, output);
        tube.is_near(output).then_some(tube)
    };
    let silhouettes = silhouettes(stage);
    let silhouettes = silhouettes.iter().filter_map(|&ends| tube(ends, SILHOUETTE, Ink::Line));
    let boundary = scenery.boundary.iter().filter_map(|&ends| tube(ends, BOUNDARY, Ink::Line));
    let rims = scenery.rims.iter().filter_map(|&ends| tube(ends, RIM, Ink::Rim));
    let pinches = scenery.pinch_points.iter().filter_map(|&vertex| tube([vertex; 2], PINCH, Ink::Rim));
    silhouettes.chain(boundary).chain(rims).chain(pinches).collect()
}

/// Edges between a face whose front is seen and one whose back is.
fn silhouettes(stage: &Stage) -> Vec<[u32; 2]> {
    let mut sides: Vec<([u32; 2], bool)> = stage
        .faces
        .par_iter()
        .zip(&stage.shows_front)
        .flat_map_iter(|(corners, &front)| {
            [0, 1, 2].map(|k| {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                ([a.min(b), a.max(b)], front)
            })
        })
        .collect();
    sides.par_sort_unstable();
    let shared = sides.chunk_by(|a, b| a.0 == b.0);
    shared.filter(|edge| edge.iter().any(|side| side.1 != edge[0].1)).map(|edge| edge[0].0).collect()
}
