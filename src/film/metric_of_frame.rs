//! The metric that was asked for in a frame on disk.

use super::error::FilmError;
use crate::evolve::Frame;
use crate::mesh::Mesh;
use crate::metric::Metric;

/// Of a frame of a film of this surface.
///
/// # Errors
/// [`FilmError::Field`] if its lengths are those of no triangles.
pub(super) fn metric_of_frame(mesh: &Mesh, frame: &Frame) -> Result<Metric, FilmError> {
    Metric::new(mesh, frame.edge_lengths.clone()).map_err(FilmError::field)
}
