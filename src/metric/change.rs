//! What a scene does to edge lengths: conformal factors and Ricci flow.

use super::MetricError;
use super::ricci_change::RicciChange;
use crate::mesh::{Mesh, Surface, VertexId};
use crate::scene::{AtKey, ChangeKind, MetricChangeSection};
use crate::timeline::{Formula, Number, Parameters};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// One `[[metric.change]]`.
#[derive(Clone, Debug)]
pub(super) struct Change {
    /// That of the scene, for messages.
    pub key: String,
    amount: Number,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Conformal { log_scale: Formula, places: Vec<DVec3> },
    Ricci(RicciChange),
}

impl Change {
    pub fn from_scene(
        section: &MetricChangeSection,
        key: String,
        folder: &Path,
        surface: &Surface,
        parameters: &Arc<Parameters>,
    ) -> Result<Change, AtKey<MetricError>> {
        let at = |name: &str| format!("{key}.{name}");
        let amount = Number::from_scene(&section.amount, parameters).map_err(AtKey::of(at("amount")))?;
        let places = surface.places();
        let kind = match &section.kind {
            ChangeKind::Conformal { log_scale } => {
                let log_scale =
                    Formula::parse(log_scale, &["x", "y", "z"], parameters).map_err(AtKey::of(at("log_scale")))?;
                if places.is_none() && (0..3).any(|variable| log_scale.uses(variable)) {
                    return Err(AtKey { key: at("log_scale"), error: MetricError::FormulaWithoutPositions });
                }
                let nowhere = || vec![DVec3::ZERO; surface.mesh.vertex_count()];
                Kind::Conformal { log_scale, places: places.map_or_else(nowhere, <[DVec3]>::to_vec) }
            }
            ChangeKind::Ricci(section) => Kind::Ricci(RicciChange::from_scene(section, &key, folder, surface)?),
        };
        Ok(Change { key, amount, kind })
    }

    pub fn changes(&self) -> bool {
        self.amount.changes() || matches!(&self.kind, Kind::Conformal { log_scale, .. } if log_scale.changes())
    }

    /// What is worth saying of what was found.
    pub fn note(&self) -> Option<String> {
        let Kind::Ricci(ricci) = &self.kind else { return None };
        ricci.is_by_initial_areas().then(|| {
            format!(
                "{}: no metric was found in which the curvature beside the given ones is in proportion to area (a sphere with \
                 a single cone has none), so that it is in proportion to the areas before the change",
                self.key
            )
        })
    }

    /// The lengths after the change, and for a flow how far curvatures are from their targets.
    pub fn apply(&mut self, mesh: &Mesh, lengths: Vec<f64>, time: f64) -> Result<(Vec<f64>, Option<f64>), MetricError> {
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
