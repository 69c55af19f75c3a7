use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{
    Camera, Film, Lights, Look, Output, RenderError, Scenery,
    bins::Bins,
    ground::draw_ground_shadow,
    layers::LayerBuilder,
    lines::tubes,
    project::{Projection, ScreenTriangle},
    raster::{FIRST_TUBE, MARGIN, NOTHING, SampleTile, TILE},
    samples::{SUBPIXELS, filter_weights, pattern},
    shade::{Shaded, Shader},
    stage::Stage,
    tube::ScreenTube,
    visibility::Visibility,
};

/// Tiles in the making at the same time: enough for many threads.
const TILES_AT_A_TIME: usize = 512;

/// Makes a picture. The same input gives the same bits on any number of threads.
///
/// # Errors
/// [`RenderError::MissingVertex`] if an index has no position, [`RenderError::TooManyPrimitives`] beyond 2³¹.
pub fn render(
    scenery: &Scenery,
    camera: &Camera,
    lights: &Lights,
    look: &Look,
    output: &Output,
) -> Result<Film, RenderError> {
    scenery.validate()?;
    let stage = Stage::new(scenery, camera, output);
    let tubes = tubes(scenery, &stage, camera, look, output);
    let most = stage.faces.len().max(tubes.len());
    if most >= FIRST_TUBE as usize - 1 {
        return Err(RenderError::TooManyPrimitives(most));
    }
    let triangles = Projection::new(camera, output).triangles(&stage.faces, scenery.positions, output);
    let visibility = Visibility::new(&stage, lights, look);
    let pattern = pattern(output.samples());
    let frame = Frame {
        scenery,
        triangle_bins: Bins::new(triangles.iter().map(ScreenTriangle::bounds), TILE, MARGIN, output),
        tube_bins: Bins::new(tubes.iter().map(ScreenTube::bounds), TILE, MARGIN, output),
        triangles,
        tubes,
        weights: filter_weights(&pattern),
        pattern,
        shader: Shader { scenery, stage: &stage, visibility: &visibility, camera, lights, look, output },
    };
    let mut film = frame.film();
    if let Some(ground) = scenery.ground
        && look.ground_shadow > 0.0
    {
        draw_ground_shadow(&mut film, ground, &frame.shader);
    }
    Ok(film.cropped(output.window()))
}

/// What tiles are made from.
struct Frame<'a> {
    scenery: &'a Scenery<'a>,
    triangles: Vec<ScreenTriangle>,
    tubes: Vec<ScreenTube>,
    triangle_bins: Bins,
    tube_bins: Bins,
    pattern: Vec<[i64; 2]>,
    weights: Vec<f32>,
    shader: Shader<'a>,
}

/// A finished pixel.
#[derive(Clone, Copy)]
pub struct Pixel {
    pub beauty: Vec4,
    /// The primitive that most of its samples see.
    pub id: u32,
    /// The nearest depth of those samples.
    pub depth: f32,
}

impl Pixel {
    const EMPTY: Pixel = Pixel { beauty: Vec4::ZERO, id: NOTHING, depth: 0.0 };
}

impl Frame<'_> {
    /// Rasterizes, shades and filters a tile; its pixels row by row.
    fn tile(&self, tile: usize) -> Vec<Pixel> {
        let output = self.shader.output;
        let columns = output.width().div_ceil(TILE);
        let mut samples = SampleTile::new(tile % columns, tile / columns, output, &self.pattern);
        let inner = samples.inner;
        let count = ((inner.x[1] - inner.x[0]) * (inner.y[1] - inner.y[0])) as usize;
        let (triangles, tubes) = (self.triangle_bins.of(tile), self.tube_bins.of(tile));
        if triangles.is_empty() && tubes.is_empty() {
            return vec![Pixel::EMPTY; count];
        }
        for &triangle in triangles {
            samples.draw_triangle(&self.triangles[triangle as usize]);
        }
        for &tube in tubes {
            samples.draw_tube(FIRST_TUBE + tube, &self.tubes[tube as usize]);
        }
        let shaded = self.shade(&samples);
        let mut pixels = Vec::with_capacity(count);
        for y in inner.y[0]..inner.y[1] {
            for x in inner.x[0]..inner.x[1] {
                pixels.push(self.filtered(&samples, &shaded, x, y));
            }
        }
        pixels
    }

    /// The colour of every sample, from one shading per pixel and primitive.
    fn shade(&self, samples: &SampleTile) -> Vec<Shaded> {
        let count = self.pattern.len();
        let outer = samples.outer;
        let mut shaded =
            vec![Shaded::default(); ((outer.x[1] - outer.x[0]) * (outer.y[1] - outer.y[0])) as usize * count];
        for y in outer.y[0]..outer.y[1] {
            for x in outer.x[0]..outer.x[1] {
                let pixel = samples.pixel_index(x, y);
                let ids = samples.ids(pixel);
                let colors = &mut shaded[pixel * count..][..count];
                for (first, &id) in ids.iter().enumerate() {
                    if id == NOTHING {
                        continue;
                    }
                    if let Some(earlier) = ids[..first].iter().position(|&other| other == id) {
                        colors[first] = colors[earlier];
                        continue;
                    }
                    let at = self.middle_of_samples(ids, id, x, y);
                    let shaded = if id < FIRST_TUBE {
                        self.shader.face(id as usize, at)
                    } else {
                        self.shader.tube(&self.tubes[(id - FIRST_TUBE) as usize], at)
                    };
                    colors[first] = Shaded { color: self.shader.look.toned(shaded.color), ..shaded };
                }
            }
        }
        shaded
    }

    /// Mean place, in pixels, of the samples that see a primitive: always on it, as it is convex.
    fn middle_of_samples(&self, ids: &[u32], id: u32, x: i64, y: i64) -> [f32; 2] {
        let seeing = self.pattern.iter().zip(ids).filter(|&(_, &other)| other == id);
        let (sum, count) =
            seeing.fold(([0, 0], 0), |(sum, count), (place, _)| ([sum[0] + place[0], sum[1] + place[1]], count + 1));
        let scale = 1.0 / (count.max(1) * SUBPIXELS) as f32;
        [x as f32 + sum[0] as f32 * scale, y as f32 + sum[1] as f32 * scale]
    }

    fn filtered(&self, samples: &SampleTile, shaded: &[Shaded], x: i64, y: i64) -> Pixel {
        let count = self.pattern.len();
        let mut beauty = Vec4::ZERO;
        for neighbour in 0..9 {
            let pixel = samples.pixel_index(x + neighbour % 3 - 1, y + neighbour / 3 - 1);
            let ids = samples.ids(pixel);
            let colors = &shaded[pixel * count..][..count];
            let weights = &self.weights[neighbour as usize * count..][..count];
            for ((&id, color), &weight) in ids.iter().zip(colors).zip(weights) {
                if id != NOTHING {
                    beauty += color.color.extend(1.0) * weight;
                }
            }
        }
        let (id, depth) = dominant(samples, samples.pixel_index(x, y));
        Pixel { beauty: whole(beauty), id, depth }
    }

    /// Makes all tiles, some rows of them at a time, so that little more than the film is in memory.
    fn film(&self) -> Film {
        let Shader { output, look, .. } = self.shader;
        let (width, height) = (output.width(), output.height());
        let columns = width.div_ceil(TILE);
        let rows_at_a_time = TILES_AT_A_TIME.div_ceil(columns);
        let mut film = Film {
            width,
            height,
            whole: [width, height],
            corner: [0, 0],
            background: gradient(look.background, height),
            beauty: Vec::with_capacity(width * height),
            layers: None,
            skipped_triangles: self.shader.stage.skipped,
        };
        let mut layers = output.has_layers().then(|| LayerBuilder::new(self.scenery, &self.shader));
        for first_row in (0..height.div_ceil(TILE)).step_by(rows_at_a_time) {
            let top = first_row * TILE;
            let bottom = (top + rows_at_a_time * TILE).min(height);
            let first_tile = first_row * columns;
            let last_tile = bottom.div_ceil(TILE) * columns;
            let tiles: Vec<Vec<Pixel>> = (first_tile..last_tile).into_par_iter().map(|tile| self.tile(tile)).collect();
            for y in top..bottom {
                let row: Vec<Pixel> = (0..width)
                    .map(|x| {
                        let tile_width = TILE.min(width - x / TILE * TILE);
                        tiles[y / TILE * columns + x / TILE - first_tile][y % TILE * tile_width + x % TILE]
                    })
                    .collect();
                film.beauty.extend(row.iter().map(|pixel| pixel.beauty));
                if let Some(layers) = &mut layers {
                    layers.push_row(y, &row);
                }
            }
        }
        film.layers = layers.map(LayerBuilder::finish);
        film
    }
}

/// The primitive that most samples of a pixel see, the first of equals, and its nearest depth.
fn dominant(samples: &SampleTile, pixel: usize) -> (u32, f32) {
    let (ids, depths) = (samples.ids(pixel), samples.depths(pixel));
    let count = |id: u32| ids.iter().filter(|&&other| other == id).count();
    let seen = ids.iter().copied().filter(|&id| id != NOTHING);
    let Some(id) = seen.reduce(|best, id| if count(id) > count(best) { id } else { best }) else {
        return (NOTHING, 0.0);
    };
    let nearest = ids.iter().zip(depths).filter(|(other, _)| **other == id).map(|(_, depth)| *depth);
    (id, nearest.fold(0.0, f32::max))
}

/// One colour per row, from the upper to the lower end.
fn gradient([top, bottom]: [Vec3; 2], height: usize) -> Vec<Vec3> {
    let part = |row: usize| if height > 1 { row as f32 / (height - 1) as f32 } else { 0.0 };
    (0..height).map(|row| top.lerp(bottom, part(row))).collect()
}

/// Full coverage is exactly 1, whatever the rounding of the weights.
fn whole(beauty: Vec4) -> Vec4 {
    if beauty.w > 1.0 - 1e-5 { beauty / beauty.w } else { beauty }
}
