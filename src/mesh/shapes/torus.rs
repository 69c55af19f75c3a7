//! Tori of revolution.

use std::f64::consts::TAU;

use glam::DVec3;

use super::error::ShapeFault;
use super::grid::{Rows, grid_faces};
use super::limits::{LEAST_COLUMNS, LEAST_TORUS_ROWS, at_least, face_count, invalid, positive};
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
        let remedy = "make the ring thinner, so that it does not meet itself";
        let fault = ShapeFault::NotBelow { value: minor_radius, other: "major_radius", bound: major_radius, remedy };
        return Err(invalid(SHAPE, "minor_radius", fault).into());
    }
    at_least(SHAPE, "columns", columns, LEAST_COLUMNS)?;
    at_least(SHAPE, "rows", rows, LEAST_TORUS_ROWS)?;
    face_count(SHAPE, "columns", 2.0 * columns as f64 * rows as f64, "lower `columns` or `rows`")?;
    if rows % 2 == 1 {
        let remedy = "give an even number, so that shifted rows close up";
        return Err(invalid(SHAPE, "rows", ShapeFault::Odd { count: rows, remedy }).into());
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
    Surface::from_positions(positions, &grid_faces(columns, rows, rows, layout))
}
