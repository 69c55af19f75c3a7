//! Text on a picture.

use glam::{Vec2, Vec3};

use super::super::{Film, canvas::Canvas};
use super::layout::Line;

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

impl Film {
    /// Writes a line over the picture, its baseline at `at`: pixels from the upper left corner, y down. What lies
    /// outside the picture is left out.
    pub fn draw_text(&mut self, text: &str, at: Vec2, style: &TextStyle) {
        self.canvas().draw_text(text, at, style);
    }
}

/// Sizes beyond which no text is legible, or of use.
const SIZES: std::ops::RangeInclusive<f32> = 1.0..=4096.0;

impl Canvas<'_> {
    pub(in super::super) fn draw_text(&mut self, text: &str, at: Vec2, style: &TextStyle) {
        if !SIZES.contains(&style.size) || !at.is_finite() {
            return;
        }
        let line = Line::new(text, style.size);
        let before = match style.anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => line.width / 2.0,
            Anchor::Right => line.width,
        };
        // On a whole row, baselines and the tops of letters are sharp.
        for glyph in line.outlines(at.x - before, at.y.round()) {
            let bounds = glyph.px_bounds();
            let (left, top) = (bounds.min.x as i64, bounds.min.y as i64);
            glyph.draw(|x, y, share| {
                self.blend(left + i64::from(x), top + i64::from(y), style.color, share.clamp(0.0, 1.0));
            });
        }
    }
}
