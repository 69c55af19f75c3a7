//! What a scene does to edge lengths: conformal factors and Ricci flow.

use super::{BoundaryCondition, CurvatureTarget, InteriorCurvature, Metric, MetricError, Region, RicciFlow};
use crate::mesh::{Mesh, Surface, VertexId, read_vertex_numbers, select_vertices};
use crate::scene::{AtKey, ChangeKind, MetricChangeSection, RicciSection};
use crate::timeline::{Formula, Number, Parameters};
use glam::DVec3;
use std::collections::HashSet;
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
    Ricci { target: Target, flow: Option<Box<Flow>> },
}

/// A flow and the lengths it starts from.
#[derive(Clone, Debug)]
struct Flow {
    start: Vec<f64>,
    flow: RicciFlow,
}

/// What the flow tends to, with regions as vertices.
#[derive(Clone, Debug)]
struct Target {
    section: RicciSection,
    regions: Vec<Region>,
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
            ChangeKind::Ricci(section) => {
                let mut regions = Vec::new();
                for (k, region) in section.regions.iter().enumerate() {
                    let mut vertices = select_vertices(&region.vertices, &surface.mesh, places)
                        .map_err(AtKey::of(at(&format!("region[{k}]"))))?;
                    // A welded vertex may be named by each of its numbers.
                    let mut named = HashSet::new();
                    vertices.retain(|v| named.insert(*v));
                    regions.push(Region { vertices, curvature: region.total.to_radians() });
                }
                if let Some(path) = &section.csv {
                    let numbers =
                        read_vertex_numbers(&folder.join(path), &surface.mesh).map_err(AtKey::of(at("csv")))?;
                    let region = |(v, degrees): (_, f64)| Region { vertices: vec![v], curvature: degrees.to_radians() };
                    regions.extend(numbers.into_iter().map(region));
                }
                Kind::Ricci { target: Target { section: section.clone(), regions }, flow: None }
            }
        };
        Ok(Change { key, amount, kind })
    }

    pub fn changes(&self) -> bool {
        self.amount.changes() || matches!(&self.kind, Kind::Conformal { log_scale, .. } if log_scale.changes())
    }

    /// What is worth saying of what was found.
    pub fn note(&self) -> Option<String> {
        let Kind::Ricci { flow: Some(flow), .. } = &self.kind else { return None };
        flow.flow.limit().by_initial_areas.then(|| {
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
            Kind::Ricci { target, flow } => {
                let mut started = match flow.take() {
                    Some(flow) if flow.start == lengths => flow,
                    _ => Box::new(Flow {
                        flow: target
                            .of(mesh, &lengths)
                            .and_then(|goal| RicciFlow::new(mesh, &lengths, &goal))
                            .map_err(|error| target.by_vertex(error, mesh))?,
                        start: lengths,
                    }),
                };
                let Flow { start, flow: ricci } = &mut *started;
                let lengths = match amount {
                    a if a <= 0.0 => start.clone(),
                    a if a >= 1.0 => ricci.limit().edge_lengths.clone(),
                    a if a.is_nan() => return Err(MetricError::FlowTime { time: a }),
                    a => ricci.advance_to(-libm::log1p(-a)).map_err(|error| error.of_flow(mesh))?,
                };
                let error = ricci.curvature_error(mesh, &lengths)?;
                *flow = Some(started);
                Ok((lengths, Some(error)))
            }
        }
    }
}

impl Target {
    /// Regions of single vertices, from a file, have no number of their own.
    fn by_vertex(&self, error: MetricError, mesh: &Mesh) -> MetricError {
        match error {
            MetricError::TargetRegion { region, reason } if region >= self.section.regions.len() => {
                let vertex = self.regions[region].vertices.first().map_or(0, |&v| mesh.file_vertex(v));
                MetricError::TargetCone { vertex, reason }
            }
            other => other,
        }
    }

    /// The target for the metric that the flow starts from.
    fn of(&self, mesh: &Mesh, lengths: &[f64]) -> Result<CurvatureTarget, MetricError> {
        let metric = Metric::new(mesh, lengths.to_vec())?;
        let boundary = match self.section.turning {
            None => BoundaryCondition::Isometric,
            Some(degrees) => BoundaryCondition::TurningAngles(turning_angles(mesh, &metric, degrees.to_radians())),
        };
        let interior = match self.section.curvature {
            Some(density) => InteriorCurvature::Density(density),
            None if self.regions.is_empty() => InteriorCurvature::Constant,
            None => InteriorCurvature::PerRegion(self.regions.clone()),
        };
        Ok(CurvatureTarget { interior, boundary, keep_area: !self.section.free_area })
    }
}

/// The same total for every boundary loop, spread in proportion to length.
fn turning_angles(mesh: &Mesh, metric: &Metric, total: f64) -> Vec<f64> {
    let mut angles = vec![0.0; mesh.vertex_count()];
    for cycle in mesh.boundary_loops() {
        let length = |h: crate::mesh::HalfedgeId| metric.length(mesh.edge(h));
        let around: f64 = cycle.iter().map(|&h| length(h)).sum();
        for &h in &cycle {
            let half = 0.5 * total * length(h) / around;
            angles[mesh.tail(h).index()] += half;
            angles[mesh.tip(h).index()] += half;
        }
    }
    angles
}
