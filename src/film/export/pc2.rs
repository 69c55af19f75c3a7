//! A point cache (PC2), which moves the vertices of the OBJ file beside it: the Mesh Cache of Blender, 3ds Max and Houdini.

use super::layout::{Layout, Mark, Part};
use super::obj;
use super::subject::{Moment, Subject};

pub(super) struct Pc2<'a>(pub &'a Subject);

impl Layout for Pc2<'_> {
    fn frame(&self, moment: &Moment) -> Result<Vec<Vec<u8>>, String> {
        let places = moment.positions.iter().flat_map(|place| place.as_vec3().to_array());
        let points = places.flat_map(f32::to_le_bytes).collect();
        // The first one is the object that is moved.
        Ok(vec![points, if moment.place == 0 { obj::text(self.0, moment) } else { Vec::new() }])
    }

    fn end(&self, frames: &[Mark], _: &[u64]) -> Vec<(&'static str, Vec<Part>)> {
        let mut head = b"POINTCACHE2\0".to_vec();
        head.extend(1_i32.to_le_bytes());
        head.extend((self.0.vertices as u32).to_le_bytes());
        head.extend((frames.first().map_or(1, |first| first.number) as f32).to_le_bytes());
        head.extend(1_f32.to_le_bytes());
        head.extend((frames.len() as u32).to_le_bytes());
        vec![("film.pc2", vec![Part::Bytes(head), Part::Pieces(0)]), ("film.obj", vec![Part::Pieces(1)])]
    }
}
