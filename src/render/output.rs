use super::RenderError;
use crate::scene::OutputSection;

/// Size and sampling of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    width: usize,
    height: usize,
    samples: usize,
    layers: bool,
    window: [usize; 4],
}

impl Output {
    /// Longest side of a picture in pixels.
    pub const LONGEST_SIDE: usize = 16_384;

    /// A picture of `width` times `height` pixels with 1, 4, 8 or 16 samples in each.
    ///
    /// # Errors
    /// [`RenderError::Size`] on an impossible size, [`RenderError::Samples`] on another number of samples.
    pub fn new(width: usize, height: usize, samples: usize) -> Result<Self, RenderError> {
        let possible = 1..=Self::LONGEST_SIDE;
        if !possible.contains(&width) || !possible.contains(&height) {
            return Err(RenderError::Size { width, height, limit: Self::LONGEST_SIDE });
        }
        if ![1, 4, 8, 16].contains(&samples) {
            return Err(RenderError::Samples(samples));
        }
        Ok(Self { width, height, samples, layers: false, window: [0, 0, width, height] })
    }

    /// The picture a scene asks for.
    ///
    /// # Errors
    /// As [`Output::new`].
    pub fn from_scene(section: &OutputSection) -> Result<Self, RenderError> {
        Ok(Self::new(section.size[0], section.size[1], section.samples)?.with_layers(section.exr))
    }

    /// The same with or without the layers of the film.
    pub fn with_layers(self, layers: bool) -> Self {
        Self { layers, ..self }
    }

    /// Only a part of the picture, `[x, y, width, height]` in its pixels from the upper left: the same bits as that
    /// part of the whole.
    ///
    /// # Errors
    /// [`RenderError::Crop`] if the part is empty or not inside the picture.
    pub fn with_crop(self, window: [usize; 4]) -> Result<Self, RenderError> {
        let [x, y, width, height] = window;
        let inside = |start: usize, length: usize, size: usize| length > 0 && start < size && length <= size - start;
        if inside(x, width, self.width) && inside(y, height, self.height) {
            return Ok(Self { window, ..self });
        }
        Err(RenderError::Crop { window, width: self.width, height: self.height })
    }

    /// The part of the picture that is made: x, y, width, height.
    pub fn window(&self) -> [usize; 4] {
        self.window
    }

    /// Whether the film has [`Layers`](super::Layers).
    pub fn has_layers(&self) -> bool {
        self.layers
    }

    /// Pixels across the whole picture.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels down the whole picture.
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
