//! Edge lengths at a time: given ones, those of moved positions, or by a formula.

use super::{MetricError, lengths_of_positions};
use crate::mesh::{Surface, VertexId};
use crate::timeline::{Formula, PointFormula};
use glam::DVec3;

/// One length per edge, at all times the same or by a formula.
#[derive(Clone, Debug)]
pub struct Lengths(Source);

#[derive(Clone, Debug)]
enum Source {
    Fixed(Vec<f64>),
    Positions { formula: PointFormula, places: Vec<DVec3>, edges: Vec<[VertexId; 2]> },
    Formula { formula: Formula, of_mesh: Vec<f64>, ends: Vec<[DVec3; 2]> },
}

impl Lengths {
    /// Variables of a formula for the length of an edge: its middle, the vector from end to end, and its length in the
    /// mesh.
    pub const VARIABLES: [&str; 7] = ["x", "y", "z", "dx", "dy", "dz", "length"];

    /// The same at all times, |E|.
    pub fn fixed(lengths: Vec<f64>) -> Lengths {
        Lengths(Source::Fixed(lengths))
    }

    /// The lengths that a surface decrees, or those of its positions.
    ///
    /// # Errors
    /// [`MetricError::NoPositions`] if it has neither.
    pub fn of_surface(surface: &Surface) -> Result<Lengths, MetricError> {
        lengths_of_surface(surface).map(Lengths::fixed)
    }

    /// Those of a surface whose vertices are moved by a formula.
    ///
    /// # Errors
    /// [`MetricError::FormulaWithoutPositions`] if nothing is known of places.
    pub fn of_moved(surface: &Surface, formula: PointFormula) -> Result<Lengths, MetricError> {
        let places = surface.places().ok_or(MetricError::FormulaWithoutPositions)?.to_vec();
        let edges = surface.mesh.edges().map(|e| surface.mesh.edge_vertices(e)).collect();
        Ok(Lengths(Source::Positions { formula, places, edges }))
    }

    /// Those that a formula in [`Lengths::VARIABLES`] gives.
    ///
    /// # Errors
    /// [`MetricError::FormulaWithoutPositions`] if it uses coordinates and the surface has no positions,
    /// [`MetricError::NoPositions`] if the surface has no lengths of its own.
    pub fn by_formula(surface: &Surface, formula: Formula) -> Result<Lengths, MetricError> {
        let Surface { mesh, positions, .. } = surface;
        if positions.is_none() && (0..Lengths::VARIABLES.len() - 1).any(|variable| formula.uses(variable)) {
            return Err(MetricError::FormulaWithoutPositions);
        }
        let of_mesh = lengths_of_surface(surface)?;
        let place = |v: VertexId| positions.as_ref().map_or(DVec3::ZERO, |p| p[v.index()]);
        let ends = mesh.edges().map(|e| mesh.edge_vertices(e).map(place)).collect();
        Ok(Lengths(Source::Formula { formula, of_mesh, ends }))
    }

    /// The lengths at a time, |E|; not numbers where a formula has no value.
    pub fn at(&self, time: f64) -> Vec<f64> {
        match &self.0 {
            Source::Fixed(lengths) => lengths.clone(),
            Source::Positions { formula, places, edges } => {
                let formula = formula.at(time);
                let moved: Vec<DVec3> = places.iter().map(|&p| formula.point(p)).collect();
                edges.iter().map(|[a, b]| moved[a.index()].distance(moved[b.index()])).collect()
            }
            Source::Formula { formula, of_mesh, ends } => {
                let formula = formula.at(time);
                let length = |([a, b], &length): (&[DVec3; 2], &f64)| {
                    let (p, d) = (0.5 * (*a + *b), *b - *a);
                    formula.value(&[p.x, p.y, p.z, d.x, d.y, d.z, length])
                };
                ends.iter().zip(of_mesh).map(length).collect()
            }
        }
    }

    /// Whether they can depend on time.
    pub fn changes(&self) -> bool {
        match &self.0 {
            Source::Fixed(_) => false,
            Source::Positions { formula, .. } => formula.changes(),
            Source::Formula { formula, .. } => formula.changes(),
        }
    }
}

fn lengths_of_surface(surface: &Surface) -> Result<Vec<f64>, MetricError> {
    match (&surface.edge_lengths, &surface.positions) {
        (Some(lengths), _) => Ok(lengths.clone()),
        (None, Some(positions)) => Ok(lengths_of_positions(&surface.mesh, positions)),
        (None, None) => Err(MetricError::NoPositions),
    }
}
