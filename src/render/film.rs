use std::{
    io::Write,
    path::{Path, PathBuf},
};

use glam::{Vec2, Vec3, Vec4};
use image::{
    ExtendedColorType, ImageEncoder,
    codecs::png::{CompressionType, FilterType, PngEncoder},
};
use rayon::prelude::*;

use super::{RenderError, color::srgb_bytes};

/// A finished picture in linear light, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Where in the whole picture the upper left pixel is, if this is a part of one.
    pub(super) origin: [usize; 2],
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
        let mut bytes = vec![0; 3 * self.width * self.height];
        let rows = bytes.par_chunks_mut(3 * self.width).zip(self.beauty.par_chunks(self.width)).enumerate();
        rows.for_each(|(y, (bytes, row))| {
            let background = self.background[y];
            // The background alone has no gradient and needs no dither.
            let bare = srgb_bytes(background, 0.0);
            for (x, (bytes, light)) in bytes.as_chunks_mut().0.iter_mut().zip(row).enumerate() {
                *bytes = if light.w > 0.0 {
                    let color = light.truncate() + background * (1.0 - light.w);
                    srgb_bytes(color, dither(self.origin[0] + x, self.origin[1] + y))
                } else {
                    bare
                };
            }
        });
        bytes
    }

    /// Writes an 8-bit sRGB PNG. The file appears whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the file cannot be encoded or written.
    pub fn write_png(&self, path: &Path) -> Result<(), RenderError> {
        let mut bytes = Vec::new();
        PngEncoder::new_with_quality(&mut bytes, CompressionType::Fast, FilterType::Adaptive)
            .write_image(&self.srgb_bytes(), self.width as u32, self.height as u32, ExtendedColorType::Rgb8)
            .map_err(|error| write_error(path, error))?;
        write_whole(path, &bytes)
    }
}

pub(super) fn write_error(path: &Path, error: impl std::fmt::Display) -> RenderError {
    RenderError::Write { path: path.to_owned(), reason: error.to_string() }
}

/// Writes a temporary file next to the target, then renames it.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    let mut file =
        tempfile::Builder::new().prefix(".immerse-").tempfile_in(&folder).map_err(|error| write_error(path, error))?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(|error| write_error(path, error))?;
    file.persist(path).map_err(|error| write_error(path, error.error))?;
    Ok(())
}

/// Noise of one quantization step, different from pixel to pixel and the same in every run.
fn dither(x: usize, y: usize) -> f32 {
    // Numbers that are not negative: conversion cuts off the fraction, faster than `fract`.
    let fraction = |value: f32| value - (value as u32) as f32;
    fraction(52.982_918 * fraction(0.067_110_56 * x as f32 + 0.005_837_15 * y as f32)) - 0.5
}
