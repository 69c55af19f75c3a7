//! What all moving pictures have in common: they are written frame by frame.

use crate::film::error::FilmError;

/// A moving picture in the making. Frames are pushed in order as sRGB bytes, three per pixel, row by row.
pub(in crate::film) trait Animation: Send {
    fn push(&mut self, pixels: &[u8]) -> Result<(), FilmError>;

    /// The file appears, whole.
    fn finish(self: Box<Self>) -> Result<(), FilmError>;
}

/// How all frames of a moving picture are shown.
#[derive(Clone, Copy, Debug)]
pub(in crate::film) struct Reeling {
    pub width: usize,
    pub height: usize,
    pub frames: usize,
    /// Frames a second.
    pub rate: f64,
}
