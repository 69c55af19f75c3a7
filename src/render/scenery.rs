use glam::DVec3;

use super::RenderError;

/// What is to be seen: a triangulated surface and the curves on it, as plain borrowed data.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scenery<'a> {
    /// Corners of each triangle, counterclockwise seen from the front.
    pub triangles: &'a [[u32; 3]],
    /// One position per vertex.
    pub positions: &'a [DVec3],
    /// Vertex pairs of rim edges (edges where the surface folds back onto itself).
    pub rims: &'a [[u32; 2]],
    /// Vertex pairs of boundary edges.
    pub boundary: &'a [[u32; 2]],
    /// Vertices whose star is a figure-eight.
    pub pinch_points: &'a [u32],
}

impl Scenery<'_> {
    /// That every index has a position.
    pub(super) fn validate(&self) -> Result<(), RenderError> {
        let vertices = self.positions.len();
        let check = |list: &'static str, item: usize, corners: &[u32]| match corners
            .iter()
            .find(|&&vertex| vertex as usize >= vertices)
        {
            Some(&vertex) => Err(RenderError::MissingVertex { list, item, vertex, vertices }),
            None => Ok(()),
        };
        self.triangles.iter().enumerate().try_for_each(|(item, corners)| check("triangle", item, corners))?;
        self.rims.iter().enumerate().try_for_each(|(item, ends)| check("rim", item, ends))?;
        self.boundary.iter().enumerate().try_for_each(|(item, ends)| check("boundary edge", item, ends))?;
        self.pinch_points.iter().enumerate().try_for_each(|(item, &vertex)| check("pinch point", item, &[vertex]))
    }
}
