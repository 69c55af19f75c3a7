//! Surfaces of solids: isosurface, then isotropic remeshing.

use glam::DVec3;

use super::embedded;
use super::isosurface::{Grid, isosurface};
use super::limits::{face_count, invalid, positive};
use super::remesh::Remesher;
use super::solid::Field;
use crate::mesh::{MeshError, Surface, repair};
use crate::scene::Solid;

const SHAPE: &str = "implicit";
/// Grid spacing in units of the edge length; finer than the result, so that remeshing has a choice.
const GRID_SPACING: f64 = 0.75;
const CELL_LIMIT: f64 = 30e6;

/// The boundary of a solid as a closed surface with edges of about `edge_length`, all vertices on it.
///
/// Parts thinner than `edge_length` may be lost. The operation and the blend of the outermost solid do
/// not matter, there being nothing before it.
///
/// # Errors
/// [`MeshError::Shape`] for sizes that are not positive, an empty group, a solid of which nothing is left
/// or that is too small or far too large for `edge_length`.
pub fn implicit(solid: &Solid, edge_length: f64) -> Result<Surface, MeshError> {
    positive(SHAPE, "edge_length", edge_length)?;
    let field = Field::new(&solid.body)?;
    let [low, high] = field.bounds();
    let spacing = GRID_SPACING * edge_length;
    // Off the round numbers that scenes are made of, where values would be exactly zero.
    let margin = DVec3::new(2.13, 2.29, 2.41) * spacing;
    let cells = ((high - low + 2.0 * margin) / spacing).ceil();
    let count = cells.x * cells.y * cells.z;
    if count > CELL_LIMIT || count.is_nan() {
        let reason = format!("edges of {edge_length} need a grid of {count:.3e} cells, {CELL_LIMIT:.0e} are the limit");
        return Err(invalid(SHAPE, reason, "raise `edge_length` or make the solid smaller"));
    }
    let grid = Grid { low: low - margin, spacing, cells: cells.to_array().map(|n| n as usize) };
    let (positions, triangles) = isosurface(&grid, |p| field.at(p));
    if triangles.is_empty() {
        return Err(invalid(
            SHAPE,
            format!("no surface was found at edge length {edge_length}"),
            "lower `edge_length`, or make sure that something is left of the solid",
        ));
    }
    face_count(SHAPE, triangles.len() as f64, "raise `edge_length`")?;
    let (positions, triangles) = Remesher::new(|p| field.at(p), edge_length, positions, &triangles).run();
    // Compacts; the triangles are oriented already.
    let kept = repair(positions.len(), &triangles)?;
    embedded(kept.input_vertices.iter().map(|&v| positions[v]).collect(), &kept.mesh.triangles())
}
