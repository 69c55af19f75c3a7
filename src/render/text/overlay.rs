//! What is written and drawn over a finished picture.

use glam::{Vec2, Vec3};

use super::{
    Film, Legend,
    color::linear_from_srgb,
    text::{Anchor, CAPITAL_HEIGHT, MIDDLE_GREY, TextStyle},
};
use crate::scene::Corner;

/// Labels and legend. Sizes go with the picture: at any size it looks the same, as far as letters stay legible.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// Lines of text and where they stand. Those of a corner are below each other, in their order.
    pub texts: Vec<(Corner, String)>,
    /// Beside the right edge.
    pub legend: Option<Legend>,
    /// Size of labels and legend, as a share of the usual one.
    pub text_size: f32,
}

impl Default for Overlay {
    fn default() -> Self {
        Self { texts: Vec::new(), legend: None, text_size: 1.0 }
    }
}

/// Lengths in pixels that go with the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// Font size of labels.
    pub label: f32,
    /// Font size of numbers at ticks.
    pub tick: f32,
    /// Between the edge of the picture and what is drawn.
    pub margin: f32,
    /// Thickness of thin lines.
    pub stroke: f32,
}

/// Labels in a picture: its shorter side over this.
const LABELS_PER_SIDE: f32 = 42.0;
/// Smaller letters cannot be read.
const LEAST_LABEL: f32 = 10.0;

impl Sizes {
    fn of(size: Vec2, share: f32) -> Sizes {
        let label = (size.min_element() / LABELS_PER_SIDE).max(LEAST_LABEL) * share;
        Sizes { label, tick: 0.84 * label, margin: 1.5 * label, stroke: (label / 18.0).round().max(1.0) }
    }
}

/// From line to line, in font sizes.
const LEADING: f32 = 1.45;

impl Film {
    /// Draws labels and legend in the colour `ink` (linear light), such as that of [`Film::ink`].
    pub fn draw_overlay(&mut self, overlay: &Overlay, ink: Vec3) {
        let mut canvas = self.canvas();
        let size = canvas.size();
        let sizes = Sizes::of(size, overlay.text_size);
        for corner in [Corner::TopLeft, Corner::TopRight, Corner::BottomLeft, Corner::BottomRight] {
            let of_corner = overlay.texts.iter().filter(|(place, _)| *place == corner);
            let lines: Vec<&str> = of_corner.flat_map(|(_, text)| text.lines()).collect();
            let (x, anchor) = match corner {
                Corner::TopLeft | Corner::BottomLeft => (sizes.margin, Anchor::Left),
                Corner::TopRight | Corner::BottomRight => (size.x - sizes.margin, Anchor::Right),
            };
            let first = match corner {
                Corner::TopLeft | Corner::TopRight => sizes.margin + CAPITAL_HEIGHT * sizes.label,
                Corner::BottomLeft | Corner::BottomRight => {
                    size.y - sizes.margin - lines.len().saturating_sub(1) as f32 * LEADING * sizes.label
                }
            };
            for (k, line) in lines.into_iter().enumerate() {
                let place = Vec2::new(x, first + k as f32 * LEADING * sizes.label);
                canvas.draw_text(line, place, &TextStyle { size: sizes.label, color: ink, anchor });
            }
        }
        if let Some(legend) = &overlay.legend {
            legend.draw(&mut canvas, &sizes, ink);
        }
    }

    /// A colour that reads well on the background, in linear light: nearly black or nearly white.
    pub fn ink(&self) -> Vec3 {
        let luminance = |color: &Vec3| color.dot(Vec3::new(0.2126, 0.7152, 0.0722));
        let mean = self.background.iter().map(luminance).sum::<f32>() / self.background.len().max(1) as f32;
        linear_from_srgb(if mean > MIDDLE_GREY { [0x2B, 0x29, 0x28] } else { [0xE9, 0xE7, 0xE2] })
    }
}
