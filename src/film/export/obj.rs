//! Wavefront OBJ, a file of each frame: positions, normals, faces, and components as groups.

use std::fmt::Write;

use super::layout::{Layout, Mark, Part};
use super::subject::{Moment, Subject};

pub(super) struct Obj<'a>(pub &'a Subject);

impl Layout for Obj<'_> {
    fn ending(&self) -> Option<&'static str> {
        Some("obj")
    }

    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        Ok(vec![text(self.0, moment)])
    }

    fn end(&self, _: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        Vec::new()
    }
}

/// With as many digits as it takes to read the same positions back.
pub(super) fn text(subject: &Subject, moment: &Moment) -> Vec<u8> {
    let mut text = format!("# {}, frame {}, time {}\n", subject.made_by, moment.number, moment.time);
    // Writing to a string does not fail.
    for place in &moment.positions {
        let _ = writeln!(text, "v {:?} {:?} {:?}", place.x, place.y, place.z);
    }
    for normal in &moment.normals {
        let _ = writeln!(text, "vn {:?} {:?} {:?}", normal.x, normal.y, normal.z);
    }
    let has_normals = !moment.normals.is_empty();
    for (number, faces) in subject.components.iter().enumerate() {
        if subject.components.len() > 1 {
            let _ = writeln!(text, "g component_{}", number + 1);
        }
        for &face in faces {
            let [a, b, c] = subject.triangles[face as usize].map(|v| v + 1);
            let _ = match has_normals {
                true => writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}"),
                false => writeln!(text, "f {a} {b} {c}"),
            };
        }
    }
    text.into_bytes()
}
