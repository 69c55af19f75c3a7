//! Drawing flat shapes on a finished picture.

use glam::{Vec2, Vec3, Vec4};

use crate::render::Picture;

/// Pixels that can be drawn on: linear light times coverage, and coverage, row by row from the top. Places are in
/// pixels from the upper left corner, y down; the middle of the first pixel is (0.5, 0.5).
#[derive(Debug)]
pub struct Canvas<'a> {
    /// Size of the whole picture.
    pub(in crate::render) whole: [usize; 2],
    /// Where the part that the pixels are of begins, and its size.
    pub(in crate::render) corner: [usize; 2],
    pub(in crate::render) width: usize,
    pub(in crate::render) height: usize,
    pub(in crate::render) pixels: &'a mut [Vec4],
}

impl Canvas<'_> {
    /// Pixels across and down.
    pub(in crate::render) fn size(&self) -> Vec2 {
        Vec2::from(self.whole.map(|side| side as f32))
    }

    /// Lays a colour over a share of a pixel. Pixels outside are left out.
    pub(in crate::render) fn blend(&mut self, x: i64, y: i64, color: Vec3, share: f32) {
        let (x, y) = (x - self.corner[0] as i64, y - self.corner[1] as i64);
        if (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y) {
            let pixel = &mut self.pixels[y as usize * self.width + x as usize];
            *pixel = color.extend(1.0) * share + *pixel * (1.0 - share);
        }
    }

    /// Fills a shape that lies between two corners, given by its signed distance, negative inside, with a colour and an
    /// opacity at each place.
    pub(in crate::render) fn fill(
        &mut self,
        [low, high]: [Vec2; 2],
        distance: impl Fn(Vec2) -> f32,
        paint: impl Fn(Vec2) -> (Vec3, f32),
    ) {
        // One pixel more for smooth edges.
        let low = (low - 1.0).floor().max(Vec2::ZERO);
        let high = (high + 1.0).ceil().min(self.size());
        for y in low.y as i64..high.y as i64 {
            for x in low.x as i64..high.x as i64 {
                let place = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let share = (0.5 - distance(place)).clamp(0.0, 1.0);
                if share > 0.0 {
                    let (color, opacity) = paint(place);
                    self.blend(x, y, color, share * opacity);
                }
            }
        }
    }

    /// Fills a rectangle with rounded corners.
    pub(in crate::render) fn fill_rounded(
        &mut self,
        corners: [Vec2; 2],
        radius: f32,
        paint: impl Fn(Vec2) -> (Vec3, f32),
    ) {
        self.fill(corners, rounded(corners, radius), paint);
    }
}

/// Signed distance from a rectangle with rounded corners.
pub(in crate::render) fn rounded([low, high]: [Vec2; 2], radius: f32) -> impl Fn(Vec2) -> f32 + Copy {
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    move |place| {
        let outside = (place - middle).abs() - (half - radius);
        outside.max(Vec2::ZERO).length() + outside.max_element().min(0.0) - radius
    }
}

impl Picture {
    /// The picture to draw on.
    pub(in crate::render) fn canvas(&mut self) -> Canvas<'_> {
        Canvas {
            whole: self.whole,
            corner: self.corner,
            width: self.width,
            height: self.height,
            pixels: &mut self.beauty,
        }
    }
}
