//! The `[metric]` of a scene.

use super::{Metric, MetricError, lengths_of_positions};
use crate::mesh::{Surface, read_edge_lengths};
use crate::scene::MetricSection;
use exmex::{Express, FlatEx};
use std::path::Path;

/// The metric that the scene gives to a surface; `folder` is where relative paths start.
///
/// # Errors
/// [`MetricError`] if lengths are missing or are no metric.
pub fn from_scene(section: &MetricSection, folder: &Path, surface: &Surface) -> Result<Metric, MetricError> {
    let lengths = match section {
        MetricSection::OfMesh => lengths_of_surface(surface)?,
        MetricSection::Uniform(length) => vec![*length; surface.mesh.edge_count()],
        MetricSection::Csv(path) => read_edge_lengths(&folder.join(path), &surface.mesh)?,
        MetricSection::Formula(formula) => lengths_by_formula(formula, surface)?,
    };
    Metric::new(&surface.mesh, lengths)
}

/// The lengths that the shape decrees, or those of its positions.
fn lengths_of_surface(surface: &Surface) -> Result<Vec<f64>, MetricError> {
    match (&surface.edge_lengths, &surface.positions) {
        (Some(lengths), _) => Ok(lengths.clone()),
        (None, Some(positions)) => Ok(lengths_of_positions(&surface.mesh, positions)),
        (None, None) => Err(MetricError::NoPositions),
    }
}

/// Evaluates an expression in x, y, z of the middle of each edge and its `length`.
fn lengths_by_formula(formula: &str, surface: &Surface) -> Result<Vec<f64>, MetricError> {
    let fail = |reason: String| MetricError::Formula { formula: formula.to_owned(), reason };
    let expression = FlatEx::<f64>::parse(formula).map_err(|error| fail(error.to_string()))?;
    let names = expression.var_names().to_vec();
    if let Some(name) = names.iter().find(|name| !["x", "y", "z", "length"].contains(&name.as_str())) {
        return Err(fail(format!("there is no `{name}`")));
    }
    let lengths = lengths_of_surface(surface)?;
    if surface.positions.is_none() && names.iter().any(|name| name != "length") {
        return Err(fail("the mesh has no positions, so x, y and z are unknown".to_owned()));
    }
    let mesh = &surface.mesh;
    mesh.edges()
        .map(|e| {
            let middle = surface.positions.as_ref().map_or(glam::DVec3::ZERO, |positions| {
                let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
                0.5 * (a + b)
            });
            let values: Vec<f64> = names
                .iter()
                .map(|name| match name.as_str() {
                    "x" => middle.x,
                    "y" => middle.y,
                    "z" => middle.z,
                    _ => lengths[e.index()],
                })
                .collect();
            expression.eval(&values).map_err(|error| fail(error.to_string()))
        })
        .collect()
}
