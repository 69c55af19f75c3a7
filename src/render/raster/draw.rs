//! Which samples a triangle covers, exactly, and how far away it is there.
//!
//! Corners and samples lie on grids of 256 and 16 steps per pixel, so edge functions are integers and the
//! question whether a sample is inside has one answer: triangles that share an edge leave no crack and
//! hit no sample twice.

use super::{lanes, region::Region, samples::SamplePattern};
use crate::render::stage::{SUBPIXELS, ScreenTriangle};

/// Pixels along a side of the blocks that are accepted or rejected as a whole.
pub const BLOCK: i32 = 8;
/// Triangles that touch at most this many pixels in a row or column are drawn without looking at blocks.
const SMALL: i32 = 12;
/// Sample places are multiples of 2^4 subpixels.
const SAMPLE_STEP: i32 = 4;
/// Sample places per pixel.
const STEPS: i32 = SUBPIXELS >> SAMPLE_STEP;

/// What triangles are drawn on.
pub trait Target<const S: usize> {
    /// Says which face is drawn next.
    fn begin(&mut self, id: u32);
    /// Whether nothing as near as this, or farther, can be seen in the block that begins at a pixel.
    fn hides(&mut self, x: i32, y: i32, nearest: f32) -> bool;
    /// Takes a pixel. The sign of `outside` tells for each sample whether it is covered (not negative).
    fn cover(&mut self, x: i32, y: i32, outside: [i32; S], depth: [f32; S]);
}

/// Draws what of a triangle lies in a region.
#[inline(always)]
pub fn draw<const S: usize>(
    triangle: &ScreenTriangle,
    pattern: &SamplePattern<S>,
    region: &Region,
    target: &mut impl Target<S>,
) {
    let [across, down] = triangle.bounds();
    let touched = Region { x: [across[0], across[1] + 1], y: [down[0], down[1] + 1] };
    let Some(part) = touched.common(region) else { return };
    target.begin(triangle.id);
    let outline = Outline::new(triangle, pattern);
    let plane = DepthPlane::new(triangle, pattern);
    if touched.width().max(touched.height()) <= SMALL {
        let origin = [touched.x[0], touched.y[0]];
        let start = [outline.at(0, origin) as i32, outline.at(1, origin) as i32, outline.at(2, origin) as i32];
        outline.fill(start, &plane.seen_from(origin), origin, &part, target);
        return;
    }
    let first = [part.x[0].div_euclid(BLOCK) * BLOCK, part.y[0].div_euclid(BLOCK) * BLOCK];
    for y in (first[1]..part.y[1]).step_by(BLOCK as usize) {
        for x in (first[0]..part.x[1]).step_by(BLOCK as usize) {
            let block = Region { x: [x, x + BLOCK], y: [y, y + BLOCK] };
            let Some(block_part) = block.common(&part) else { continue };
            let Some((crossing, start)) = outline.in_block([x, y]) else { continue };
            let depth = plane.seen_from([x, y]);
            if target.hides(x, y, depth.nearest_in_block()) {
                continue;
            }
            crossing.fill(start, &depth, [x, y], &block_part, target);
        }
    }
}

/// The three edges as functions of the sample steps, not negative on the inside.
///
/// `right x + down y + constant >= 0`, with x and y in subpixels, asks the same as
/// `right x' + down y' + floor(constant / 16) >= 0` in sample steps, x = 16 x'. Where an edge passes through a block
/// of 128 steps, that is at most 128 (|right| + |down|), which fits 32 bits because of the guard band.
#[derive(Clone, Copy)]
struct Outline<const S: usize> {
    right: [i32; 3],
    down: [i32; 3],
    /// From the upper left corner of a pixel to its samples.
    to_samples: [[i32; S]; 3],
    /// A corner on each edge, in subpixels.
    through: [[i32; 2]; 3],
}

impl<const S: usize> Outline<S> {
    #[inline(always)]
    fn new(triangle: &ScreenTriangle, pattern: &SamplePattern<S>) -> Self {
        let through = triangle.corners;
        let [a, b, c] = through;
        let right = [a[1] - b[1], b[1] - c[1], c[1] - a[1]];
        let down = [b[0] - a[0], c[0] - b[0], a[0] - c[0]];
        let along = |edge: usize| pattern.map(|x, y| right[edge] * x + down[edge] * y);
        let to_samples = [along(0), along(1), along(2)];
        Self { right, down, to_samples, through }
    }

    /// An edge function at the upper left corner of a pixel.
    ///
    /// Top and left edges own the samples that lie on them, others do not: a sample on an edge shared by two
    /// triangles belongs to exactly one.
    #[inline(always)]
    fn at(&self, edge: usize, pixel: [i32; 2]) -> i64 {
        let top_left = self.right[edge] > 0 || (self.right[edge] == 0 && self.down[edge] > 0);
        let [x, y] = self.through[edge];
        let (to_right, to_down) = (i64::from(pixel[0] * SUBPIXELS - x), i64::from(pixel[1] * SUBPIXELS - y));
        let value = i64::from(self.right[edge]) * to_right + i64::from(self.down[edge]) * to_down;
        (value - i64::from(!top_left)) >> SAMPLE_STEP
    }

    /// The edges that pass through a block, and their values at its corner; those that the block lies wholly
    /// inside of are zero. None if it lies outside of one.
    #[inline(always)]
    fn in_block(&self, pixel: [i32; 2]) -> Option<(Self, [i32; 3])> {
        let (mut crossing, mut start) = (*self, [0; 3]);
        for (edge, start) in start.iter_mut().enumerate() {
            let value = self.at(edge, pixel);
            let reach = i64::from(BLOCK * STEPS - 1);
            let (right, down) = (i64::from(self.right[edge]) * reach, i64::from(self.down[edge]) * reach);
            if value + right.max(0) + down.max(0) < 0 {
                return None;
            }
            if value + right.min(0) + down.min(0) >= 0 {
                (crossing.right[edge], crossing.down[edge]) = (0, 0);
                crossing.to_samples[edge] = [0; S];
            } else {
                *start = value as i32;
            }
        }
        Some((crossing, start))
    }

    /// Visits the pixels of a region; `start` holds the edge functions at `origin`.
    #[inline(always)]
    fn fill(
        &self,
        start: [i32; 3],
        depth: &SeenDepth<S>,
        origin: [i32; 2],
        region: &Region,
        target: &mut impl Target<S>,
    ) {
        for y in region.y[0]..region.y[1] {
            let (to_down, to_right) = ((y - origin[1]) * STEPS, (region.x[0] - origin[0]) * STEPS);
            let mut value = start;
            for (value, (right, down)) in value.iter_mut().zip(self.right.iter().zip(&self.down)) {
                *value += right * to_right + down * to_down;
            }
            for x in region.x[0]..region.x[1] {
                let outside = lanes::outside(value, &self.to_samples);
                target.cover(x, y, outside, depth.at(x - origin[0], y - origin[1]));
                for (value, right) in value.iter_mut().zip(self.right) {
                    // Wraps only past the last pixel.
                    *value = value.wrapping_add(right * STEPS);
                }
            }
        }
    }
}

/// The depth of a triangle in double precision.
struct DepthPlane<const S: usize> {
    depth: [f64; 3],
    slope: [f32; 2],
    to_samples: [f32; S],
    range: [f32; 2],
}

impl<const S: usize> DepthPlane<S> {
    #[inline(always)]
    fn new(triangle: &ScreenTriangle, pattern: &SamplePattern<S>) -> Self {
        let slope = [triangle.depth[1] as f32, triangle.depth[2] as f32];
        let step = [slope[0] * (1.0 / STEPS as f32), slope[1] * (1.0 / STEPS as f32)];
        let to_samples = pattern.map(|x, y| step[0] * x as f32 + step[1] * y as f32);
        Self { depth: triangle.depth, slope, to_samples, range: triangle.depth_range }
    }

    #[inline(always)]
    fn seen_from(&self, [x, y]: [i32; 2]) -> SeenDepth<'_, S> {
        let start = self.depth[0] + self.depth[1] * f64::from(x) + self.depth[2] * f64::from(y);
        SeenDepth { plane: self, start: start as f32 }
    }
}

/// The depth around a pixel, where single precision is enough. It depends on the triangle alone, not on the region
/// that is drawn, so that parts of a picture have the bits of the whole.
struct SeenDepth<'a, const S: usize> {
    plane: &'a DepthPlane<S>,
    start: f32,
}

impl<const S: usize> SeenDepth<'_, S> {
    #[inline(always)]
    fn at(&self, x: i32, y: i32) -> [f32; S] {
        let pixel = self.start + (self.plane.slope[0] * x as f32 + self.plane.slope[1] * y as f32);
        lanes::clamped_sums(pixel, &self.plane.to_samples, self.plane.range)
    }

    /// No sample of the block that begins here is nearer.
    #[inline(always)]
    fn nearest_in_block(&self) -> f32 {
        let side = BLOCK as f32;
        let (right, down) = (self.plane.slope[0] * side, self.plane.slope[1] * side);
        let rounding = 1e-5 * (right.abs() + down.abs() + self.start.abs());
        (self.start + right.max(0.0) + down.max(0.0) + rounding).max(self.plane.range[0]).min(self.plane.range[1])
    }
}
