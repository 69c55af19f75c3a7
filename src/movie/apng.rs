//! Animated PNG: all colours, larger files.

use std::{fs::File, io::BufWriter};

use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent, Writer};

use super::{
    MovieError,
    animation::{Animation, Draft, Reeling},
};
use crate::render::Metadata;

pub(super) struct Apng {
    writer: Writer<BufWriter<File>>,
    draft: Draft,
}

/// A frame is shown for this many parts of a second; the parts are what is given.
const NUMERATOR: u16 = 60;

impl Apng {
    pub fn begin(draft: Draft, reeling: Reeling) -> Result<Apng, MovieError> {
        let mut encoder = Encoder::new(draft.writer()?, reeling.width as u32, reeling.height as u32);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        let denominator = (f64::from(NUMERATOR) * reeling.rate).round().clamp(1.0, f64::from(u16::MAX)) as u16;
        let begin = || {
            encoder.set_animated(reeling.frames as u32, 0)?;
            encoder.set_frame_delay(NUMERATOR, denominator)?;
            encoder.add_itxt_chunk("Software".into(), Metadata::SOFTWARE.into())?;
            encoder.write_header()
        };
        let writer = begin().map_err(|error| draft.error(error))?;
        Ok(Apng { writer, draft })
    }
}

impl Animation for Apng {
    fn push(&mut self, pixels: &[u8]) -> Result<(), MovieError> {
        self.writer.write_image_data(pixels).map_err(|error| self.draft.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), MovieError> {
        self.writer.finish().map_err(|error| self.draft.error(error))?;
        self.draft.publish()
    }
}
