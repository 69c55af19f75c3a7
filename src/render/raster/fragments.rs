//! Surfaces one can see through: all layers of a pixel, put in order at each sample.
//!
//! Every triangle leaves a fragment in each pixel it covers: which samples, and how far away at each. A
//! fragment is shaded once; then each sample takes its fragments from the nearest to the farthest, so
//! surfaces that pass through each other are right within a pixel too. What is opaque (lines) lies in the tile's
//! visibility buffer and hides what is behind it.
//!
//! Memory is bounded: fragments of a tile that do not fit the budget are gathered for half of its rows at
//! a time, then a quarter, down to single pixels; that changes no bit of the picture. Only if the layers of one pixel
//! alone exceed the budget (hundreds of thousands with 4 samples), the farther half of those found so far is dropped.

use glam::{Vec3, Vec4};

use super::{
    draw::Target,
    region::Region,
    sample_tile::{NOTHING, SampleTile},
};

/// Bytes of the fragments of one tile in the making.
const BUDGET: usize = 8 << 20;

/// What a triangle covers in a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Fragment<const S: usize> {
    /// Place in the region that is gathered, row by row.
    pub pixel: u32,
    /// The face.
    pub id: u32,
    /// One bit for each sample that it covers.
    pub samples: u32,
    /// At the samples that it covers.
    depth: [f32; S],
}

impl<const S: usize> Fragment<S> {
    /// Depth at the nearest of its samples.
    pub fn nearest(&self) -> f32 {
        let covered = self.depth.iter().enumerate().filter(|(sample, _)| self.samples >> sample & 1 == 1);
        covered.fold(0.0, |nearest, (_, &depth)| nearest.max(depth))
    }
}

/// Gathers the fragments of a region.
pub struct Gatherer<'a, const S: usize> {
    region: Region,
    /// The opaque things.
    behind: &'a SampleTile<S>,
    fragments: Vec<Fragment<S>>,
    drawing: u32,
    limit: usize,
    is_full: bool,
}

impl<'a, const S: usize> Gatherer<'a, S> {
    pub fn new(region: Region, behind: &'a SampleTile<S>) -> Self {
        let limit = BUDGET / size_of::<Fragment<S>>();
        Self { region, behind, fragments: Vec::new(), drawing: NOTHING, limit, is_full: false }
    }

    /// Whether there were more fragments than fit; they are incomplete then.
    pub fn is_full(&self) -> bool {
        self.is_full
    }

    /// The fragments in the order of their pixels, those of a pixel in the order they were drawn.
    pub fn by_pixel(mut self) -> Vec<Fragment<S>> {
        self.fragments.sort_by_key(|fragment| fragment.pixel);
        self.fragments
    }

    fn push(&mut self, fragment: Fragment<S>) {
        if self.fragments.len() == self.limit {
            if self.region.width() * self.region.height() > 1 {
                self.is_full = true;
                return;
            }
            self.fragments.sort_by(|a, b| b.nearest().total_cmp(&a.nearest()));
            self.fragments.truncate(self.limit / 2);
        }
        self.fragments.push(fragment);
    }
}

impl<const S: usize> Target<S> for Gatherer<'_, S> {
    fn begin(&mut self, id: u32) {
        self.drawing = id;
    }

    fn hides(&mut self, _: i32, _: i32, _: f32) -> bool {
        self.is_full
    }

    fn cover(&mut self, x: i32, y: i32, outside: [i32; S], depth: [f32; S]) {
        let opaque = self.behind.depths(self.behind.outer.index(x, y));
        let samples = (0..S).fold(0, |samples, s| samples | u32::from(outside[s] >= 0 && depth[s] > opaque[s]) << s);
        if samples != 0 {
            self.push(Fragment { pixel: self.region.index(x, y) as u32, id: self.drawing, samples, depth });
        }
    }
}

/// A fragment's light, not multiplied by its opacity, and its opacity.
pub type Layer = (Vec3, f32);

/// The light that comes from the fragments of a pixel, over what is opaque: for each sample red, green and blue, multiplied
/// by coverage, and coverage. Of fragments at the same depth the first lies before the others.
pub fn composited<const S: usize>(fragments: &[Fragment<S>], layers: &[Layer], opaque: [Vec4; S]) -> [Vec4; S] {
    // Neighbouring samples mostly agree on the order, so it is kept from one to the next.
    let mut order: Vec<usize> = (0..fragments.len()).collect();
    std::array::from_fn(|sample| {
        let depth = |&fragment: &usize| fragments[fragment].depth[sample];
        order.sort_by(|a, b| depth(b).total_cmp(&depth(a)).then(a.cmp(b)));
        let covering = order.iter().filter(|&&fragment| fragments[fragment].samples >> sample & 1 == 1);
        let (mut light, mut passing) = (Vec3::ZERO, 1.0);
        for &fragment in covering {
            let (color, opacity) = layers[fragment];
            light += color * (passing * opacity);
            passing *= 1.0 - opacity;
        }
        opaque[sample] * passing + light.extend(1.0 - passing)
    })
}
