//! The light of a picture of a sphere.

use std::io::Cursor;
use std::path::Path;

use glam::Vec3;

use super::color::linear_from_srgb;
use crate::render::RenderError;
use crate::whole_file;

/// The most bytes of the file of a picture, and of what it unpacks to.
const MOST_BYTES: u64 = 256 << 20;

/// The longest side of a picture in pixels.
const LONGEST_SIDE: u32 = 8192;

/// A square picture of a lit sphere in linear light, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Matcap {
    /// Pixels along a side.
    side: usize,
    /// side² colours.
    pixels: Vec<Vec3>,
}

impl Matcap {
    /// Reads a picture of a lit sphere that touches the middle square's sides.
    ///
    /// # Errors
    /// [`RenderError::Matcap`]
    pub fn read(path: &Path) -> Result<Self, RenderError> {
        let failed = |error: String| RenderError::Matcap { path: path.to_owned(), reason: error };
        let bytes = whole_file::read(path, MOST_BYTES).map_err(|error| failed(error.to_string()))?;
        let mut reader = image::ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| failed(error.to_string()))?;
        let mut limits = image::Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(LONGEST_SIDE), Some(LONGEST_SIDE));
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let picture = reader.decode().map_err(|error| failed(error.to_string()))?.into_rgb8();
        let side = picture.width().min(picture.height());
        let (left, top) = ((picture.width() - side) / 2, (picture.height() - side) / 2);
        let square = image::imageops::crop_imm(&picture, left, top, side, side).to_image();
        Ok(Self { side: side as usize, pixels: square.pixels().map(|pixel| linear_from_srgb(pixel.0)).collect() })
    }

    /// White porcelain between two soft boxes.
    pub fn porcelain() -> Self {
        const SIDE: usize = 256;
        let boxes = [(Vec3::new(-0.55, 0.65, 0.55), 0.75, 60), (Vec3::new(0.80, 0.15, 0.35), 0.30, 14)];
        let pixel = |index: usize| {
            let place = |value: usize| (value as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
            let (x, y) = (place(index % SIDE), -place(index / SIDE));
            let normal = Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt()).normalize();
            let mirror =
                Vec3::new(2.0 * normal.z * normal.x, 2.0 * normal.z * normal.y, 2.0 * normal.z * normal.z - 1.0);
            let base =
                Vec3::new(0.30, 0.29, 0.30).lerp(Vec3::new(0.86, 0.87, 0.90), 0.5 + 0.5 * normal.dot(boxes[0].0));
            let shine: f32 = boxes
                .iter()
                .map(|&(toward, strength, power)| strength * mirror.dot(toward.normalize()).max(0.0).powi(power))
                .sum();
            base * (0.55 + 0.45 * normal.z) + Vec3::splat(shine)
        };
        Self { side: SIDE, pixels: (0..SIDE * SIDE).map(pixel).collect() }
    }
}

impl Matcap {
    /// The colour at a place on the disk of radius 1, x right and y up, between pixels.
    pub fn at(&self, x: f32, y: f32) -> Vec3 {
        let last = self.side.saturating_sub(1) as f32;
        let place = |value: f32| ((value.clamp(-1.0, 1.0) * 0.5 + 0.5) * self.side as f32 - 0.5).clamp(0.0, last);
        let (column, row) = (place(x), place(-y));
        let pixel = |column: f32, row: f32| {
            let index = row.min(last) as usize * self.side + column.min(last) as usize;
            self.pixels.get(index).copied().unwrap_or(Vec3::ONE)
        };
        let (left, top) = (column.floor(), row.floor());
        let upper = pixel(left, top).lerp(pixel(left + 1.0, top), column - left);
        let lower = pixel(left, top + 1.0).lerp(pixel(left + 1.0, top + 1.0), column - left);
        upper.lerp(lower, row - top)
    }
}
