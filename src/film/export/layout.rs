//! How frames are laid out in files.

use super::subject::Moment;

/// How frames are laid out in files.
pub(super) trait Layout: Sync {
    /// The ending of the files of which each frame has one; `None` if all frames go into one file.
    fn ending(&self) -> Option<&'static str> {
        None
    }

    /// What is written of a frame: the bytes of its file, or its pieces of each part of the one file, always as many.
    ///
    /// # Errors
    /// In words, if a library cannot write it.
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String>;

    /// The files that there are once, of these frames, whose pieces have so many bytes in each part.
    fn end(&self, frames: &[Mark], pieces: &[u64]) -> Vec<(&'static str, Vec<Part>)>;
}

/// A frame that has been written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    pub number: usize,
    pub time: f64,
}

/// A part of a file.
pub(super) enum Part {
    Bytes(Vec<u8>),
    /// The pieces of all frames of this number, in order.
    Pieces(usize),
}

/// The file of a frame in a sequence.
pub(super) fn file_of_frame(number: usize, ending: &str) -> String {
    format!("film.{number:06}.{ending}")
}
