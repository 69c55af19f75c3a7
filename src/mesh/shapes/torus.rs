//! Tori of revolution.

use std::f64::consts::TAU;

use glam::DVec3;

use super::embedded;
use super::grid::{Rows, grid_faces};
use super::limits::{at_least, face_count, invalid, positive};
use crate::mesh::{MeshError, Surface};

const SHAPE: &str = "torus";

/// A circle of `minor_radius` turned around the z axis at distance `major_radius`: `columns` vertices
/// along the turn, `rows` along the circle, every second row shifted by half a column.
///
/// # Errors
/// [`MeshError::Shape`] for fewer than 3 columns or 4 rows, an odd number of rows, radii that are not
/// positive or let the surface meet itself.
pub fn torus(major_radius: f64, minor_radius: f64, columns: usize, rows: usize) -> Result<Surface, MeshError> {
    positive(SHAPE, "major_radius", major_radius)?;
    positive(SHAPE, "minor_radius", minor_radius)?;
    if minor_radius >= major_radius {
        let reason = format!("`minor_radius` {minor_radius} is not below `major_radius` {major_radius}");
        return Err(invalid(SHAPE, reason, "the ring would meet itself; make it thinner"));
    }
    at_least(SHAPE, "columns", columns, 3)?;
    at_least(SHAPE, "rows", rows, 4)?;
    face_count(SHAPE, 2.0 * columns as f64 * rows as f64, "lower `columns` or `rows`")?;
    if rows % 2 == 1 {
        return Err(invalid(SHAPE, format!("`rows` is {rows}"), "give an even number, so that shifted rows close up"));
    }
    let layout = Rows::Staggered;
    let mut positions = Vec::with_capacity(columns * rows);
    for j in 0..rows {
        let (sin_minor, cos_minor) = libm::sincos(TAU * j as f64 / rows as f64);
        for i in 0..columns {
            let (sin, cos) = libm::sincos(TAU * layout.column(i, j) / columns as f64);
            let distance = major_radius + minor_radius * cos_minor;
            positions.push(DVec3::new(distance * cos, distance * sin, minor_radius * sin_minor));
        }
    }
    embedded(positions, &grid_faces(columns, rows, rows, layout))
}
