//! Text on a picture.

use glam::{Vec2, Vec3};

use super::{canvas::Canvas, layout::Line};
use crate::render::Picture;

/// How a text looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// Size of the font (the em) in pixels; capitals are 0.73 of it high.
    pub size: f32,
    /// Linear light.
    pub color: Vec3,
    /// What part of the text the given place belongs to.
    pub anchor: Anchor,
}

/// The point of the baseline that stands at the given place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Where the text begins.
    Left,
    /// Its middle.
    Middle,
    /// Where it ends.
    Right,
}

impl Picture {
    /// Writes a line over the picture, its baseline at `at`: pixels from the upper left corner, y down. What lies
    /// outside the picture is left out.
    pub fn draw_text(&mut self, text: &str, at: Vec2, style: &TextStyle) {
        self.canvas().draw_text(text, at, style);
    }
}

/// Sizes beyond which no text is legible, or of use.
const SIZES: std::ops::RangeInclusive<f32> = 1.0..=4096.0;

/// In linear light, edges that are half covered are brighter to the eye than half: dark letters would look thinner
/// than the font means them, and bright ones bolder. Their coverage is raised to this power, or its inverse.
const THICKENING: f32 = 0.8;
/// Linear light halfway between black and white to the eye.
pub const MIDDLE_GREY: f32 = 0.18;

impl Canvas<'_> {
    pub(in crate::render) fn draw_text(&mut self, text: &str, at: Vec2, style: &TextStyle) {
        if !SIZES.contains(&style.size) || !at.is_finite() {
            return;
        }
        let line = Line::new(text, style.size);
        let before = match style.anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => line.width / 2.0,
            Anchor::Right => line.width,
        };
        let bright = style.color.dot(Vec3::new(0.2126, 0.7152, 0.0722)) > MIDDLE_GREY;
        let weight = if bright { 1.0 / THICKENING } else { THICKENING };
        // On a whole row, baselines and the tops of letters are sharp.
        for glyph in line.outlines(at.x - before, at.y.round()) {
            let bounds = glyph.px_bounds();
            let size = self.size();
            if bounds.max.x < 0.0 || bounds.max.y < 0.0 || bounds.min.x > size.x || bounds.min.y > size.y {
                continue;
            }
            let (left, top) = (bounds.min.x as i64, bounds.min.y as i64);
            glyph.draw(|x, y, share| {
                let share = libm::powf(share.clamp(0.0, 1.0), weight);
                self.blend(left + i64::from(x), top + i64::from(y), style.color, share);
            });
        }
    }
}
