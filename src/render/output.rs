//! How large a picture is and how finely it is sampled.

use super::RenderError;

/// Size and sampling of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output {
    width: usize,
    height: usize,
    samples: usize,
    layers: bool,
    reserved: f64,
    window: [usize; 4],
}

impl Output {
    /// Longest side of a picture in pixels.
    pub const LONGEST_SIDE: usize = 16_384;

    /// How many samples a pixel can have.
    pub const SAMPLES: [usize; 4] = [1, 4, 8, 16];

    /// A picture of `width` times `height` pixels with 1, 4, 8 or 16 samples in each.
    ///
    /// # Errors
    /// [`RenderError::Size`] on an impossible size, [`RenderError::Samples`] on another number of samples.
    pub fn new(width: usize, height: usize, samples: usize) -> Result<Self, RenderError> {
        let possible = 1..=Self::LONGEST_SIDE;
        if !possible.contains(&width) || !possible.contains(&height) {
            return Err(RenderError::Size { width, height, limit: Self::LONGEST_SIDE });
        }
        if !Self::SAMPLES.contains(&samples) {
            return Err(RenderError::Samples { samples });
        }
        Ok(Self { width, height, samples, layers: false, reserved: 0.0, window: [0, 0, width, height] })
    }

    /// The same picture, of which only a window is made. The window is given by x and y of its upper left corner, its width
    /// and its height, all in pixels.
    ///
    /// # Errors
    /// [`RenderError::Crop`] if it is empty or does not lie in the picture.
    pub fn with_crop(self, window: [usize; 4]) -> Result<Self, RenderError> {
        if Self::holds([self.width, self.height], window) {
            return Ok(Self { window, ..self });
        }
        Err(RenderError::Crop { window, width: self.width, height: self.height })
    }

    /// Whether a window has pixels and lies in a picture of this width and height. It is given by x and y of its upper left
    /// corner, its width and its height.
    pub fn holds(size: [usize; 2], [x, y, width, height]: [usize; 4]) -> bool {
        let fits = |start: usize, length: usize, whole: usize| {
            length > 0 && start.checked_add(length).is_some_and(|end| end <= whole)
        };
        fits(x, width, size[0]) && fits(y, height, size[1])
    }

    /// The window of the picture that is made, as x, y, width and height. Usually it is the whole picture.
    pub fn window(&self) -> [usize; 4] {
        self.window
    }

    /// The same with or without layers.
    pub fn with_layers(self, layers: bool) -> Self {
        Self { layers, ..self }
    }

    /// The same with a share of the width, from 0 to 0.5, that is kept free at the right edge when a film is framed.
    pub fn reserving(self, share: f64) -> Self {
        Self { reserved: share.clamp(0.0, 0.5), ..self }
    }

    /// Share of the width that is kept free at the right edge.
    pub(super) fn reserved(&self) -> f64 {
        self.reserved
    }

    /// Whether the picture has [`Layers`](super::Layers).
    pub fn has_layers(&self) -> bool {
        self.layers
    }

    /// Pixels across.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Samples per pixel.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Width over height.
    pub(super) fn aspect(&self) -> f64 {
        self.width as f64 / self.height as f64
    }

    /// Pixels of a line that is `width` wide in a picture of 1920 times 1080 pixels.
    pub(super) fn line_pixels(&self, width: f32) -> f32 {
        width * ((self.width * self.height) as f32 / (1920.0 * 1080.0)).sqrt().max(0.4)
    }
}
