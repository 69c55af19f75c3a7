//! OpenEXR files.

use std::{io::Cursor, path::Path};

use exr::{
    meta::attribute::{AttributeValue, Chromaticities, IntegerBounds, Matrix4x4, Text},
    prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, Layer, LayerAttributes, SmallVec, Vec2,
        WritableImage, f16,
    },
};
use glam::{DMat4, DVec3};

use super::{
    file::{write_error, write_whole},
    metadata::Metadata,
};
use crate::render::{Camera, Layers, Picture, RenderError};

impl Picture {
    /// Writes an OpenEXR file of one part, ZIP compressed, in linear light with Rec. 709 primaries and without the
    /// background. The display window is the whole picture, the data window the part that was made. The file appears
    /// whole or not at all. Channels:
    ///
    /// | name | type | |
    /// |---|---|---|
    /// | `R`, `G`, `B`, `A` | half | colour multiplied by coverage, and coverage |
    /// | `Z` | float | distance from the eye along the axis of view; infinite where nothing is |
    /// | `N.X`, `N.Y`, `N.Z` | half | normal of the front in world space |
    /// | `P.X`, `P.Y`, `P.Z` | float | place in world space |
    /// | `faceId` | uint | triangle, 4294967295 where none is |
    /// | `side` | half | 1 where the front is seen, -1 where the back is |
    /// | `motion.X`, `motion.Y` | float | pixels to the next frame, right and down |
    /// | `occlusion` | half | share of the sky that is seen |
    /// | names of fields | float | not a number where no surface is |
    ///
    /// All but the first four only if the picture has layers.
    ///
    /// # Errors
    /// [`RenderError::Write`] if the file cannot be encoded or written.
    pub fn write_exr(&self, path: &Path, metadata: &Metadata) -> Result<(), RenderError> {
        let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
        for (axis, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
            channels.push(AnyChannel::new(name, halves(self.beauty.iter().map(|light| light[axis]))));
        }
        if let Some(layers) = &self.layers {
            push_layers(layers, &mut |name, samples| channels.push(AnyChannel::new(latin(name), samples)));
        }
        let layer = Layer::new(
            (self.width, self.height),
            attributes(metadata).with_position(Vec2(self.corner[0] as i32, self.corner[1] as i32)),
            Encoding::SMALL_LOSSLESS,
            AnyChannels::sort(channels),
        );
        let mut image = Image::from_layer(layer);
        image.attributes = ImageAttributes {
            chromaticities: Some(REC_709),
            ..ImageAttributes::new(IntegerBounds::from_dimensions((self.whole[0], self.whole[1])))
        };
        let mut bytes = Cursor::new(Vec::new());
        image.write().to_buffered(&mut bytes).map_err(|error| write_error(path, error))?;
        let mut bytes = bytes.into_inner();
        sort_attributes(&mut bytes);
        write_whole(path, &bytes)
    }
}

const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

fn halves(values: impl Iterator<Item = f32>) -> FlatSamples {
    FlatSamples::F16(values.map(f16::from_f32).collect())
}

fn push_layers(layers: &Layers, push: &mut dyn FnMut(&str, FlatSamples)) {
    push("Z", FlatSamples::F32(layers.depth.clone()));
    for (axis, letter) in ["X", "Y", "Z"].into_iter().enumerate() {
        push(&format!("N.{letter}"), halves(layers.normals.iter().map(|normal| normal[axis])));
        push(&format!("P.{letter}"), FlatSamples::F32(layers.positions.iter().map(|place| place[axis]).collect()));
    }
    push("faceId", FlatSamples::U32(layers.face_ids.clone()));
    push("side", halves(layers.sides.iter().copied()));
    push("motion.X", FlatSamples::F32(layers.motion.iter().map(|motion| motion.x).collect()));
    push("motion.Y", FlatSamples::F32(layers.motion.iter().map(|motion| motion.y).collect()));
    push("occlusion", halves(layers.occlusion.iter().copied()));
    for (name, values) in &layers.fields {
        push(name, FlatSamples::F32(values.clone()));
    }
}

fn attributes(metadata: &Metadata) -> LayerAttributes {
    let mut attributes =
        LayerAttributes { software_name: Some(latin(Metadata::SOFTWARE)), ..LayerAttributes::default() };
    let mut say = |name: &str, value: AttributeValue| drop(attributes.other.insert(latin(name), value));
    if !metadata.scene.is_empty() {
        say("scene", AttributeValue::Text(latin(&metadata.scene)));
    }
    if metadata.frame > 0 {
        say("frame", AttributeValue::I32(count(metadata.frame)));
        say("time", AttributeValue::F64(metadata.time));
    }
    if !metadata.comment.is_empty() {
        attributes.comments = Some(latin(&metadata.comment));
    }
    if metadata.frame_rate > 0.0 {
        attributes.frames_per_second = Some(((metadata.frame_rate * 1000.0).round() as i32, 1000));
    }
    if let Some(camera) = &metadata.camera {
        attributes.world_to_camera = Some(world_to_camera(camera));
        attributes.world_to_normalized_device = Some(world_to_ndc(camera));
        if camera.is_perspective() {
            attributes.vertical_field_of_view = Some(camera.field_of_view().to_degrees() as f32);
        }
    }
    attributes
}

/// A number of frames as OpenEXR has it, which ends at 2³¹ − 1.
fn count(frames: usize) -> i32 {
    i32::try_from(frames).unwrap_or(i32::MAX)
}

/// Camera space of OpenEXR is left-handed: x to the right, y up, z in the direction of view.
fn world_to_camera(camera: &Camera) -> Matrix4x4 {
    row_vector_matrix(DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * DMat4::from(camera.view_from_world()))
}

/// Device space of OpenEXR goes from (0, 0) in the upper left corner of the display window to (1, 1).
fn world_to_ndc(camera: &Camera) -> Matrix4x4 {
    let to_unit = DMat4::from_translation(DVec3::new(0.5, 0.5, 0.0)) * DMat4::from_scale(DVec3::new(0.5, -0.5, 1.0));
    row_vector_matrix(to_unit * camera.clip_from_view() * DMat4::from(camera.view_from_world()))
}

/// OpenEXR multiplies rows by matrices and lists matrices row by row: the columns of ours.
fn row_vector_matrix(matrix: DMat4) -> Matrix4x4 {
    matrix.to_cols_array().map(|value| value as f32)
}

/// Puts the attributes of the header in the order of their names, so that the same picture has the same bytes: the
/// encoder keeps them in a hash map. The header keeps its length.
fn sort_attributes(file: &mut [u8]) {
    // Magic number and version come first; an attribute is name, type (both end with 0), size and value; an empty
    // name ends the header.
    const START: usize = 8;
    let text_end = |from: usize| file[from..].iter().position(|&byte| byte == 0).map(|length| from + length + 1);
    let attribute_end = |from: usize| {
        let size_at = text_end(text_end(from)?)?;
        let size = file.get(size_at..size_at + 4)?.try_into().map(u32::from_le_bytes).ok()?;
        Some(size_at + 4 + size as usize).filter(|&end| end < file.len())
    };
    let (mut attributes, mut at) = (Vec::new(), START);
    while file.get(at).is_some_and(|&byte| byte != 0) {
        let Some(end) = attribute_end(at) else { return };
        attributes.push(file[at..end].to_vec());
        at = end;
    }
    attributes.sort_unstable();
    file[START..at].copy_from_slice(&attributes.concat());
}

/// Texts of OpenEXR are Latin-1.
fn latin(text: &str) -> Text {
    let known = |c: char| if u8::try_from(u32::from(c)).is_ok() { c } else { '?' };
    Text::new_or_none(text.chars().map(known).collect::<String>()).unwrap_or_default()
}
