//! What parameters of shapes may be.

use crate::mesh::MeshError;

/// The largest number of faces a generated shape may have.
const FACE_LIMIT: f64 = 20e6;

pub(super) fn invalid(shape: &str, reason: impl Into<String>, remedy: impl Into<String>) -> MeshError {
    MeshError::Shape { shape: shape.into(), reason: reason.into(), remedy: remedy.into() }
}

pub(super) fn positive(shape: &str, name: &str, value: f64) -> Result<(), MeshError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(invalid(shape, format!("`{name}` is {value}"), "give a finite number above 0"))
}

pub(super) fn finite(shape: &str, name: &str, values: &[f64]) -> Result<(), MeshError> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(value) => Err(invalid(shape, format!("`{name}` contains {value}"), "give finite numbers")),
    }
}

pub(super) fn at_least(shape: &str, name: &str, value: usize, least: usize) -> Result<(), MeshError> {
    if value >= least {
        return Ok(());
    }
    Err(invalid(shape, format!("`{name}` is {value}"), format!("give at least {least}")))
}

/// Takes a product of floats, which cannot overflow.
pub(super) fn face_count(shape: &str, faces: f64, remedy: &str) -> Result<(), MeshError> {
    if faces <= FACE_LIMIT {
        return Ok(());
    }
    Err(invalid(shape, format!("it would have {faces:.0} faces, {FACE_LIMIT:.0} are the limit"), remedy))
}
