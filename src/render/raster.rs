//! Tiles of samples: which primitive each sample sees, and how far away.

use super::{Output, project::ScreenTriangle, samples::SUBPIXELS, tube::ScreenTube};

/// Side of a tile in pixels.
pub const TILE: usize = 64;
/// Pixels around a tile that are rasterized too, because the filter of its pixels reaches there.
pub const MARGIN: usize = 1;
/// Samples that see nothing.
pub const NOTHING: u32 = u32::MAX;
/// Ids from here on are tubes, below triangles.
pub const FIRST_TUBE: u32 = 1 << 31;
/// Pixels along a side of the blocks that are tested as a whole.
const BLOCK: i64 = 8;

/// A rectangle of pixels, ends excluded.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    pub x: [i64; 2],
    pub y: [i64; 2],
}

/// The visibility buffer of one tile and its margin.
#[derive(Clone, Debug)]
pub struct SampleTile {
    /// The pixels of the tile itself.
    pub inner: Region,
    /// Those with the margin.
    pub outer: Region,
    pattern: Vec<[i64; 2]>,
    depth: Vec<f32>,
    id: Vec<u32>,
}

impl SampleTile {
    pub fn new(column: usize, row: usize, output: &Output, pattern: &[[i64; 2]]) -> Self {
        let span = |tile: usize, size: usize| [(tile * TILE) as i64, ((tile + 1) * TILE).min(size) as i64];
        let inner = Region { x: span(column, output.width()), y: span(row, output.height()) };
        let grow = |[low, high]: [i64; 2]| [low - MARGIN as i64, high + MARGIN as i64];
        let outer = Region { x: grow(inner.x), y: grow(inner.y) };
        let count = ((outer.x[1] - outer.x[0]) * (outer.y[1] - outer.y[0])) as usize * pattern.len();
        Self { inner, outer, pattern: pattern.to_vec(), depth: vec![0.0; count], id: vec![NOTHING; count] }
    }

    /// Place of a pixel of the outer region in rows of it.
    pub fn pixel_index(&self, x: i64, y: i64) -> usize {
        ((y - self.outer.y[0]) * (self.outer.x[1] - self.outer.x[0]) + x - self.outer.x[0]) as usize
    }

    /// What the samples of a pixel see.
    pub fn ids(&self, pixel: usize) -> &[u32] {
        &self.id[pixel * self.pattern.len()..][..self.pattern.len()]
    }

    /// How far the samples of a pixel see: z / w of clip space, 0 for nothing.
    pub fn depths(&self, pixel: usize) -> &[f32] {
        &self.depth[pixel * self.pattern.len()..][..self.pattern.len()]
    }

    /// Draws a triangle. Of two primitives at the same depth the first one drawn stays.
    pub fn draw_triangle(&mut self, triangle: &ScreenTriangle) {
        let edges = [0, 1, 2].map(|k| Edge::new(triangle.corners[k], triangle.corners[(k + 1) % 3]));
        let Some(region) = self.touched(
            [0, 1].map(|axis| triangle.corners.iter().map(|corner| corner[axis]).min().unwrap_or(0)),
            [0, 1].map(|axis| triangle.corners.iter().map(|corner| corner[axis]).max().unwrap_or(0)),
        ) else {
            return;
        };
        let [mut block_y, end_y] = region.y;
        while block_y < end_y {
            let y_end = (block_y + BLOCK).min(end_y);
            let mut block_x = region.x[0];
            while block_x < region.x[1] {
                let x_end = (block_x + BLOCK).min(region.x[1]);
                let block = Region { x: [block_x, x_end], y: [block_y, y_end] };
                if edges.iter().all(|edge| edge.reaches(&block)) {
                    self.draw_triangle_in(triangle, &edges, &block);
                }
                block_x = x_end;
            }
            block_y = y_end;
        }
    }

    fn draw_triangle_in(&mut self, triangle: &ScreenTriangle, edges: &[Edge; 3], block: &Region) {
        let samples = self.pattern.len();
        let [low, high] = triangle.depth_range;
        for y in block.y[0]..block.y[1] {
            for x in block.x[0]..block.x[1] {
                let pixel = Region { x: [x, x + 1], y: [y, y + 1] };
                if !edges.iter().all(|edge| edge.reaches(&pixel)) {
                    continue;
                }
                let first = self.pixel_index(x, y) * samples;
                for (sample, place) in self.pattern.iter().enumerate() {
                    let at = [x * SUBPIXELS + place[0], y * SUBPIXELS + place[1]];
                    // All three are non-negative exactly if no sign bit is set.
                    if (edges[0].at(at) | edges[1].at(at) | edges[2].at(at)) < 0 {
                        continue;
                    }
                    let [right, down] = at.map(|place| place as f64 / SUBPIXELS as f64);
                    let depth = triangle.first.z
                        + triangle.slope[0] * (right - triangle.first.x)
                        + triangle.slope[1] * (down - triangle.first.y);
                    let depth = depth.clamp(low, high) as f32;
                    if depth > self.depth[first + sample] {
                        self.depth[first + sample] = depth;
                        self.id[first + sample] = triangle.id;
                    }
                }
            }
        }
    }

    /// Draws a tube, whose places are exact distances to its axis.
    pub fn draw_tube(&mut self, id: u32, tube: &ScreenTube) {
        let [low, high] = tube.bounds().map(|corner| corner.map(|value| (value * SUBPIXELS as f32) as i64));
        let Some(region) = self.touched(low, high) else { return };
        let samples = self.pattern.len();
        for y in region.y[0]..region.y[1] {
            for x in region.x[0]..region.x[1] {
                let first = self.pixel_index(x, y) * samples;
                for (sample, place) in self.pattern.iter().enumerate() {
                    let at = [x as f32 + place[0] as f32 / 256.0, y as f32 + place[1] as f32 / 256.0];
                    if let Some(depth) = tube.depth_at(at)
                        && depth > self.depth[first + sample]
                    {
                        self.depth[first + sample] = depth;
                        self.id[first + sample] = id;
                    }
                }
            }
        }
    }

    /// Pixels of this tile between two corners given in subpixels.
    fn touched(&self, low: [i64; 2], high: [i64; 2]) -> Option<Region> {
        let span = |low: i64, high: i64, limits: [i64; 2]| {
            [low.div_euclid(SUBPIXELS).max(limits[0]), (high.div_euclid(SUBPIXELS) + 1).min(limits[1])]
        };
        let region = Region { x: span(low[0], high[0], self.outer.x), y: span(low[1], high[1], self.outer.y) };
        (region.x[0] < region.x[1] && region.y[0] < region.y[1]).then_some(region)
    }
}

/// A directed edge as an affine function that is non-negative on the inside.
#[derive(Clone, Copy, Debug)]
struct Edge {
    x: i64,
    y: i64,
    constant: i64,
}

impl Edge {
    /// Top and left edges own the samples that lie on them, others do not: a sample on an edge shared by
    /// two triangles belongs to exactly one.
    fn new(from: [i64; 2], to: [i64; 2]) -> Self {
        let (right, down) = (to[0] - from[0], to[1] - from[1]);
        let top_left = down < 0 || (down == 0 && right > 0);
        let constant = down * from[0] - right * from[1] - i64::from(!top_left);
        Self { x: -down, y: right, constant }
    }

    fn at(&self, [x, y]: [i64; 2]) -> i64 {
        self.x * x + self.y * y + self.constant
    }

    /// Whether any place of a region can be inside.
    fn reaches(&self, region: &Region) -> bool {
        let x = if self.x > 0 { region.x[1] * SUBPIXELS } else { region.x[0] * SUBPIXELS };
        let y = if self.y > 0 { region.y[1] * SUBPIXELS } else { region.y[0] * SUBPIXELS };
        self.at([x, y]) >= 0
    }
}
