//! What a mesh file says, whatever its format is.

use glam::DVec3;

use super::edges::EdgeNumbers;

/// What a file says, before any of it is checked against the rest.
#[derive(Default)]
pub(super) struct Soup {
    pub vertex_count: usize,
    /// One per vertex, all finite; `None` where the format leaves them out.
    pub positions: Option<Vec<DVec3>>,
    pub triangles: Vec<[u32; 3]>,
    /// Per triangle its line in the file; empty for binary files.
    pub lines: Vec<usize>,
    /// Per triangle the polygon of the file that it was cut from; empty where the file has triangles only.
    pub polygons: Vec<u32>,
    /// What x, y and z of each vertex mean, where it is not known whether they are positions.
    pub coordinates: Option<Vec<DVec3>>,
    /// Lengths that the file decrees, all above 0 where they are used.
    pub lengths: Option<EdgeNumbers>,
    /// Bending angles that the file decrees, in radians.
    pub angles: Option<EdgeNumbers>,
    /// Whether edges are called mountains or valleys.
    pub has_creases: bool,
    /// What the reader left out or changed, in sentences.
    pub notes: Vec<String>,
}

impl Soup {
    /// The polygon of the file that a triangle was cut from.
    pub fn polygon(&self, triangle: usize) -> usize {
        self.polygons.get(triangle).map_or(triangle, |&polygon| polygon as usize)
    }

    /// Lines of triangles, each once.
    pub fn lines_of(&self, triangles: &[usize]) -> Vec<usize> {
        let mut lines: Vec<usize> = triangles.iter().filter_map(|&f| self.lines.get(f).copied()).collect();
        lines.dedup();
        lines
    }
}
