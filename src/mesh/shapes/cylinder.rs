//! Cylinders and annuli: rows of vertices on circles, every second row shifted by half a column.

use std::f64::consts::TAU;

use glam::DVec3;

use super::error::ShapeFault;
use super::grid::{Rows, grid_faces};
use super::limits::{LEAST_COLUMNS, LEAST_ROWS, at_least, face_count, invalid, positive};
use crate::mesh::{MeshError, Surface};

/// A cylinder around the z axis without lids, from `-height / 2` to `height / 2`, with `columns` vertices
/// around and `rows` rows of faces.
///
/// # Errors
/// [`MeshError::Shape`] for sizes that are not positive, fewer than 3 columns or no rows.
pub fn cylinder(radius: f64, height: f64, columns: usize, rows: usize) -> Result<Surface, MeshError> {
    positive("cylinder", "radius", radius)?;
    positive("cylinder", "height", height)?;
    circles("cylinder", columns, rows, |up| (radius, height * (up - 0.5)))
}

/// The flat ring between two circles in the xy plane, with `columns` vertices around and `rows` rows of
/// faces.
///
/// # Errors
/// [`MeshError::Shape`] for radii that are not positive and increasing, fewer than 3 columns or no rows.
pub fn annulus(inner_radius: f64, outer_radius: f64, columns: usize, rows: usize) -> Result<Surface, MeshError> {
    positive("annulus", "inner_radius", inner_radius)?;
    positive("annulus", "outer_radius", outer_radius)?;
    if inner_radius >= outer_radius {
        let remedy = "make the hole smaller";
        let fault = ShapeFault::NotBelow { value: inner_radius, other: "outer_radius", bound: outer_radius, remedy };
        return Err(invalid("annulus", "inner_radius", fault).into());
    }
    // From the outside in, so that the normal is +z.
    circles("annulus", columns, rows, |up| (outer_radius + up * (inner_radius - outer_radius), 0.0))
}

/// Rows on circles given by (radius, height) as a function of the share of rows below.
fn circles(
    shape: &'static str,
    columns: usize,
    rows: usize,
    circle: impl Fn(f64) -> (f64, f64),
) -> Result<Surface, MeshError> {
    at_least(shape, "columns", columns, LEAST_COLUMNS)?;
    at_least(shape, "rows", rows, LEAST_ROWS)?;
    face_count(shape, "columns", 2.0 * columns as f64 * rows as f64, "lower `columns` or `rows`")?;
    let layout = Rows::Staggered;
    let mut positions = Vec::with_capacity(columns * (rows + 1));
    for j in 0..=rows {
        let (radius, z) = circle(j as f64 / rows as f64);
        for i in 0..columns {
            let (sin, cos) = libm::sincos(TAU * layout.column(i, j) / columns as f64);
            positions.push(DVec3::new(radius * cos, radius * sin, z));
        }
    }
    Surface::from_positions(positions, &grid_faces(columns, rows, rows + 1, layout))
}
