//! PLY, a binary file of each frame with normals, colours and fields.

use std::fmt::Write;

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};
use crate::immersion::{FieldName, FieldValues};
use crate::render::srgb_bytes;
use glam::Vec3;

pub(super) struct Ply<'a>(pub &'a Subject);

impl Layout for Ply<'_> {
    fn ending(&self) -> Option<&'static str> {
        Some("ply")
    }

    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        let Subject { made_by, triangles, vertices, colors, .. } = self.0;
        let (of_faces, of_vertices): (Vec<_>, Vec<_>) = moment.fields.iter().partition(|(_, of)| of.is_per_face());
        let front = srgb_bytes(colors.sides[0], 0.0);
        let painted = |per_face: bool| moment.colors.as_ref().filter(|painted| painted.per_face == per_face);
        // Colours of faces stand at faces, so that nothing is smeared.
        let face_colors = painted(true);
        let mut text = String::from("ply\nformat binary_little_endian 1.0\n");
        // Writing to a string does not fail.
        let _ = writeln!(text, "comment {made_by}, frame {}, time {}", moment.number, moment.time);
        let _ = writeln!(text, "element vertex {vertices}");
        text += "property double x\nproperty double y\nproperty double z\n";
        text += "property float nx\nproperty float ny\nproperty float nz\n";
        if face_colors.is_none() {
            text += COLORS;
        }
        properties(&mut text, &of_vertices);
        let _ = writeln!(text, "element face {}", triangles.len());
        text += "property list uchar int vertex_indices\n";
        if face_colors.is_some() {
            text += COLORS;
        }
        properties(&mut text, &of_faces);
        text += "end_header\n";

        let mut bytes = text.into_bytes();
        let bytes_of = |color: Option<&Vec3>| color.map_or(front, |&color| srgb_bytes(color, 0.0));
        for (v, (place, normal)) in moment.positions.iter().zip(&moment.normals).enumerate() {
            place.to_array().into_iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            normal.to_array().into_iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            if face_colors.is_none() {
                bytes.extend(bytes_of(painted(false).and_then(|painted| painted.colors.get(v))));
            }
            values(&mut bytes, &of_vertices, v);
        }
        for (f, corners) in triangles.iter().enumerate() {
            bytes.push(3);
            corners.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
            if let Some(painted) = face_colors {
                bytes.extend(bytes_of(painted.colors.get(f)));
            }
            values(&mut bytes, &of_faces, f);
        }
        Ok(vec![bytes])
    }

    fn end(&self, _: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        Vec::new()
    }
}

const COLORS: &str = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

fn properties(text: &mut String, fields: &[&(FieldName, FieldValues)]) {
    fields.iter().for_each(|(name, _)| *text += &format!("property float {}\n", name.name()));
}

fn values(bytes: &mut Vec<u8>, fields: &[&(FieldName, FieldValues)], at: usize) {
    fields.iter().for_each(|(_, values)| bytes.extend(values.all()[at].to_le_bytes()));
}
