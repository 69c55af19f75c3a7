//! Edge lengths at a time, from the mesh, a file or a formula.

use super::{MetricError, lengths_of_positions};
use crate::mesh::{Surface, VertexId, read_edge_lengths, read_positions};
use crate::scene::{AtKey, LengthSource};
use crate::timeline::{Formula, Parameters, PointFormula};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// One length per edge, at all times the same or by a formula.
#[derive(Clone, Debug)]
pub(super) enum Lengths {
    Fixed(Vec<f64>),
    Positions { formula: PointFormula, places: Vec<DVec3>, edges: Vec<[VertexId; 2]> },
    Formula { formula: Formula, of_mesh: Vec<f64>, ends: Vec<[DVec3; 2]> },
}

impl Lengths {
    /// `key` is that of the table in the scene that names the source.
    pub fn from_scene(
        source: &LengthSource,
        key: &str,
        folder: &Path,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<Lengths, AtKey<MetricError>> {
        let Surface { mesh, positions, .. } = surface;
        let fixed = match source {
            LengthSource::OfMesh => lengths_of_surface(surface).map_err(AtKey::of(key))?,
            LengthSource::Uniform(length) => vec![*length; mesh.edge_count()],
            LengthSource::Csv(path) => {
                read_edge_lengths(&folder.join(path), mesh).map_err(AtKey::of(format!("{key}.csv")))?
            }
            LengthSource::File(path) => lengths_of_positions(
                mesh,
                &read_positions(&folder.join(path), mesh).map_err(AtKey::of(format!("{key}.file")))?,
            ),
            LengthSource::Positions(texts) => {
                let key = format!("{key}.positions");
                let formula = PointFormula::parse(texts, parameters).map_err(AtKey::of(&*key))?;
                let Some(places) = surface.places() else {
                    return Err(AtKey { key, error: MetricError::FormulaWithoutPositions });
                };
                let edges = mesh.edges().map(|e| mesh.edge_vertices(e)).collect();
                return Ok(Lengths::Positions { formula, places: places.to_vec(), edges });
            }
            LengthSource::Formula(text) => {
                let key = format!("{key}.formula");
                let formula = Formula::parse(text, &VARIABLES, parameters).map_err(AtKey::of(&*key))?;
                if positions.is_none() && (0..VARIABLES.len() - 1).any(|variable| formula.uses(variable)) {
                    return Err(AtKey { key, error: MetricError::FormulaWithoutPositions });
                }
                let of_mesh = lengths_of_surface(surface).map_err(AtKey::of(key))?;
                let place = |v: VertexId| positions.as_ref().map_or(DVec3::ZERO, |p| p[v.index()]);
                let ends = mesh.edges().map(|e| mesh.edge_vertices(e).map(place)).collect();
                return Ok(Lengths::Formula { formula, of_mesh, ends });
            }
        };
        Ok(Lengths::Fixed(fixed))
    }

    pub fn at(&self, time: f64) -> Vec<f64> {
        match self {
            Lengths::Fixed(lengths) => lengths.clone(),
            Lengths::Positions { formula, places, edges } => {
                let formula = formula.at(time);
                let moved: Vec<DVec3> = places.iter().map(|&p| formula.point(p)).collect();
                edges.iter().map(|[a, b]| moved[a.index()].distance(moved[b.index()])).collect()
            }
            Lengths::Formula { formula, of_mesh, ends } => {
                let formula = formula.at(time);
                let length = |([a, b], &length): (&[DVec3; 2], &f64)| {
                    let (p, d) = (0.5 * (*a + *b), *b - *a);
                    formula.value(&[p.x, p.y, p.z, d.x, d.y, d.z, length])
                };
                ends.iter().zip(of_mesh).map(length).collect()
            }
        }
    }

    pub fn changes(&self) -> bool {
        match self {
            Lengths::Fixed(_) => false,
            Lengths::Positions { formula, .. } => formula.changes(),
            Lengths::Formula { formula, .. } => formula.changes(),
        }
    }
}

/// Of the edge: its middle, the vector from end to end, and its length in the mesh.
const VARIABLES: [&str; 7] = ["x", "y", "z", "dx", "dy", "dz", "length"];

/// The lengths that the shape decrees, or those of its positions.
fn lengths_of_surface(surface: &Surface) -> Result<Vec<f64>, MetricError> {
    match (&surface.edge_lengths, &surface.positions) {
        (Some(lengths), _) => Ok(lengths.clone()),
        (None, Some(positions)) => Ok(lengths_of_positions(&surface.mesh, positions)),
        (None, None) => Err(MetricError::NoPositions),
    }
}
