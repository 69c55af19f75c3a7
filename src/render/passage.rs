use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{
    Camera, Film, Lights, Look, Material, Output, RenderError, Scenery,
    bins::{Bins, Tiles},
    filter::{Filter, LightTile},
    fragments::{Fragment, Gatherer, composited},
    gaps::Gaps,
    ground::draw_ground_shadow,
    layers::LayerBuilder,
    lines::tubes,
    project::ScreenTriangle,
    raster::{Region, Target, draw},
    samples::SamplePattern,
    shade::Shader,
    stage::Stage,
    tile::{FIRST_TUBE, MARGIN, NOTHING, SampleTile, TILE},
    tube::ScreenTube,
    visibility::Visibility,
};

/// Tiles in the making at the same time: enough for many threads.
const TILES_AT_A_TIME: usize = 512;
/// Triangles are projected and sorted into tiles in this many batches at most …
const BATCHES: usize = 64;
/// … of at least this many triangles.
const LEAST_BATCH: usize = 1 << 13;

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
    let stage = Stage::new(scenery, camera, look, output);
    let tubes = tubes(scenery, &stage, camera, look, output);
    let most = stage.faces.len().max(tubes.len());
    if most >= FIRST_TUBE as usize - 1 {
        return Err(RenderError::TooManyPrimitives(most));
    }
    let visibility = Visibility::new(&stage, lights, look);
    let shader = Shader { scenery, stage: &stage, visibility: &visibility, camera, lights, look, output };
    let mut film = match output.samples() {
        1 => Frame::<1>::new(tubes, shader).film(),
        4 => Frame::<4>::new(tubes, shader).film(),
        8 => Frame::<8>::new(tubes, shader).film(),
        _ => Frame::<16>::new(tubes, shader).film(),
    };
    if let Some(ground) = scenery.ground
        && look.ground_shadow > 0.0
    {
        draw_ground_shadow(&mut film, ground, &shader);
    }
    Ok(film)
}

/// What tiles of S samples per pixel are made from.
struct Frame<'a, const S: usize> {
    tiles: Tiles,
    /// In the order of the triangles.
    batches: Vec<Batch>,
    tubes: Vec<ScreenTube>,
    tube_bins: Bins,
    pattern: SamplePattern<S>,
    filter: Filter<S>,
    gaps: Option<Gaps<'a>>,
    shader: Shader<'a>,
}

/// Some of the triangles.
struct Batch {
    triangles: Vec<ScreenTriangle>,
    bins: Bins,
}

/// What is known of a finished pixel besides its light.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The primitive that most of its samples see, or the nearest one if one can see through.
    pub id: u32,
    /// The nearest depth of those samples.
    pub depth: f32,
}

impl Seen {
    const NOTHING: Seen = Seen { id: NOTHING, depth: 0.0 };
}

/// The pixels of a finished tile row by row; empty if nothing touches it.
#[derive(Default)]
struct Pixels {
    light: Vec<Vec4>,
    /// If the film has layers.
    seen: Vec<Seen>,
}

impl<'a, const S: usize> Frame<'a, S> {
    fn new(tubes: Vec<ScreenTube>, shader: Shader<'a>) -> Self {
        let Shader { scenery, stage, .. } = shader;
        let pattern = SamplePattern::new();
        let tiles = Tiles::new(TILE, MARGIN, shader.output);
        Self {
            batches: batches(scenery, stage, &tiles),
            tube_bins: Bins::new(tubes.iter().map(ScreenTube::pixels), &tiles),
            gaps: Gaps::new(shader.look.pattern, stage, scenery.positions),
            filter: Filter::new(&pattern),
            tiles,
            tubes,
            pattern,
            shader,
        }
    }

    /// Rasterizes, shades and filters a tile.
    fn tile(&self, tile: usize) -> Pixels {
        let inner = self.region(tile);
        let tubes = self.tube_bins.of(tile);
        if tubes.is_empty() && self.batches.iter().all(|batch| batch.bins.of(tile).is_empty()) {
            return Pixels::default();
        }
        let mut samples = SampleTile::new(inner, &self.pattern);
        let outer = samples.outer;
        let is_opaque = self.shader.look.is_opaque();
        if is_opaque {
            self.draw_triangles(tile, &outer, &mut samples);
        }
        for &tube in tubes {
            samples.draw_tube(FIRST_TUBE + tube, &self.tubes[tube as usize]);
        }
        let mut light = LightTile::new(outer);
        self.shade(&samples, &mut light);
        let wants_seen = self.shader.output.has_layers();
        let mut seen = if wants_seen { dominant_of(&samples) } else { Vec::new() };
        if !is_opaque {
            self.add_fragments(tile, &outer, &samples, &mut light, &mut seen);
        }
        // What is unlit keeps its colour.
        if self.shader.look.material != Material::Flat {
            light.tone();
        }
        let mut pixels = Pixels::default();
        for y in inner.y[0]..inner.y[1] {
            pixels.light.extend((inner.x[0]..inner.x[1]).map(|x| self.filter.pixel(&light, x, y)));
            if wants_seen {
                pixels.seen.extend((inner.x[0]..inner.x[1]).map(|x| seen[outer.index(x, y)]));
            }
        }
        pixels
    }

    /// The pixels of a tile that are in the window.
    fn region(&self, tile: usize) -> Region {
        let [x, y, width, height] = self.shader.output.window().map(|value| value as i32);
        let corner = self.tiles.corner(tile);
        let span = |axis: usize, start: i32, length: i32| {
            [corner[axis].max(start), (corner[axis] + TILE as i32).min(start + length)]
        };
        Region { x: span(0, x, width), y: span(1, y, height) }
    }

    /// Draws what of a tile's triangles lies in a region, in their order.
    fn draw_triangles(&self, tile: usize, region: &Region, target: &mut impl Target<S>) {
        for batch in &self.batches {
            for &index in batch.bins.of(tile) {
                let triangle = &batch.triangles[index as usize];
                match &self.gaps {
                    None => draw(triangle, &self.pattern, region, target),
                    Some(gaps) => {
                        let target = &mut gaps.over(target, triangle.id as usize, &self.pattern);
                        draw(triangle, &self.pattern, region, target);
                    }
                }
            }
        }
    }

    /// The light at every sample, from one shading per pixel and primitive.
    fn shade(&self, samples: &SampleTile<S>, light: &mut LightTile<S>) {
        let outer = samples.outer;
        for y in outer.y[0]..outer.y[1] {
            for x in outer.x[0]..outer.x[1] {
                let pixel = outer.index(x, y);
                let ids = samples.ids(pixel);
                let first = ids[0];
                if ids.iter().all(|&id| id == first) {
                    if first != NOTHING {
                        light.set_even(pixel, self.seen_light(first, u32::MAX, [x, y]));
                    }
                    continue;
                }
                let mut lights = [Vec4::ZERO; S];
                for sample in 0..S {
                    let id = ids[sample];
                    if id == NOTHING {
                        continue;
                    }
                    let earlier = ids[..sample].iter().position(|&other| other == id);
                    lights[sample] = match earlier {
                        Some(earlier) => lights[earlier],
                        None => {
                            let seeing = (0..S).fold(0, |mask, s| mask | u32::from(ids[s] == id) << s);
                            self.seen_light(id, seeing, [x, y])
                        }
                    };
                }
                light.set(pixel, lights);
            }
        }
    }

    /// Light of an opaque primitive at the middle of the samples that see it, which is on it, as it is convex.
    fn seen_light(&self, id: u32, samples: u32, pixel: [i32; 2]) -> Vec4 {
        let at = self.middle(samples, pixel);
        let shaded = if id < FIRST_TUBE {
            self.shader.face(id as usize, at)
        } else {
            self.shader.tube(&self.tubes[(id - FIRST_TUBE) as usize], at)
        };
        shaded.color.extend(1.0)
    }

    fn middle(&self, samples: u32, pixel: [i32; 2]) -> [f32; 2] {
        let middle = self.pattern.middle(samples);
        [pixel[0] as f32 + middle[0], pixel[1] as f32 + middle[1]]
    }

    /// Lays what one can see through over the opaque things, in parts if it is too much at once.
    fn add_fragments(
        &self,
        tile: usize,
        region: &Region,
        samples: &SampleTile<S>,
        light: &mut LightTile<S>,
        seen: &mut [Seen],
    ) {
        let mut gatherer = Gatherer::new(*region, samples);
        self.draw_triangles(tile, region, &mut gatherer);
        if gatherer.is_full() {
            for half in region.halves() {
                self.add_fragments(tile, &half, samples, light, seen);
            }
            return;
        }
        let fragments = gatherer.by_pixel();
        for fragments in fragments.chunk_by(|a, b| a.pixel == b.pixel) {
            let place = region.pixel(fragments[0].pixel as usize);
            let pixel = samples.outer.index(place[0], place[1]);
            let layers: Vec<(Vec3, f32)> = fragments
                .iter()
                .map(|fragment| {
                    let shaded = self.shader.face(fragment.id as usize, self.middle(fragment.samples, place));
                    (shaded.color, shaded.opacity)
                })
                .collect();
            light.set(pixel, composited(fragments, &layers, light.at(pixel)));
            if let Some(seen) = seen.get_mut(pixel) {
                *seen = nearest(fragments, *seen);
            }
        }
    }
}

impl<const S: usize> Frame<'_, S> {
    /// Makes all tiles, some rows of them at a time, so that little more than the film is in memory.
    fn film(&self) -> Film {
        let Shader { output, look, .. } = self.shader;
        let [left, top, width, height] = output.window();
        let [columns, rows] = self.tiles.count();
        let mut film = Film {
            width,
            height,
            whole: [output.width(), output.height()],
            corner: [left, top],
            background: gradient(look.background, output.height())[top..top + height].to_vec(),
            beauty: vec![Vec4::ZERO; width * height],
            layers: None,
            skipped_triangles: self.shader.stage.skipped,
        };
        let mut layers = output.has_layers().then(|| LayerBuilder::new(&self.shader));
        let rows_at_a_time = TILES_AT_A_TIME.div_ceil(columns);
        for first_row in (0..rows).step_by(rows_at_a_time) {
            let last_row = (first_row + rows_at_a_time).min(rows);
            let made: Vec<Pixels> =
                (first_row * columns..last_row * columns).into_par_iter().map(|tile| self.tile(tile)).collect();
            let regions: Vec<Region> = (first_row..last_row).map(|row| self.region(row * columns)).collect();
            let (start, end) = (regions[0].y[0] as usize - top, regions[regions.len() - 1].y[1] as usize - top);
            let pieces = |y: usize| {
                let row = regions.partition_point(|region| region.y[1] <= (y + top) as i32);
                (0..columns).map(move |column| {
                    let region = self.region((first_row + row) * columns + column);
                    let first = region.index(region.x[0], (y + top) as i32);
                    (row * columns + column, first..first + region.width() as usize, region.x[0] as usize - left)
                })
            };
            film.beauty[start * width..end * width].par_chunks_mut(width).enumerate().for_each(|(y, line)| {
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
        film.layers = layers.map(LayerBuilder::finish);
        film
    }
}

/// Projects all faces and sorts them into tiles.
fn batches(scenery: &Scenery, stage: &Stage, tiles: &Tiles) -> Vec<Batch> {
    let size = stage.faces.len().div_ceil(BATCHES).max(LEAST_BATCH);
    let batch = |(place, faces): (usize, &[[u32; 3]])| {
        let mut triangles = Vec::with_capacity(faces.len());
        for (id, corners) in (place * size..).zip(faces) {
            let positions = corners.map(|vertex| scenery.positions[vertex as usize]);
            let projected = corners.map(|vertex| stage.projected[vertex as usize]);
            stage.projection.triangle(id as u32, positions, projected, |part| triangles.push(part));
        }
        let bins = Bins::new(triangles.iter().map(ScreenTriangle::bounds), tiles);
        Batch { triangles, bins }
    };
    stage.faces.par_chunks(size).enumerate().map(batch).collect()
}

/// For every pixel of a tile the primitive that most samples see, the first of equals, and its nearest depth.
fn dominant_of<const S: usize>(samples: &SampleTile<S>) -> Vec<Seen> {
    let dominant = |pixel: usize| {
        let (ids, depths) = (samples.ids(pixel), samples.depths(pixel));
        let count = |id: u32| ids.iter().filter(|&&other| other == id).count();
        let seen = ids.iter().copied().filter(|&id| id != NOTHING);
        let Some(id) = seen.reduce(|best, id| if count(id) > count(best) { id } else { best }) else {
            return Seen::NOTHING;
        };
        let nearest = ids.iter().zip(depths).filter(|(other, _)| **other == id).map(|(_, depth)| *depth);
        Seen { id, depth: nearest.fold(0.0, f32::max) }
    };
    (0..(samples.outer.width() * samples.outer.height()) as usize).map(dominant).collect()
}

/// The nearest fragment, the first of equals, or what is opaque if that is nearer.
fn nearest<const S: usize>(fragments: &[Fragment<S>], opaque: Seen) -> Seen {
    fragments.iter().fold(opaque, |seen, fragment| {
        let depth = fragment.nearest();
        if depth > seen.depth { Seen { id: fragment.id, depth } } else { seen }
    })
}

/// One colour per row, from the upper to the lower end.
fn gradient([top, bottom]: [Vec3; 2], height: usize) -> Vec<Vec3> {
    let part = |row: usize| if height > 1 { row as f32 / (height - 1) as f32 } else { 0.0 };
    (0..height).map(|row| top.lerp(bottom, part(row))).collect()
}
