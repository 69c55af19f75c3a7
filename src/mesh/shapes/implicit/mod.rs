//! Surfaces of solids: isosurface, then isotropic remeshing.

mod isosurface;
mod remesh;
mod solid;

use glam::DVec3;

use isosurface::{CubeGrid, isosurface};
use remesh::Remesher;
use solid::Field;

use super::error::ShapeFault;
use super::limits::{face_count, invalid, positive};
use super::shape::Solid;
use crate::mesh::{MeshError, Surface, repair};

const SHAPE: &str = "implicit";
/// Grid spacing in units of the edge length; finer than the result, so that remeshing has a choice.
const GRID_SPACING: f64 = 0.75;
const CELL_LIMIT: f64 = 30e6;
/// Cells of the grid, and triangles of the first surface, times solids: some seconds' work for each. A triangle is taken
/// up again and again until its edges are as long as they should be.
const MOST_EVALUATIONS: [f64; 2] = [3e8, 5e6];

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
        let fault = ShapeFault::TooManyCells { edge_length, cells: count, limit: CELL_LIMIT };
        return Err(invalid(SHAPE, "edge_length", fault).into());
    }
    let solids = field.solids();
    let is_too_much = |count: f64, most: f64| {
        let fault = ShapeFault::TooManySolids { edge_length, solids, evaluations: count * solids as f64, limit: most };
        if count * solids as f64 > most { Err(invalid(SHAPE, "edge_length", fault)) } else { Ok(()) }
    };
    is_too_much(count, MOST_EVALUATIONS[0])?;
    let grid = CubeGrid { low: low - margin, spacing, cells: cells.to_array().map(|n| n as usize) };
    let (positions, triangles) = isosurface(&grid, |p| field.at(p));
    if triangles.is_empty() {
        return Err(invalid(SHAPE, "edge_length", ShapeFault::NoSurface { edge_length }).into());
    }
    is_too_much(triangles.len() as f64, MOST_EVALUATIONS[1])?;
    face_count(SHAPE, "edge_length", triangles.len() as f64, "raise `edge_length`")?;
    let (positions, triangles) = Remesher::new(|p| field.at(p), edge_length, positions, &triangles).run();
    // Compacts; the triangles are oriented already.
    let kept = repair(positions.len(), &triangles)?;
    Surface::from_positions(kept.input_vertices.iter().map(|&v| positions[v]).collect(), &kept.mesh.triangles())
}
