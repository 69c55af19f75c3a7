use std::{io::Cursor, path::Path};

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, WritableImage, f16,
};

use super::{
    Film, RenderError,
    film::{write_error, write_whole},
};

impl Film {
    /// Writes an OpenEXR file: R, G, B, A as half floats (linear light, multiplied by coverage, without the
    /// background), Z (distance from the eye) and N.X, N.Y, N.Z (world space) as floats. The file appears
    /// whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the file cannot be encoded or written.
    pub fn write_exr(&self, path: &Path) -> Result<(), RenderError> {
        let color =
            |axis: usize| FlatSamples::F16(self.beauty.iter().map(|light| f16::from_f32(light[axis])).collect());
        let layers = self.layers.clone().unwrap_or_default();
        let normal = |axis: usize| FlatSamples::F32(layers.normals.iter().map(|normal| normal[axis]).collect());
        let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = [
            ("R", color(0)),
            ("G", color(1)),
            ("B", color(2)),
            ("A", color(3)),
            ("Z", FlatSamples::F32(layers.depth.clone())),
            ("N.X", normal(0)),
            ("N.Y", normal(1)),
            ("N.Z", normal(2)),
        ]
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples))
        .collect();
        let layer = Layer::new(
            (self.width, self.height),
            LayerAttributes::default(),
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels),
        );
        let mut bytes = Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).map_err(|error| write_error(path, error))?;
        write_whole(path, &bytes.into_inner())
    }
}
