//! Flat tori: the plane modulo a lattice.

use glam::DVec2;

use super::error::ShapeFault;
use super::grid::{Rows, grid_faces};
use super::limits::{LEAST_COLUMNS, LEAST_FLAT_TORUS_ROWS, at_least, face_count, finite, invalid};
use super::shape::Grid;
use crate::mesh::{Mesh, MeshError, Surface};

const SHAPE: &str = "flat_torus";

/// The parallelogram of `a` and `b` with opposite sides glued, as `columns * rows` vertices and twice as
/// many faces. It has edge lengths and no positions.
///
/// Vertex `j * columns + i` lies at `(i + s/2) / columns * a + j / rows * b`, where `s` is 1 in the odd
/// rows of an equilateral grid and 0 elsewhere. All edges are equal if `b` is perpendicular to `a` and
/// `|b| / rows` is `√3 / 2` of `|a| / columns`.
///
/// # Errors
/// [`MeshError::Shape`] for fewer than 3 columns or rows, an odd number of rows in an equilateral grid,
/// parallel or non-finite lattice vectors.
pub fn flat_torus(a: [f64; 2], b: [f64; 2], columns: usize, rows: usize, grid: Grid) -> Result<Surface, MeshError> {
    at_least(SHAPE, "columns", columns, LEAST_COLUMNS)?;
    at_least(SHAPE, "rows", rows, LEAST_FLAT_TORUS_ROWS)?;
    face_count(SHAPE, "columns", 2.0 * columns as f64 * rows as f64, "lower `columns` or `rows`")?;
    finite(SHAPE, "a", &a)?;
    finite(SHAPE, "b", &b)?;
    let (a, b) = (DVec2::from(a), DVec2::from(b));
    if a.perp_dot(b).abs() <= 1e-12 * a.length() * b.length() {
        return Err(invalid(SHAPE, "b", ShapeFault::Parallel).into());
    }
    let layout = match grid {
        Grid::Equilateral if rows % 2 == 1 => {
            let remedy = "give an even number, so that the shifted rows close up, or grid = \"square\"";
            return Err(invalid(SHAPE, "rows", ShapeFault::Odd { count: rows, remedy }).into());
        }
        Grid::Equilateral => Rows::Staggered,
        Grid::Square => Rows::Aligned,
    };
    let mesh = Mesh::from_faces(columns * rows, &grid_faces(columns, rows, rows, layout))?;
    let edge_lengths = mesh
        .edges()
        .map(|e| {
            let [u, v] = mesh.edge_vertices(e).map(|v| (v.index() % columns, v.index() / columns));
            // The shortest way around, in half columns and rows.
            let half = |(i, j): (usize, usize)| (2 * i + layout.half_columns(j)) as i64;
            let across = wrap(half(v) - half(u), 2 * columns as i64);
            let up = wrap(v.1 as i64 - u.1 as i64, rows as i64);
            (a * (0.5 * across as f64 / columns as f64) + b * (up as f64 / rows as f64)).length()
        })
        .collect();
    let place = |v: usize| {
        let (i, j) = (v % columns, v / columns);
        let across = (i as f64 + 0.5 * layout.half_columns(j) as f64) / columns as f64;
        (a * across + b * (j as f64 / rows as f64)).extend(0.0)
    };
    let coordinates = Some((0..columns * rows).map(place).collect());
    Ok(Surface { mesh, positions: None, coordinates, edge_lengths: Some(edge_lengths), repairs: Vec::new() })
}

/// The representative of least absolute value modulo `period`.
fn wrap(difference: i64, period: i64) -> i64 {
    (difference + period / 2).rem_euclid(period) - period / 2
}
