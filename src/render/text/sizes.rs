//! Sizes of what is written, which go with the picture.

use glam::Vec2;

/// Lengths in pixels that go with the picture.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
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
    pub fn of(size: Vec2, share: f32) -> Sizes {
        let label = (size.min_element() / LABELS_PER_SIDE).max(LEAST_LABEL) * share;
        Sizes { label, tick: 0.84 * label, margin: 1.5 * label, stroke: (label / 18.0).round().max(1.0) }
    }
}
