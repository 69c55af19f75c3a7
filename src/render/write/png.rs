//! PNG files.

use std::path::Path;

use png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};

use super::{
    Film, Metadata, RenderError,
    film::{write_error, write_whole},
};

/// How a PNG file is written; by default fast and with 8 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Png {
    /// 16 bits a channel in place of 8.
    pub sixteen_bits: bool,
    /// Takes more than ten times as long for files that are a good part smaller.
    pub small: bool,
}

impl Film {
    /// Writes the picture over its background as an sRGB PNG, 8 bits dithered. The file appears whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the file cannot be encoded or written.
    pub fn write_png(&self, path: &Path, style: Png, metadata: &Metadata) -> Result<(), RenderError> {
        let bytes = self.png_bytes(style, metadata).map_err(|error| write_error(path, error))?;
        write_whole(path, &bytes)
    }

    fn png_bytes(&self, style: Png, metadata: &Metadata) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.width as u32, self.height as u32);
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
