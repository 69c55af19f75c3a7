//! From the light at samples to that of pixels.

use glam::Vec4;

use super::{region::Region, samples::SamplePattern};
use crate::render::look::tone_mapped;

/// The light at the samples of a tile: red, green, blue, multiplied by coverage, and coverage.
pub struct LightTile<const S: usize> {
    region: Region,
    /// Of pixels whose samples are all alike, which most are.
    even: Vec<Vec4>,
    /// Where in `mixed` the samples of a pixel are, if they differ.
    place: Vec<u32>,
    mixed: Vec<[Vec4; S]>,
    /// Whether samples differ in a pixel or one of its neighbours.
    near_mixed: Vec<bool>,
}

const EVEN: u32 = u32::MAX;

impl<const S: usize> LightTile<S> {
    /// All pixels of a region are dark and cover nothing.
    pub fn new(region: Region) -> Self {
        let count = (region.width() * region.height()) as usize;
        Self {
            region,
            even: vec![Vec4::ZERO; count],
            place: vec![EVEN; count],
            mixed: Vec::new(),
            near_mixed: vec![false; count],
        }
    }

    /// Gives all samples of a pixel the same light.
    pub fn set_even(&mut self, pixel: usize, light: Vec4) {
        self.even[pixel] = light;
    }

    /// Gives each sample of a pixel its light.
    pub fn set(&mut self, pixel: usize, light: [Vec4; S]) {
        if self.place[pixel] != EVEN {
            self.mixed[self.place[pixel] as usize] = light;
            return;
        }
        self.place[pixel] = self.mixed.len() as u32;
        self.mixed.push(light);
        let [x, y] = self.region.pixel(pixel);
        let around = Region { x: [x - 1, x + 2], y: [y - 1, y + 2] };
        if let Some(around) = around.common(&self.region) {
            for y in around.y[0]..around.y[1] {
                let row = self.region.index(around.x[0], y);
                self.near_mixed[row..row + around.width() as usize].fill(true);
            }
        }
    }

    /// The light of all samples of a pixel.
    pub fn at(&self, pixel: usize) -> [Vec4; S] {
        match self.place[pixel] {
            EVEN => [self.even[pixel]; S],
            place => self.mixed[place as usize],
        }
    }

    /// Applies the tone curve to every sample.
    pub fn tone(&mut self) {
        self.even.iter_mut().for_each(|light| *light = toned(*light));
        self.mixed.iter_mut().flatten().for_each(|light| *light = toned(*light));
    }
}

/// The tone curve is for the light itself, not for its product with coverage.
#[inline]
fn toned(light: Vec4) -> Vec4 {
    let coverage = light.w;
    if coverage <= 0.0 {
        return Vec4::ZERO;
    }
    if coverage == 1.0 {
        return tone_mapped(light.truncate()).extend(1.0);
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
            return light.at(middle)[0];
        }
        let width = light.region.width() as usize;
        let mut sum = Vec4::ZERO;
        for (down, row) in [middle - width - 1, middle - 1, middle + width - 1].into_iter().enumerate() {
            let sums = &self.sums[3 * down..3 * down + 3];
            if !light.near_mixed[middle] {
                let lights = &light.even[row..row + 3];
                sum += lights[0] * sums[0] + lights[1] * sums[1] + lights[2] * sums[2];
                continue;
            }
            for (right, sum_of_weights) in sums.iter().enumerate() {
                match light.place[row + right] {
                    EVEN => sum += light.even[row + right] * *sum_of_weights,
                    place => {
                        for (sample, weight) in light.mixed[place as usize].iter().zip(self.weights[3 * down + right]) {
                            sum += *sample * weight;
                        }
                    }
                }
            }
        }
        // Full coverage is exactly 1, whatever the rounding of the weights.
        if sum.w > 1.0 - 1e-5 { sum / sum.w } else { sum }
    }
}

/// Radius of the reconstruction filter in pixels; it reaches into the eight neighbours.
const FILTER_RADIUS: f32 = 1.5;

/// Weights of the samples of a pixel and its neighbours, row by row, that sum to 1.
///
/// A Blackman-Harris bell: no negative lobes, hence no ringing at the outline. With one sample per
/// pixel there is nothing to reconstruct from, and the sample itself is the pixel.
fn filter_weights<const S: usize>(pattern: &SamplePattern<S>) -> [[f32; S]; 9] {
    let weight = |neighbour: usize, sample: usize| {
        if S == 1 {
            return if neighbour == 4 { 1.0 } else { 0.0 };
        }
        let place = pattern.place(sample);
        bell((neighbour % 3) as f32 - 1.5 + place[0]) * bell((neighbour / 3) as f32 - 1.5 + place[1])
    };
    let weights: [[f32; S]; 9] =
        std::array::from_fn(|neighbour| std::array::from_fn(|sample| weight(neighbour, sample)));
    let sum: f32 = weights.iter().flatten().sum();
    weights.map(|weights| weights.map(|weight| weight / sum))
}

fn bell(offset: f32) -> f32 {
    if offset.abs() >= FILTER_RADIUS {
        return 0.0;
    }
    let phase = std::f32::consts::PI * (offset / FILTER_RADIUS + 1.0);
    0.358_75 - 0.488_29 * libm::cosf(phase) + 0.141_28 * libm::cosf(2.0 * phase) - 0.011_68 * libm::cosf(3.0 * phase)
}
