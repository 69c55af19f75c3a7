//! GIF: one palette for the whole film and a dither that stands still, so that nothing flickers.

use std::{borrow::Cow, fs::File, io::BufWriter, io::Write};

use color_quant::NeuQuant;
use gif::{AnyExtension, Encoder, Extension, Frame, Repeat};
use rayon::prelude::*;

use super::{
    MovieError,
    animation::{Animation, Draft, Reeling},
};
use crate::render::Metadata;

/// 256 colours and which of them is nearest to any other.
#[derive(Clone, Debug, Default)]
pub(super) struct Palette {
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

    fn index(&self, color: [u8; 3], x: usize, y: usize) -> u8 {
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

pub(super) struct Gif {
    encoder: Encoder<BufWriter<File>>,
    palette: Palette,
    reeling: Reeling,
    pushed: usize,
    draft: Draft,
}

impl Gif {
    pub fn begin(draft: Draft, reeling: Reeling, palette: Palette) -> Result<Gif, MovieError> {
        let begin = |file| {
            let mut encoder = Encoder::new(file, reeling.width as u16, reeling.height as u16, &palette.colors)?;
            encoder.set_repeat(Repeat::Infinite)?;
            let comment = format!("{}, Scene hash {}", Metadata::SOFTWARE, reeling.hash());
            encoder.write_raw_extension(AnyExtension(Extension::Comment as u8), &[comment.as_bytes()])?;
            Ok::<_, gif::EncodingError>(encoder)
        };
        let encoder = begin(draft.writer()?).map_err(|error| draft.error(error))?;
        Ok(Gif { encoder, palette, reeling, pushed: 0, draft })
    }

    /// Hundredths of a second for which a frame is shown. They differ by one, so that the whole film is as long as it
    /// should be.
    fn delay(&self) -> u16 {
        let end = |frames: usize| (100.0 * frames as f64 / self.reeling.rate).round();
        (end(self.pushed + 1) - end(self.pushed)).clamp(SHORTEST, LONGEST) as u16
    }
}

/// Hundredths of a second: viewers slow down what is faster than the first, and the format holds no more than the last.
const SHORTEST: f64 = 2.0;
const LONGEST: f64 = u16::MAX as f64;

/// What a GIF of so many frames makes of a number of frames a second, if it is another one.
pub(super) fn note(rate: f64, frames: usize) -> Option<String> {
    let shown = rate.clamp(100.0 / LONGEST, 100.0 / SHORTEST);
    if shown == rate {
        return None;
    }
    let [asked, takes] = [rate, shown].map(|rate| frames as f64 / rate);
    Some(format!(
        "film.gif shows {} frames a second and takes {takes:.2} s, not {rate} and {asked:.2} s: its delays are 0.02 s to \
         655.35 s; set frame_rate between 0.00153 and 50, or ask for apng or mp4",
        if shown < rate { "50" } else { "0.00153" }
    ))
}

impl Animation for Gif {
    fn push(&mut self, pixels: &[u8]) -> Result<(), MovieError> {
        let (width, height) = (self.reeling.width, self.reeling.height);
        let (colors, _) = pixels.as_chunks::<3>();
        let index = |(at, &color): (usize, &[u8; 3])| self.palette.index(color, at % width, at / width);
        let indices: Vec<u8> = colors.par_iter().enumerate().with_min_len(4096).map(index).collect();
        let frame = Frame {
            width: width as u16,
            height: height as u16,
            delay: self.delay(),
            buffer: Cow::Owned(indices),
            ..Frame::default()
        };
        self.pushed += 1;
        self.encoder.write_frame(&frame).map_err(|error| self.draft.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), MovieError> {
        let Gif { encoder, draft, .. } = *self;
        let mut file = encoder.into_inner().map_err(|error| draft.error(error))?;
        file.flush().map_err(|error| draft.error(error))?;
        drop(file);
        draft.publish()
    }
}
