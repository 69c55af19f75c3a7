//! One tile of a picture, from its triangles and lines to the light of its pixels.

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{
    Material, Scenery,
    raster::{
        Bins, FIRST_TUBE, Filter, Gaps, Gatherer, LightTile, MARGIN, NOTHING, Region, SamplePattern, SampleTile,
        ScreenTube, Seen, TILE, Target, Tiles, composited, dominant_of, draw, nearest,
    },
    shade::Shader,
    stage::{ScreenTriangle, Stage},
};

/// Triangles are projected and sorted into tiles in at most this number of batches, side by side.
const BATCHES: usize = 64;
/// A batch has at least this number of triangles, so that small surfaces are not cut up.
const LEAST_BATCH: usize = 1 << 13;

/// What tiles of S samples per pixel are made from.
pub struct TileMaker<'a, const S: usize> {
    pub tiles: Tiles,
    /// In the order of the triangles.
    batches: Vec<Batch>,
    tubes: Vec<ScreenTube>,
    tube_bins: Bins,
    pattern: SamplePattern<S>,
    filter: Filter<S>,
    gaps: Option<Gaps<'a>>,
    pub shader: Shader<'a>,
}

/// Some of the triangles.
struct Batch {
    triangles: Vec<ScreenTriangle>,
    bins: Bins,
}

/// The pixels of a finished tile row by row; empty if nothing touches it.
#[derive(Default)]
pub struct Pixels {
    pub light: Vec<Vec4>,
    /// If the picture has layers.
    pub seen: Vec<Seen>,
}

impl<'a, const S: usize> TileMaker<'a, S> {
    pub fn new(tubes: Vec<ScreenTube>, shader: Shader<'a>) -> Self {
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
    pub fn tile(&self, tile: usize) -> Pixels {
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
    pub fn region(&self, tile: usize) -> Region {
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

    /// Lays what one can see through over the opaque things. Where that is too much at once, it is done region by region.
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
