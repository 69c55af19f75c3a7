//! FOLD 1.2, in which edge lengths and fold angles are first class: the first frame at the top of the file, the others as
//! `file_frames`, which inherit the mesh from it.

use serde_json::{Value, json};

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};
use crate::mesh::EdgeId;

pub(super) struct Fold<'a>(pub &'a Subject);

/// Angles that are called flat, in degrees.
const FLAT: f64 = 1e-6;

impl Layout for Fold<'_> {
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        let mut frame = self.arrays(moment);
        let Value::Object(entries) = &mut frame else { return Err("a frame is no object".into()) };
        if moment.place == 0 {
            let subject = self.0;
            let head = json!({
                "file_spec": 1.2,
                "file_creator": subject.made_by,
                "file_title": subject.name,
                "file_classes": if subject.frames.len() > 1 { ["animation"] } else { ["singleModel"] },
                "faces_vertices": subject.triangles,
                "edges_vertices": subject.edges,
            });
            let Value::Object(head) = head else { return Err("a file is no object".into()) };
            entries.extend(head);
            // Its last brace comes after the other frames.
            let mut text = serde_json::to_vec(&frame).map_err(|error| error.to_string())?;
            text.pop();
            return Ok(vec![text, Vec::new()]);
        }
        entries.insert("frame_inherit".into(), true.into());
        entries.insert("frame_parent".into(), 0.into());
        let mut text = serde_json::to_vec(&frame).map_err(|error| error.to_string())?;
        if moment.place > 1 {
            text.splice(0..0, *b",\n");
        }
        Ok(vec![Vec::new(), text])
    }

    fn end(&self, frames: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        let mut parts = vec![Part::Pieces(0)];
        if frames.len() > 1 {
            parts.push(Part::Bytes(b",\"file_frames\":[\n".to_vec()));
            parts.push(Part::Pieces(1));
            parts.push(Part::Bytes(b"]".to_vec()));
        }
        parts.push(Part::Bytes(b"}\n".to_vec()));
        vec![("film.fold", parts)]
    }
}

impl Fold<'_> {
    fn arrays(&self, moment: &Moment) -> Value {
        let Subject { mesh, .. } = self.0;
        // A valley, seen from the front, is positive; a convex edge is a mountain.
        let angles: Vec<f64> = moment.bending_angles.iter().map(|angle| -angle.to_degrees()).collect();
        let assignment = |(e, angle): (usize, &f64)| match *angle {
            _ if mesh.is_boundary_edge(EdgeId::new(e)) => "B",
            angle if angle > FLAT => "V",
            angle if angle < -FLAT => "M",
            _ => "F",
        };
        json!({
            "frame_title": format!("frame {}, time {}", moment.number, moment.time),
            "frame_classes": ["foldedForm"],
            "frame_attributes": ["3D"],
            "frame_unit": "unit",
            "vertices_coords": moment.positions.iter().map(|place| place.to_array()).collect::<Vec<_>>(),
            "edges_length": moment.edge_lengths,
            "edges_foldAngle": angles,
            "edges_assignment": angles.iter().enumerate().map(assignment).collect::<Vec<_>>(),
        })
    }
}
