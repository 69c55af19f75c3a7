//! Which edges are drawn as lines.

use glam::DVec3;
use rayon::prelude::*;

use super::{
    Camera, Lines, Output, Scenery,
    intersect::self_intersections,
    stage::Stage,
    tube::{ScreenTube, Stroke},
};

/// How far silhouettes lie behind their edges, as a share of the edge's length: deeper than the zigzags of
/// the mesh, so that these stay hidden.
const OUTLINE_SINK: f32 = 0.6;
/// The lines of a picture, in a fixed order: silhouettes, boundary, self-intersections, rims, pinch points.
pub fn tubes(scenery: &Scenery, stage: &Stage, camera: &Camera, lines: &Lines, output: &Output) -> Vec<ScreenTube> {
    let projection = &stage.projection;
    let tube = |ends: [DVec3; 2], width: f32, stroke: Stroke| {
        let radius = width / 2.0;
        if width == 0.0 || !ends.iter().all(|end| end.is_finite()) {
            return None;
        }
        let tube = ScreenTube::new(projection.segment(ends)?, output.line_pixels(radius), stroke, camera, output);
        tube.is_near(output).then_some(tube)
    };
    let edge = |ends: [u32; 2]| ends.map(|vertex| scenery.positions[vertex as usize]);
    let silhouettes = if lines.silhouette > 0.0 { silhouettes(stage) } else { Vec::new() };
    let silhouettes = silhouettes.iter().filter_map(|&ends| {
        let ends = edge(ends);
        let depth = projection.pixel(projection.clip(ends[0])).z;
        let length = ends[0].distance(ends[1]) / camera.pixel_size(depth, output);
        let sink = output.line_pixels(lines.silhouette) + OUTLINE_SINK * length as f32;
        tube(ends, 2.0 * lines.silhouette, Stroke::Outline { sink })
    });
    let boundary = scenery.boundary.iter().filter_map(|&ends| tube(edge(ends), lines.boundary, Stroke::Line));
    let double =
        if lines.intersection > 0.0 { self_intersections(&stage.faces, scenery.positions) } else { Vec::new() };
    let double = double.iter().filter_map(|&ends| tube(ends, lines.intersection, Stroke::Line));
    let rims = scenery.rims.iter().filter_map(|&ends| tube(edge(ends), lines.rim, Stroke::Raised));
    let pinches =
        scenery.pinch_points.iter().filter_map(|&vertex| tube(edge([vertex; 2]), lines.pinch, Stroke::Raised));
    silhouettes.chain(boundary).chain(double).chain(rims).chain(pinches).collect()
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
