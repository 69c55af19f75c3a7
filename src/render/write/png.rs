//! PNG files.

use std::{io, path::Path};

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

use super::{
    file::{write_error, write_whole},
    metadata::Metadata,
};
use crate::render::{Picture, RenderError};

/// How a PNG file is written; by default fast and with 8 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Png {
    /// Whether a channel has 16 bits in place of 8.
    pub sixteen_bits: bool,
    /// Whether to take more than ten times as long for a file that is clearly smaller.
    pub small: bool,
}

impl Png {
    /// Bits per channel that a file can have.
    pub const DEPTHS: [usize; 2] = [8, 16];
}

impl Picture {
    /// Writes the picture over its background as an sRGB PNG, 8 bits dithered. The file appears whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the file cannot be encoded or written.
    pub fn write_png(&self, path: &Path, style: Png, metadata: &Metadata) -> Result<(), RenderError> {
        let bytes = self.png_bytes(style, metadata).map_err(|error| write_error(path, error))?;
        write_whole(path, &bytes)
    }

    /// The bytes of what [`Picture::write_png`] writes.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the picture cannot be encoded.
    pub fn to_png(&self, style: Png, metadata: &Metadata) -> Result<Vec<u8>, RenderError> {
        self.png_bytes(style, metadata).map_err(|error| write_error(Path::new("a picture in memory"), error))
    }

    fn png_bytes(&self, style: Png, metadata: &Metadata) -> Result<Vec<u8>, EncodingError> {
        let side = |pixels: usize| {
            u32::try_from(pixels).map_err(|_| EncodingError::from(io::Error::from(io::ErrorKind::FileTooLarge)))
        };
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, side(self.width)?, side(self.height)?);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(if style.sixteen_bits { BitDepth::Sixteen } else { BitDepth::Eight });
        encoder.set_compression(if style.small { Compression::High } else { Compression::Fast });
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
        for (keyword, text) in metadata.texts() {
            encoder.add_itxt_chunk(keyword.to_owned(), text)?;
        }
        let mut writer = encoder.write_header()?;
        if style.sixteen_bits {
            let words = self.srgb_words();
            writer.write_image_data(&words.iter().flat_map(|word| word.to_be_bytes()).collect::<Vec<u8>>())?;
        } else {
            writer.write_image_data(&self.srgb_bytes())?;
        }
        writer.finish()?;
        Ok(bytes)
    }
}
