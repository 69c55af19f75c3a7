use std::{
    io::{self, Write},
    path::Path,
};

use glam::{Vec2, Vec3, Vec4};
use rayon::prelude::*;
use tempfile::NamedTempFile;

use super::{
    RenderError,
    color::{srgb_bytes, srgb_words},
};

/// A finished picture in linear light, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
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

/// What else is known of each pixel, row by row: of the surface that most samples of the pixel see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// Distance from the eye along the axis of view, infinite where nothing is seen.
    pub depth: Vec<f32>,
    /// Unit normal of the front in world space, zero where no surface is seen.
    pub normals: Vec<Vec3>,
    /// Place in world space, zero where no surface is seen.
    pub positions: Vec<Vec3>,
    /// Triangle of the scenery, `u32::MAX` where no surface is seen.
    pub face_ids: Vec<u32>,
    /// 1 where the front is seen, -1 where the back is, 0 where no surface is.
    pub sides: Vec<f32>,
    /// Pixels that the surface moves to the next frame, right and down.
    pub motion: Vec<Vec2>,
    /// Share of the sky that is seen, 1 where no surface is.
    pub occlusion: Vec<f32>,
    /// Name and values of each field of the scenery, not a number where no surface is seen.
    pub fields: Vec<(String, Vec<f32>)>,
}

impl Film {
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
        let rows = bytes.par_chunks_mut(3 * self.width).zip(self.beauty.par_chunks(self.width)).enumerate();
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
    pub fn blank(width: usize, height: usize, background: Vec3) -> Film {
        Film {
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
    pub fn paste(&mut self, picture: &Film, [left, top]: [usize; 2]) {
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

/// Pictures taken one after another on the same film, which shows their mean in linear light.
#[derive(Clone, Debug)]
pub struct Exposure {
    film: Film,
    pictures: usize,
}

impl Exposure {
    /// The shutter opens: layers and the count of skipped triangles are those of this picture.
    pub fn of(film: Film) -> Exposure {
        Exposure { film, pictures: 1 }
    }

    /// Adds a picture of the same size.
    pub fn add(&mut self, film: &Film) {
        self.pictures += 1;
        self.film.beauty.iter_mut().zip(&film.beauty).for_each(|(sum, light)| *sum += *light);
    }

    /// The shutter closes.
    pub fn develop(mut self) -> Film {
        if self.pictures > 1 {
            let share = self.pictures as f32;
            self.film.beauty.iter_mut().for_each(|light| *light /= share);
        }
        self.film
    }
}

pub(super) fn write_error(path: &Path, error: impl std::fmt::Display) -> RenderError {
    RenderError::Write { path: path.to_owned(), reason: error.to_string() }
}

/// Writes a temporary file next to the target, then renames it.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    let mut file = temporary_beside(path).map_err(|error| write_error(path, error))?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(|error| write_error(path, error))?;
    file.persist(path).map_err(|error| write_error(path, error.error))?;
    Ok(())
}

/// Whether colours are the same but for rounding.
fn is_same(a: Vec3, b: Vec3) -> bool {
    a.abs_diff_eq(b, 1e-6)
}

/// A file under a temporary name in the folder of a path, with the rights of any new file.
pub(crate) fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".immerse-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

/// Noise of one quantization step, different from pixel to pixel and the same in every run.
fn dither(x: usize, y: usize) -> f32 {
    // Numbers that are not negative: conversion cuts off the fraction, faster than `fract`.
    let fraction = |value: f32| value - (value as u32) as f32;
    fraction(52.982_918 * fraction(0.067_110_56 * x as f32 + 0.005_837_15 * y as f32)) - 0.5
}
