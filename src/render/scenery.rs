//! What is to be seen.

use glam::DVec3;

use super::{Field, Plane, RenderError};
use crate::immersion::FieldValues;

/// How many triangles, and how many lines, one picture takes. The samples of a tile have ids for that many of each.
pub(super) const MOST_PRIMITIVES: usize = 0x7FFF_FFFE;

/// What is to be seen: a triangulated surface, curves and fields on it, as plain borrowed data.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scenery<'a> {
    /// Corners of each triangle, counterclockwise seen from the front.
    pub triangles: &'a [[u32; 3]],
    /// One position per vertex.
    pub positions: &'a [DVec3],
    /// Positions in the next frame, for motion vectors; empty if nothing moves.
    pub next_positions: &'a [DVec3],
    /// Whether a triangle is shown, one each; empty if all are.
    pub shown: &'a [bool],
    /// Vertex pairs of rim edges (edges where the surface folds back onto itself).
    pub rims: &'a [[u32; 2]],
    /// Vertex pairs of boundary edges.
    pub boundary: &'a [[u32; 2]],
    /// Vertices whose star is a figure-eight.
    pub pinch_points: &'a [u32],
    /// Vertices that are held.
    pub pins: &'a [u32],
    /// The ground, for its shadow; the normal points up.
    pub ground: Option<Plane>,
    /// Shown as colour, by the look's [`Paint::Map`](super::Paint).
    pub color: Option<&'a Field>,
    /// What the pattern of the look runs along, and across for patterns of two directions.
    pub along: [Option<&'a Field>; 2],
    /// Recorded as layers of the picture.
    pub fields: &'a [Field],
}

impl Scenery<'_> {
    /// That every index has a position, and every list its length.
    pub(super) fn validate(&self) -> Result<(), RenderError> {
        let vertices = self.positions.len();
        // Before anything counts them in 32 bits.
        if self.triangles.len() > MOST_PRIMITIVES {
            return Err(RenderError::TooManyPrimitives { count: self.triangles.len(), limit: MOST_PRIMITIVES });
        }
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
        self.pinch_points.iter().enumerate().try_for_each(|(item, &vertex)| check("pinch point", item, &[vertex]))?;
        self.pins.iter().enumerate().try_for_each(|(item, &vertex)| check("pin", item, &[vertex]))?;
        let lists = [
            ("next positions", self.next_positions.len(), vertices),
            ("shown", self.shown.len(), self.triangles.len()),
        ];
        for (list, found, wanted) in lists {
            if found != 0 && found != wanted {
                return Err(RenderError::Length { list: list.into(), found, wanted });
            }
        }
        let fields = self.fields.iter().chain(self.color).chain(self.along.iter().copied().flatten());
        for field in fields {
            let wanted = match &field.values {
                FieldValues::PerFace(_) => self.triangles.len(),
                FieldValues::PerVertex(_) => vertices,
            };
            if field.len() != wanted {
                return Err(RenderError::Length { list: field.name.clone(), found: field.len(), wanted });
            }
        }
        Ok(())
    }
}
