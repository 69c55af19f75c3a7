//! The visibility buffer of a tile: which primitive each sample sees, and how far away.

use super::{
    draw::{BLOCK, Target},
    lanes::{self, take_nearer},
    region::Region,
    samples::SamplePattern,
    tube::ScreenTube,
};

/// Side of a tile in pixels, a multiple of the side of a block.
pub const TILE: usize = 64;
/// Pixels around a tile that are rasterized too, because the filter of its pixels reaches there.
pub const MARGIN: usize = 1;
/// Samples that see nothing.
pub const NOTHING: u32 = u32::MAX;
/// Ids from here on are tubes, below triangles.
pub const FIRST_TUBE: u32 = 1 << 31;

/// Samples of one tile and its margin.
#[derive(Clone, Debug)]
pub struct SampleTile<const S: usize> {
    /// The pixels of the tile and its margin.
    pub outer: Region,
    pattern: SamplePattern<S>,
    depth: Vec<[f32; S]>,
    id: Vec<[u32; S]>,
    /// No sample of a block is farther than this, unless the block is stale.
    farthest: Vec<f32>,
    /// Whether something was drawn into a block since its farthest sample was looked for.
    stale: Vec<bool>,
    blocks: Region,
    /// What is being drawn.
    drawing: u32,
}

impl<const S: usize> SampleTile<S> {
    /// The tile of these pixels; nothing is seen.
    pub fn new(inner: Region, pattern: &SamplePattern<S>) -> Self {
        let margin = MARGIN as i32;
        let grow = |[low, high]: [i32; 2]| [low - margin, high + margin];
        let outer = Region { x: grow(inner.x), y: grow(inner.y) };
        let whole = |[low, high]: [i32; 2]| [low.div_euclid(BLOCK), (high - 1).div_euclid(BLOCK) + 1];
        let blocks = Region { x: whole(outer.x), y: whole(outer.y) };
        let count = (outer.width() * outer.height()) as usize;
        let block_count = (blocks.width() * blocks.height()) as usize;
        Self {
            outer,
            pattern: *pattern,
            depth: vec![[0.0; S]; count],
            id: vec![[NOTHING; S]; count],
            farthest: vec![0.0; block_count],
            stale: vec![false; block_count],
            blocks,
            drawing: NOTHING,
        }
    }

    /// What the samples of a pixel see.
    pub fn ids(&self, pixel: usize) -> &[u32; S] {
        &self.id[pixel]
    }

    /// How far the samples of a pixel see: z / w of clip space, 0 for nothing.
    pub fn depths(&self, pixel: usize) -> &[f32; S] {
        &self.depth[pixel]
    }

    /// Draws a tube, whose places are exact distances to its axis.
    pub fn draw_tube(&mut self, id: u32, tube: &ScreenTube) {
        let [across, down] = tube.pixels();
        // A very wide tube may reach beyond all numbers.
        let pixels_to = |[first, last]: [i32; 2]| [first, last.saturating_add(1)];
        let touched = Region { x: pixels_to(across), y: pixels_to(down) };
        let Some(region) = touched.common(&self.outer) else { return };
        self.begin(id);
        for y in region.y[0]..region.y[1] {
            for x in region.x[0]..region.x[1] {
                let (mut outside, mut depths) = ([-1; S], [0.0; S]);
                for sample in 0..S {
                    let place = self.pattern.place(sample);
                    if let Some(depth) = tube.depth_at([x as f32 + place[0], y as f32 + place[1]]) {
                        (outside[sample], depths[sample]) = (0, depth.max(0.0));
                    }
                }
                self.cover(x, y, outside, depths);
            }
        }
    }
}

/// Of two primitives at the same depth the first one drawn stays.
impl<const S: usize> Target<S> for SampleTile<S> {
    #[inline(always)]
    fn begin(&mut self, id: u32) {
        self.drawing = id;
    }

    #[inline(always)]
    fn hides(&mut self, x: i32, y: i32, nearest: f32) -> bool {
        let block = self.blocks.index(x.div_euclid(BLOCK), y.div_euclid(BLOCK));
        if self.stale[block] {
            self.stale[block] = false;
            let pixels = Region { x: [x, x + BLOCK], y: [y, y + BLOCK] };
            let mut farthest = f32::MAX;
            if let Some(pixels) = pixels.common(&self.outer) {
                for y in pixels.y[0]..pixels.y[1] {
                    let row = self.outer.index(pixels.x[0], y);
                    farthest = lanes::least(&self.depth[row..row + pixels.width() as usize], farthest);
                }
            }
            self.farthest[block] = farthest;
        }
        nearest <= self.farthest[block]
    }

    #[inline(always)]
    fn cover(&mut self, x: i32, y: i32, outside: [i32; S], depth: [f32; S]) {
        let pixel = self.outer.index(x, y);
        take_nearer(&mut self.depth[pixel], &mut self.id[pixel], &outside, &depth, self.drawing);
        let block = self.blocks.index(x.div_euclid(BLOCK), y.div_euclid(BLOCK));
        self.stale[block] = true;
    }
}
