//! One palette for a whole film and a dither that stands still, so that nothing flickers.

use color_quant::NeuQuant;
use rayon::prelude::*;

/// 256 colours and which of them is nearest to any other.
#[derive(Clone, Debug, Default)]
pub(in crate::film) struct Palette {
    /// Red, green and blue of each; the first is the background.
    colors: Vec<u8>,
    /// The nearest to each cell of colour space.
    nearest: Vec<u8>,
    /// Width of the dither in steps of 8 bits.
    dither: f32,
}

/// Cells of colour space along each axis, as a power of 2.
const CELL_BITS: u32 = 6;
/// A wider dither would be seen more than the steps that it hides.
const WIDEST_DITHER: f32 = 16.0;
/// One of so many pixels is looked at by the network that finds the colours.
const SAMPLING: i32 = 3;

impl Palette {
    /// The colours that suit these pixels (three bytes each) best.
    pub fn of(pixels: &[u8], background: [u8; 3]) -> Palette {
        let mut samples: Vec<u8> = Vec::with_capacity(pixels.len() / 3 * 4);
        for &[red, green, blue] in pixels.as_chunks().0 {
            if [red, green, blue] != background {
                samples.extend([red, green, blue, 255]);
            }
        }
        let mut colors = background.to_vec();
        if samples.is_empty() {
            colors.resize(3 * 256, 0);
        } else {
            // The network wants some hundred pixels.
            while samples.len() < 4 * 1024 {
                samples.extend_from_within(..);
            }
            colors.extend(NeuQuant::new(SAMPLING, 255, &samples).color_map_rgb());
        }
        let shift = 8 - CELL_BITS;
        let nearest = (0..1_u32 << (3 * CELL_BITS)).into_par_iter().map(|cell| {
            let mask = (1 << CELL_BITS) - 1;
            let color = [cell >> (2 * CELL_BITS), cell >> CELL_BITS, cell]
                .map(|part| (((part & mask) << shift) + (1 << shift >> 1)) as i32);
            let distance = |index: usize| {
                let other = &colors[3 * index..];
                (0..3).map(|axis| (color[axis] - i32::from(other[axis])).pow(2)).sum::<i32>()
            };
            (0..colors.len() / 3).min_by_key(|&index| distance(index)).unwrap_or(0) as u8
        });
        Palette { nearest: nearest.collect(), dither: mean_distance(&colors).min(WIDEST_DITHER), colors }
    }

    /// Red, green and blue of each colour, one after the other.
    pub fn colors(&self) -> &[u8] {
        &self.colors
    }

    /// The colour of a pixel of this colour, at its place.
    pub fn index(&self, color: [u8; 3], x: usize, y: usize) -> u8 {
        if color[..] == self.colors[..3] {
            return 0;
        }
        let noise = (ordered(x, y) - 0.5) * self.dither;
        let cell = color.iter().fold(0_usize, |cell, &value| {
            let value = (f32::from(value) + noise).clamp(0.0, 255.0) as usize;
            (cell << CELL_BITS) + (value >> (8 - CELL_BITS))
        });
        self.nearest[cell]
    }
}

/// Mean distance of a colour from the nearest other one.
fn mean_distance(colors: &[u8]) -> f32 {
    let (colors, _) = colors.as_chunks::<3>();
    let distance = |a: &[u8; 3], b: &[u8; 3]| {
        (0..3).map(|axis| (f32::from(a[axis]) - f32::from(b[axis])).powi(2)).sum::<f32>().sqrt()
    };
    let nearest = |color: &[u8; 3]| {
        colors.iter().filter(|other| *other != color).map(|other| distance(color, other)).fold(f32::MAX, f32::min)
    };
    let distances = colors.iter().map(nearest).filter(|distance| *distance < f32::MAX);
    distances.sum::<f32>() / colors.len().max(1) as f32
}

/// Thresholds between 0 and 1 that are spread evenly over every square of 8 pixels (Bayer).
fn ordered(x: usize, y: usize) -> f32 {
    let bits = (0..3).fold(0, |rank, bit| {
        let (column, row) = (x >> bit & 1, y >> bit & 1);
        rank << 2 | (column ^ row) << 1 | row
    });
    (bits as f32 + 0.5) / 64.0
}
