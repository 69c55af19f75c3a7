//! Changes of edge lengths: conformal factors and Ricci flow.

use super::MetricError;
use super::ricci_change::{RicciChange, RicciTarget};
use crate::mesh::{Mesh, Surface, VertexId};
use crate::timeline::{Formula, Number};
use glam::DVec3;

/// One change of all lengths, of which there may be more or less with time.
#[derive(Clone, Debug)]
pub struct Change {
    amount: Number,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Conformal { log_scale: Formula, places: Vec<DVec3> },
    Ricci(RicciChange),
}

impl Change {
    /// Lengths are multiplied by `exp((u + u')/2)`, the log scale factors of the ends: so much of a formula in x, y and z
    /// of the vertex.
    ///
    /// # Errors
    /// [`MetricError::FormulaWithoutPositions`] if it uses coordinates and nothing is known of places.
    pub fn conformal(surface: &Surface, log_scale: Formula, amount: Number) -> Result<Change, MetricError> {
        let places = surface.places();
        if places.is_none() && (0..3).any(|variable| log_scale.uses(variable)) {
            return Err(MetricError::FormulaWithoutPositions);
        }
        let nowhere = || vec![DVec3::ZERO; surface.mesh.vertex_count()];
        let places = places.map_or_else(nowhere, <[DVec3]>::to_vec);
        Ok(Change { amount, kind: Kind::Conformal { log_scale, places } })
    }

    /// Discrete Ricci flow: the amount a is the time −ln(1 − a), and 1 the limit.
    ///
    /// # Errors
    /// [`MetricError::TargetRegion`] if a region lies in several components.
    pub fn ricci(mesh: &Mesh, target: RicciTarget, amount: Number) -> Result<Change, MetricError> {
        Ok(Change { amount, kind: Kind::Ricci(RicciChange::new(mesh, target)?) })
    }

    /// Whether it can depend on time.
    pub fn changes(&self) -> bool {
        self.amount.changes() || matches!(&self.kind, Kind::Conformal { log_scale, .. } if log_scale.changes())
    }

    /// What is worth saying of what was found.
    pub(super) fn note(&self) -> Option<&'static str> {
        let Kind::Ricci(ricci) = &self.kind else { return None };
        ricci.is_by_initial_areas().then_some(
            "no metric was found in which the curvature beside the given ones is in proportion to area (a sphere with a single \
             cone has none), so that it is in proportion to the areas before the change",
        )
    }

    /// The lengths after the change, and for a flow how far curvatures are from their targets.
    pub(super) fn apply(
        &mut self,
        mesh: &Mesh,
        lengths: Vec<f64>,
        time: f64,
    ) -> Result<(Vec<f64>, Option<f64>), MetricError> {
        let amount = self.amount.at(time);
        match &mut self.kind {
            Kind::Conformal { log_scale, places } => {
                let formula = log_scale.at(time);
                let u: Vec<f64> = places.iter().map(|p| amount * formula.value(&p.to_array())).collect();
                if let Some(vertex) = u.iter().position(|u| !u.is_finite()) {
                    let number = mesh.file_vertex(VertexId::new(vertex));
                    return Err(MetricError::LogScale { vertex: number, value: u[vertex] });
                }
                let scale = |e: crate::mesh::EdgeId| {
                    let [a, b] = mesh.edge_vertices(e).map(|v| u[v.index()]);
                    lengths[e.index()] * libm::exp(0.5 * (a + b))
                };
                Ok((mesh.edges().map(scale).collect(), None))
            }
            Kind::Ricci(ricci) => {
                let (lengths, error) = ricci.apply(lengths, amount)?;
                Ok((lengths, Some(error)))
            }
        }
    }
}
