//! Widths and colours of lines.

use glam::Vec3;

/// Widths of lines in pixels of a picture of 1920 x 1080; 0 draws none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lines {
    /// All but rims and pins.
    pub color: Vec3,
    /// Rims and pinch points.
    pub rim_color: Vec3,
    /// Pins.
    pub pin_color: Vec3,
    /// Outlines.
    pub silhouette: f32,
    /// Edges bent by more than [`Lines::crease_angle`].
    pub crease: f32,
    /// Radians.
    pub crease_angle: f32,
    /// Ends of the surface.
    pub boundary: f32,
    /// Curves where the surface passes through itself.
    pub intersection: f32,
    /// Edges where the surface folds over.
    pub rim: f32,
    /// Vertices whose star is a figure-eight.
    pub pinch: f32,
    /// Vertices that are held.
    pub pin: f32,
    /// Whether lines far away are thinner; widths are then those at the middle of what is framed.
    pub perspective: bool,
}

impl Lines {
    /// No lines at all.
    pub const NONE: Lines = Lines {
        color: Vec3::ZERO,
        rim_color: Vec3::ZERO,
        pin_color: Vec3::ZERO,
        silhouette: 0.0,
        crease: 0.0,
        crease_angle: 0.7,
        boundary: 0.0,
        intersection: 0.0,
        rim: 0.0,
        pinch: 0.0,
        pin: 0.0,
        perspective: false,
    };
}
