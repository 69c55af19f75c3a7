//! From the light at samples to that of pixels.

use glam::Vec4;

use super::{
    color::tone_mapped,
    raster::Region,
    samples::{SamplePattern, filter_weights},
};

/// The light at the samples of a tile: red, green, blue, multiplied by coverage, and coverage.
pub struct LightTile<const S: usize> {
    region: Region,
    samples: Vec<[Vec4; S]>,
    kinds: Vec<Kind>,
}

/// How the samples of a pixel differ.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// All are dark and cover nothing.
    Empty,
    /// All are like the first; the others are not written.
    Even,
    Mixed,
}

impl<const S: usize> LightTile<S> {
    /// All pixels of a region are empty.
    pub fn new(region: Region) -> Self {
        let count = (region.width() * region.height()) as usize;
        Self { region, samples: vec![[Vec4::ZERO; S]; count], kinds: vec![Kind::Empty; count] }
    }

    /// Gives all samples of a pixel the same light.
    pub fn set_even(&mut self, pixel: usize, light: Vec4) {
        self.samples[pixel][0] = light;
        self.kinds[pixel] = Kind::Even;
    }

    /// Gives each sample of a pixel its light.
    pub fn set(&mut self, pixel: usize, light: [Vec4; S]) {
        self.samples[pixel] = light;
        self.kinds[pixel] = Kind::Mixed;
    }

    /// The light of all samples of a pixel.
    pub fn at(&self, pixel: usize) -> [Vec4; S] {
        match self.kinds[pixel] {
            Kind::Empty => [Vec4::ZERO; S],
            Kind::Even => [self.samples[pixel][0]; S],
            Kind::Mixed => self.samples[pixel],
        }
    }

    /// Applies the tone curve to every sample.
    pub fn tone(&mut self) {
        for (samples, kind) in self.samples.iter_mut().zip(&self.kinds) {
            match kind {
                Kind::Empty => {}
                Kind::Even => samples[0] = toned(samples[0]),
                Kind::Mixed => *samples = samples.map(toned),
            }
        }
    }
}

/// The tone curve is for the light itself, not for its product with coverage.
fn toned(light: Vec4) -> Vec4 {
    let coverage = light.w;
    if coverage <= 0.0 {
        return Vec4::ZERO;
    }
    (tone_mapped(light.truncate() / coverage) * coverage).extend(coverage)
}

/// The reconstruction filter.
pub struct Filter<const S: usize> {
    weights: [[f32; S]; 9],
    /// Of all samples of a neighbour.
    sums: [f32; 9],
}

impl<const S: usize> Filter<S> {
    pub fn new(pattern: &SamplePattern<S>) -> Self {
        let weights = filter_weights(pattern);
        Self { sums: weights.map(|weights| weights.iter().sum()), weights }
    }

    /// A pixel that is not at the edge of the tile's region.
    #[inline(always)]
    pub fn pixel(&self, light: &LightTile<S>, x: i32, y: i32) -> Vec4 {
        let middle = light.region.index(x, y);
        if S == 1 {
            return light.samples[middle][0];
        }
        let width = light.region.width() as usize;
        let rows = [middle - width - 1, middle - 1, middle + width - 1];
        let kinds = rows.map(|row| light.kinds[row].max(light.kinds[row + 1]).max(light.kinds[row + 2]));
        if kinds == [Kind::Empty; 3] {
            return Vec4::ZERO;
        }
        let mut sum = Vec4::ZERO;
        for (neighbour, pixel) in rows.iter().flat_map(|row| [*row, row + 1, row + 2]).enumerate() {
            let samples = &light.samples[pixel];
            match light.kinds[pixel] {
                Kind::Empty => {}
                Kind::Even => sum += samples[0] * self.sums[neighbour],
                Kind::Mixed => {
                    for (sample, weight) in samples.iter().zip(self.weights[neighbour]) {
                        sum += *sample * weight;
                    }
                }
            }
        }
        // Full coverage is exactly 1, whatever the rounding of the weights.
        if sum.w > 1.0 - 1e-5 { sum / sum.w } else { sum }
    }
}
