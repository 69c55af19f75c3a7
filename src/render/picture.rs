//! A finished picture, and how its light becomes numbers of a file.

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{
    Layers,
    look::{srgb_bytes, srgb_words},
};

/// A finished picture in linear light, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Size of the picture of which this may be a part.
    pub(super) whole: [usize; 2],
    /// Where the upper left corner of this part lies in it.
    pub(super) corner: [usize; 2],
    /// Behind the surface, one colour per row.
    pub(super) background: Vec<Vec3>,
    /// Red, green, blue (already multiplied by the coverage) and coverage, after the tone curve.
    pub(super) beauty: Vec<Vec4>,
    pub(super) layers: Option<Layers>,
    pub(super) skipped_triangles: usize,
}

impl Picture {
    /// Width and height of the whole picture of which this is a part.
    pub fn whole(&self) -> [usize; 2] {
        self.whole
    }

    /// Column and row of the upper left corner of this part in the whole picture.
    pub fn corner(&self) -> [usize; 2] {
        self.corner
    }

    /// Pixels across.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Triangles that were left out, because a corner is not finite or they have no area.
    pub fn skipped_triangles(&self) -> usize {
        self.skipped_triangles
    }

    /// Linear red, green, blue (multiplied by coverage) and coverage, row by row from the top.
    pub fn beauty(&self) -> &[Vec4] {
        &self.beauty
    }

    /// Depth, normals and more, if the output asked for them.
    pub fn layers(&self) -> Option<&Layers> {
        self.layers.as_ref()
    }

    /// The picture over its background as sRGB bytes, three per pixel, row by row.
    pub fn srgb_bytes(&self) -> Vec<u8> {
        // A background of one colour needs no dither.
        let flat = self.background.windows(2).all(|rows| is_same(rows[0], rows[1]));
        let [left, top] = self.corner;
        let mut bytes = vec![0; 3 * self.width * self.height];
        // A picture without pixels has no rows, and rows of length 0 cannot be cut off.
        let width = self.width.max(1);
        let rows = bytes.par_chunks_mut(3 * width).zip(self.beauty.par_chunks(width)).enumerate();
        rows.for_each(|(y, (bytes, row))| {
            let background = self.background[y];
            let bare = srgb_bytes(background, 0.0);
            for (x, (bytes, light)) in bytes.as_chunks_mut().0.iter_mut().zip(row).enumerate() {
                *bytes = if light.w > 0.0 || !flat {
                    let color = light.truncate() + background * (1.0 - light.w);
                    srgb_bytes(color, dither(left + x, top + y))
                } else {
                    bare
                };
            }
        });
        bytes
    }

    /// The picture over its background in sRGB with 16 bits, three values per pixel, row by row.
    pub fn srgb_words(&self) -> Vec<u16> {
        let pixel = |(index, light): (usize, &Vec4)| srgb_words(self.over_background(index, light));
        self.beauty.par_iter().enumerate().with_min_len(4096).flat_map_iter(pixel).collect()
    }

    fn over_background(&self, index: usize, light: &Vec4) -> Vec3 {
        light.truncate() + self.background[index / self.width] * (1.0 - light.w)
    }

    /// An empty picture of one colour (linear light), to be pasted on.
    pub fn blank(width: usize, height: usize, background: Vec3) -> Picture {
        Picture {
            width,
            height,
            whole: [width, height],
            corner: [0, 0],
            background: vec![background; height],
            beauty: vec![Vec4::ZERO; width * height],
            layers: None,
            skipped_triangles: 0,
        }
    }

    /// Puts another picture upon this one, its upper left corner at x and y; what lies outside is left out. Layers are
    /// not touched.
    pub fn paste(&mut self, picture: &Picture, [left, top]: [usize; 2]) {
        let width = picture.width.min(self.width.saturating_sub(left));
        for y in 0..picture.height.min(self.height.saturating_sub(top)) {
            let same_background = is_same(picture.background[y], self.background[top + y]);
            for x in 0..width {
                let index = y * picture.width + x;
                let light = picture.beauty[index];
                // Where backgrounds agree they stay, and are exact.
                let light = if same_background { light } else { picture.over_background(index, &light).extend(1.0) };
                self.beauty[(top + y) * self.width + left + x] = light;
            }
        }
    }
}

/// Whether colours are the same but for rounding.
fn is_same(a: Vec3, b: Vec3) -> bool {
    a.abs_diff_eq(b, 1e-6)
}

/// Noise of one quantization step, different from pixel to pixel and the same in every run.
fn dither(x: usize, y: usize) -> f32 {
    // Numbers that are not negative: conversion cuts off the fraction, faster than `fract`.
    let fraction = |value: f32| value - (value as u32) as f32;
    fraction(52.982_918 * fraction(0.067_110_56 * x as f32 + 0.005_837_15 * y as f32)) - 0.5
}
