//! Halfway models of eversions: surfaces that a motion takes to themselves, in the middle of a way that turns them inside out.

mod figure_eight;
mod lobes;

pub use figure_eight::FigureEight;
pub use lobes::Halfway;

use super::limits::{LEAST_LOBES, at_least};
use super::octasphere::octasphere;
use crate::mesh::{MeshError, Surface};

/// The halfway model of a sphere eversion with so many `lobes`, as an octasphere with twice as many sides is mapped to it: 2 is Morin's surface, 3
/// Boy's surface, twice covered. The edges of the octasphere are divided into `subdivisions` parts: `4 lobes subdivisions²` faces.
///
/// # Errors
/// [`MeshError::Shape`] for fewer than 2 lobes, or no subdivisions.
pub fn halfway(lobes: usize, subdivisions: usize) -> Result<Surface, MeshError> {
    at_least("halfway", "lobes", lobes, LEAST_LOBES)?;
    let surface = octasphere(1.0, subdivisions, 2 * lobes)?;
    let positions = surface.positions.map(|sphere| Halfway { lobes, time: 0.0 }.of_sphere(&sphere));
    Ok(Surface { positions, ..surface })
}
