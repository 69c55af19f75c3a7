//! GIF: 256 colours for the whole film.

use std::{borrow::Cow, fs::File, io::BufWriter, io::Write};

use gif::{AnyExtension, Encoder, Extension, Frame, Repeat};
use rayon::prelude::*;

use super::draft::Draft;
use super::palette::Palette;
use super::reeling::{Animation, Reeling};
use crate::film::error::FilmError;
use crate::render::Metadata;

pub(super) struct Gif {
    encoder: Encoder<BufWriter<File>>,
    palette: Palette,
    reeling: Reeling,
    pushed: usize,
    draft: Draft,
}

impl Gif {
    pub fn begin(draft: Draft, reeling: Reeling, palette: Palette) -> Result<Gif, FilmError> {
        let begin = |file| {
            let mut encoder = Encoder::new(file, reeling.width as u16, reeling.height as u16, palette.colors())?;
            encoder.set_repeat(Repeat::Infinite)?;
            let comment = Metadata::SOFTWARE;
            encoder.write_raw_extension(AnyExtension(Extension::Comment as u8), &[comment.as_bytes()])?;
            Ok::<_, gif::EncodingError>(encoder)
        };
        let encoder = begin(draft.writer()?).map_err(|error| draft.error(error))?;
        Ok(Gif { encoder, palette, reeling, pushed: 0, draft })
    }

    /// Hundredths of a second for which a frame is shown. They differ by one, so that the whole film is as long as it
    /// should be.
    fn delay(&self) -> u16 {
        let end = |frames: usize| (100.0 * frames as f64 / self.reeling.rate).round();
        (end(self.pushed + 1) - end(self.pushed)).clamp(SHORTEST, LONGEST) as u16
    }
}

/// Hundredths of a second: viewers slow down what is faster than the first, and the format holds no more than the last.
const SHORTEST: f64 = 2.0;
const LONGEST: f64 = u16::MAX as f64;

/// What a GIF of so many frames makes of a number of frames a second, if it is another one.
pub(in crate::film) fn note(rate: f64, frames: usize) -> Option<String> {
    let shown = rate.clamp(100.0 / LONGEST, 100.0 / SHORTEST);
    if shown == rate {
        return None;
    }
    let [asked, takes] = [rate, shown].map(|rate| frames as f64 / rate);
    Some(format!(
        "film.gif shows {} frames a second and takes {takes:.2} s, not {rate} and {asked:.2} s: its delays are 0.02 s to \
         655.35 s; set frame_rate between 0.00153 and 50, or ask for apng or mp4",
        if shown < rate { "50" } else { "0.00153" }
    ))
}

impl Animation for Gif {
    fn push(&mut self, pixels: &[u8]) -> Result<(), FilmError> {
        let (width, height) = (self.reeling.width, self.reeling.height);
        let (colors, _) = pixels.as_chunks::<3>();
        let index = |(at, &color): (usize, &[u8; 3])| self.palette.index(color, at % width, at / width);
        let indices: Vec<u8> = colors.par_iter().enumerate().with_min_len(4096).map(index).collect();
        let frame = Frame {
            width: width as u16,
            height: height as u16,
            delay: self.delay(),
            buffer: Cow::Owned(indices),
            ..Frame::default()
        };
        self.pushed += 1;
        self.encoder.write_frame(&frame).map_err(|error| self.draft.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        let Gif { encoder, draft, .. } = *self;
        let mut file = encoder.into_inner().map_err(|error| draft.error(error))?;
        file.flush().map_err(|error| draft.error(error))?;
        drop(file);
        draft.publish()
    }
}
