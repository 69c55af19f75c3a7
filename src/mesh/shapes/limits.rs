//! What parameters of shapes may be.

use super::error::{ShapeError, ShapeFault};

/// The largest number of faces that a generated shape may have. It keeps a mistyped number from asking for more memory
/// than there is: to be set up for a simulation a face takes 2.3 kB, so that these take 9 GB.
pub const MOST_FACES: usize = 4_000_000;
/// The least number of vertices around a shape, on a circle or along a lattice vector.
pub const LEAST_COLUMNS: usize = 3;
/// The least number of meridians of a sphere.
pub const LEAST_MERIDIANS: usize = 3;
/// The least number of parallels between the poles of a sphere.
pub const LEAST_PARALLELS: usize = 1;
/// The least number of rows of a flat torus.
pub const LEAST_FLAT_TORUS_ROWS: usize = 3;
/// The least number of rows of a torus of revolution, whose rows are even in number.
pub const LEAST_TORUS_ROWS: usize = 4;
/// The least number of rows of a surface that does not close up: cylinder or annulus.
pub const LEAST_ROWS: usize = 1;
/// The least number of rings of a disk.
pub const LEAST_RINGS: usize = 1;
/// The least number of sides of a polygon.
pub const LEAST_SIDES: usize = 3;
/// The least number of lobes of a halfway model.
pub const LEAST_LOBES: usize = 2;
/// With more lobes triangles of any mesh get too thin.
pub const MOST_LOBES: usize = 12;
/// The least number of parts that an edge is divided into.
pub const LEAST_SUBDIVISIONS: usize = 1;
/// The least number of faces of a hyperbolic disk: one hexagon.
pub const LEAST_DISK_FACES: usize = 6;

pub(super) fn invalid(shape: &'static str, parameter: impl Into<String>, fault: ShapeFault) -> ShapeError {
    ShapeError { shape, parameter: parameter.into(), fault }
}

pub(super) fn positive(shape: &'static str, parameter: &str, value: f64) -> Result<(), ShapeError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(invalid(shape, parameter, ShapeFault::NotPositive(value)))
}

pub(super) fn finite(shape: &'static str, parameter: &str, values: &[f64]) -> Result<(), ShapeError> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(&value) => Err(invalid(shape, parameter, ShapeFault::NotFinite(value))),
    }
}

pub(super) fn at_least(shape: &'static str, parameter: &str, count: usize, least: usize) -> Result<(), ShapeError> {
    if count >= least {
        return Ok(());
    }
    Err(invalid(shape, parameter, ShapeFault::TooFew { count, least }))
}

/// Takes a product of floats, which cannot overflow. `parameter` is the first one of those that `remedy` names.
pub(super) fn face_count(
    shape: &'static str,
    parameter: &str,
    faces: f64,
    remedy: &'static str,
) -> Result<(), ShapeError> {
    if faces <= MOST_FACES as f64 {
        return Ok(());
    }
    Err(invalid(shape, parameter, ShapeFault::TooManyFaces { faces, limit: MOST_FACES, remedy }))
}
