//! What is written and drawn over a finished picture.

use glam::{Vec2, Vec3};

use super::{
    draw::{Anchor, MIDDLE_GREY, TextStyle},
    layout::CAPITAL_HEIGHT,
    legend::Legend,
    sizes::Sizes,
};
use crate::render::{Picture, look::linear_from_srgb};

/// Corners of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Corner {
    /// Upper left.
    TopLeft,
    /// Upper right.
    TopRight,
    /// Lower left.
    #[default]
    BottomLeft,
    /// Lower right.
    BottomRight,
}

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

/// From line to line, in font sizes.
const LEADING: f32 = 1.45;

impl Picture {
    /// Draws labels and legend in the colour `ink` (linear light), such as that of [`Picture::ink`].
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
