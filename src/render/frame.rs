use glam::{Vec3, Vec3A, Vec4};
use rayon::prelude::*;

use super::{
    Camera, Film, Lights, Look, Output, RenderError, Scenery,
    bins::Bins,
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
    let tubes = if look.lines { tubes(scenery, &stage, camera, output) } else { Vec::new() };
    let most = stage.faces.len().max(tubes.len());
    if most >= FIRST_TUBE as usize - 1 {
        return Err(RenderError::TooManyPrimitives(most));
    }
    let triangles = Projection::new(camera, output).triangles(&stage.faces, scenery.positions, output);
    let visibility = Visibility::new(&stage, lights, look);
    let pattern = pattern(output.samples());
    let frame = Frame {
        triangle_bins: Bins::new(triangles.iter().map(ScreenTriangle::bounds), TILE, MARGIN, output),
        tube_bins: Bins::new(tubes.iter().map(ScreenTube::bounds), TILE, MARGIN, output),
        triangles,
        tubes,
        weights: filter_weights(&pattern),
        pattern,
        shader: Shader { stage: &stage, visibility: &visibility, camera, lights, look, output },
    };
    Ok(frame.film(stage.skipped))
}

/// What tiles are made from.
struct Frame<'a> {
    triangles: Vec<ScreenTriangle>,
    tubes: Vec<ScreenTube>,
    triangle_bins: Bins,
    tube_bins: Bins,
    pattern: Vec<[i64; 2]>,
    weights: Vec<f32>,
    shader: Shader<'a>,
}

/// A finished pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    beauty: Vec4,
    depth: f32,
    normal: Vec3A,
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
            return vec![Pixel::default(); count];
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
                    colors[first] = if id < FIRST_TUBE {
                        self.shader.face(id as usize, at)
                    } else {
                        self.shader.tube(&self.tubes[(id - FIRST_TUBE) as usize], at)
                    };
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
        let pixel = samples.pixel_index(x, y);
        let surface = samples.ids(pixel).iter().zip(&shaded[pixel * count..]).filter(|&(&id, _)| id < FIRST_TUBE);
        let normal = surface.map(|(_, color)| color.normal).sum::<Vec3A>().normalize_or_zero();
        let depth = samples.depths(pixel).iter().copied().fold(0.0, f32::max);
        Pixel { beauty: whole(beauty), depth, normal }
    }

    /// Makes all tiles, some rows of them at a time, so that little more than the film is in memory.
    fn film(&self, skipped_triangles: usize) -> Film {
        let Shader { output, camera, look, .. } = self.shader;
        let (width, height) = (output.width(), output.height());
        let columns = width.div_ceil(TILE);
        let rows_at_a_time = TILES_AT_A_TIME.div_ceil(columns);
        let world_from_view = camera.view_from_world().matrix3.transpose();
        let mut film = Film {
            width,
            height,
            background: look.background,
            beauty: Vec::with_capacity(width * height),
            depth: Vec::with_capacity(width * height),
            normals: Vec::with_capacity(width * height),
            skipped_triangles,
        };
        for first_row in (0..height.div_ceil(TILE)).step_by(rows_at_a_time) {
            let top = first_row * TILE;
            let bottom = (top + rows_at_a_time * TILE).min(height);
            let first_tile = first_row * columns;
            let last_tile = bottom.div_ceil(TILE) * columns;
            let tiles: Vec<Vec<Pixel>> = (first_tile..last_tile).into_par_iter().map(|tile| self.tile(tile)).collect();
            for (x, y) in (top..bottom).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let tile_width = TILE.min(width - x / TILE * TILE);
                let pixel = &tiles[y / TILE * columns + x / TILE - first_tile][y % TILE * tile_width + x % TILE];
                let seen = pixel.depth > 0.0;
                film.beauty.push(pixel.beauty);
                film.depth.push(if seen { camera.distance(f64::from(pixel.depth)) as f32 } else { f32::INFINITY });
                film.normals.push((world_from_view * Vec3::from(pixel.normal).as_dvec3()).as_vec3());
            }
        }
        film
    }
}

/// Full coverage is exactly 1, whatever the rounding of the weights.
fn whole(beauty: Vec4) -> Vec4 {
    if beauty.w > 1.0 - 1e-5 { beauty / beauty.w } else { beauty }
}
