//! How a surface becomes a picture.

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{
    Camera, Lights, Look, Output, Picture, RenderError, Scenery,
    lines::tubes,
    raster::{Region, Seen},
    scenery::MOST_PRIMITIVES,
    shade::{LayerBuilder, Shader, Visibility, draw_ground_shadow},
    stage::Stage,
    tile::{Pixels, TileMaker},
};

/// Tiles in the making at the same time: enough for many threads.
const TILES_AT_A_TIME: usize = 512;

/// Makes a picture. The same input gives the same bits on any number of threads.
///
/// # Errors
/// [`RenderError::MissingVertex`] or [`RenderError::Length`] if the lists of the scenery do not fit each other,
/// [`RenderError::Share`], [`RenderError::LineWidth`], [`RenderError::Cut`] or [`RenderError::Periods`] if a number of the
/// look is impossible, and [`RenderError::TooManyPrimitives`] beyond 2³¹ triangles or lines.
pub fn render(
    scenery: &Scenery,
    camera: &Camera,
    lights: &Lights,
    look: &Look,
    output: &Output,
) -> Result<Picture, RenderError> {
    scenery.validate()?;
    look.validate()?;
    let stage = Stage::new(scenery, camera, look, output);
    let tubes = tubes(scenery, &stage, camera, look, output);
    if tubes.len() > MOST_PRIMITIVES {
        return Err(RenderError::TooManyPrimitives { count: tubes.len(), limit: MOST_PRIMITIVES });
    }
    let visibility = Visibility::new(&stage, lights, look);
    let shader = Shader { scenery, stage: &stage, visibility: &visibility, camera, lights, look, output };
    let mut picture = match output.samples() {
        1 => picture(&TileMaker::<1>::new(tubes, shader)),
        4 => picture(&TileMaker::<4>::new(tubes, shader)),
        8 => picture(&TileMaker::<8>::new(tubes, shader)),
        _ => picture(&TileMaker::<16>::new(tubes, shader)),
    };
    if let Some(ground) = scenery.ground
        && look.ground_shadow > 0.0
    {
        draw_ground_shadow(&mut picture, ground, &shader);
    }
    Ok(picture)
}

/// Makes all tiles, some rows of them at a time, so that little more than the picture is in memory.
fn picture<const S: usize>(maker: &TileMaker<S>) -> Picture {
    let Shader { output, look, .. } = maker.shader;
    let [left, top, width, height] = output.window();
    let [columns, rows] = maker.tiles.count();
    let mut picture = Picture {
        width,
        height,
        whole: [output.width(), output.height()],
        corner: [left, top],
        background: gradient(look.background, output.height())[top..top + height].to_vec(),
        beauty: vec![Vec4::ZERO; width * height],
        layers: None,
        skipped_triangles: maker.shader.stage.skipped,
    };
    let mut layers = output.has_layers().then(|| LayerBuilder::new(&maker.shader));
    let rows_at_a_time = TILES_AT_A_TIME.div_ceil(columns);
    for first_row in (0..rows).step_by(rows_at_a_time) {
        let last_row = (first_row + rows_at_a_time).min(rows);
        let made: Vec<Pixels> =
            (first_row * columns..last_row * columns).into_par_iter().map(|tile| maker.tile(tile)).collect();
        let regions: Vec<Region> = (first_row..last_row).map(|row| maker.region(row * columns)).collect();
        let (start, end) = (regions[0].y[0] as usize - top, regions[regions.len() - 1].y[1] as usize - top);
        let pieces = |y: usize| {
            let row = regions.partition_point(|region| region.y[1] <= (y + top) as i32);
            (0..columns).map(move |column| {
                let region = maker.region((first_row + row) * columns + column);
                let first = region.index(region.x[0], (y + top) as i32);
                (row * columns + column, first..first + region.width() as usize, region.x[0] as usize - left)
            })
        };
        picture.beauty[start * width..end * width].par_chunks_mut(width).enumerate().for_each(|(y, line)| {
            for (tile, from, to) in pieces(start + y) {
                if !made[tile].light.is_empty() {
                    line[to..to + from.len()].copy_from_slice(&made[tile].light[from]);
                }
            }
        });
        if let Some(layers) = &mut layers {
            for y in start..end {
                let mut line = vec![Seen::NOTHING; width];
                for (tile, from, to) in pieces(y) {
                    if !made[tile].seen.is_empty() {
                        line[to..to + from.len()].copy_from_slice(&made[tile].seen[from]);
                    }
                }
                layers.push_row([left, top + y], &line);
            }
        }
    }
    picture.layers = layers.map(LayerBuilder::finish);
    picture
}

/// One colour per row, from the upper to the lower end.
fn gradient([top, bottom]: [Vec3; 2], height: usize) -> Vec<Vec3> {
    let part = |row: usize| if height > 1 { row as f32 / (height - 1) as f32 } else { 0.0 };
    (0..height).map(|row| top.lerp(bottom, part(row))).collect()
}
