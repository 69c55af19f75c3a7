//! Animated PNG: all colours, larger files.

use std::{fs::File, io::BufWriter};

use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent, Writer};

use super::draft::Draft;
use super::reeling::{Animation, Reeling};
use crate::film::error::FilmError;
use crate::render::Metadata;

pub(super) struct Apng {
    writer: Writer<BufWriter<File>>,
    draft: Draft,
}

/// Seconds for which a frame is shown, as numerator and denominator: as nearly as both have room for.
fn delay(rate: f64) -> (u16, u16) {
    let most = f64::from(u16::MAX);
    // The smaller of the two is 1000, which divides usual rates, or as much as leaves room for the other.
    let less = 1000.0_f64.min((most / rate.max(1.0 / rate)).floor()).max(1.0);
    let more = (less * rate.max(1.0 / rate)).round().clamp(1.0, most);
    if rate >= 1.0 { (less as u16, more as u16) } else { (more as u16, less as u16) }
}

impl Apng {
    pub fn begin(draft: Draft, reeling: Reeling) -> Result<Apng, FilmError> {
        let mut encoder = Encoder::new(draft.writer()?, reeling.width as u32, reeling.height as u32);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        let (numerator, denominator) = delay(reeling.rate);
        let begin = || {
            encoder.set_animated(reeling.frames as u32, 0)?;
            encoder.set_frame_delay(numerator, denominator)?;
            encoder.add_itxt_chunk("Software".into(), Metadata::SOFTWARE.into())?;
            encoder.write_header()
        };
        let writer = begin().map_err(|error| draft.error(error))?;
        Ok(Apng { writer, draft })
    }
}

impl Animation for Apng {
    fn push(&mut self, pixels: &[u8]) -> Result<(), FilmError> {
        self.writer.write_image_data(pixels).map_err(|error| self.draft.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), FilmError> {
        self.writer.finish().map_err(|error| self.draft.error(error))?;
        self.draft.publish()
    }
}
