//! Ricci flow as a change of lengths. Every component flows on its own, to a curvature and at an area of its own.

use super::{BoundaryCondition, CurvatureTarget, InteriorCurvature, Metric, MetricError, Region, RicciFlow};
use crate::mesh::{Component, Mesh, VertexId};
use std::collections::HashSet;
use std::sync::Arc;

/// What a Ricci flow tends to, the same for every component.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct RicciTarget {
    /// Gaussian curvature inside; left out, the constant that Gauss–Bonnet leaves.
    pub curvature: Option<f64>,
    /// Regions with a total curvature of their own, in place of `curvature`.
    pub regions: Vec<Region>,
    /// Single vertices with a curvature of their own in radians, as if each were a region.
    pub cones: Vec<(VertexId, f64)>,
    /// Total turning angle of every boundary loop in radians, spread in proportion to length; left out, the boundary
    /// keeps its lengths.
    pub turning: Option<f64>,
    /// Whether lengths may change as a whole.
    pub free_area: bool,
}

#[derive(Clone, Debug)]
pub(super) struct RicciChange {
    target: RicciTarget,
    parts: Vec<Part>,
}

/// The flow of a component.
#[derive(Clone, Debug)]
struct Part {
    component: Component,
    /// The regions that lie in it, with its own numbers of vertices.
    regions: Vec<Region>,
    /// Per region: which one of the target it is; cones come after all of them.
    region_numbers: Vec<usize>,
    flow: Option<Box<Flow>>,
}

/// A flow and the lengths it starts from.
#[derive(Clone, Debug)]
struct Flow {
    start: Vec<f64>,
    flow: RicciFlow,
}

impl RicciChange {
    /// # Errors
    /// [`MetricError::TargetRegion`] if a region lies in several components.
    pub fn new(mesh: &Mesh, target: RicciTarget) -> Result<RicciChange, MetricError> {
        let part = |component| Part { component, regions: Vec::new(), region_numbers: Vec::new(), flow: None };
        let mut parts: Vec<Part> = Component::all_of(&Arc::new(mesh.clone())).into_iter().map(part).collect();
        for (number, region) in target.regions.iter().enumerate() {
            let mut region = region.clone();
            // A welded vertex may be named by each of its numbers.
            let mut named = HashSet::new();
            region.vertices.retain(|v| named.insert(*v));
            give(&mut parts, &region, number)?;
        }
        for &(v, curvature) in &target.cones {
            give(&mut parts, &Region { vertices: vec![v], curvature }, target.regions.len())?;
        }
        Ok(RicciChange { target, parts })
    }

    /// Whether the curvature that was left over had to be spread by the areas before the change.
    pub fn is_by_initial_areas(&self) -> bool {
        self.parts.iter().flat_map(|part| &part.flow).any(|flow| flow.flow.limit().by_initial_areas)
    }

    /// The lengths after the flow, by the amount 1 − exp(−time), and how far curvatures are from their targets.
    pub fn apply(&mut self, mut lengths: Vec<f64>, amount: f64) -> Result<(Vec<f64>, f64), MetricError> {
        let mut largest: f64 = 0.0;
        for part in &mut self.parts {
            let (own, error) = part.apply(&self.target, part.component.edges.pick(&lengths), amount)?;
            part.component.edges.put(&own, &mut lengths);
            largest = largest.max(error);
        }
        Ok((lengths, largest))
    }
}

/// Gives a region to the component that it lies in; `number` is its number in the target.
fn give(parts: &mut [Part], region: &Region, number: usize) -> Result<(), MetricError> {
    let Some(first) = region.vertices.first() else { return Ok(()) };
    let Some(part) = parts.iter_mut().find(|part| part.component.vertices.here(first.index()).is_some()) else {
        return Ok(());
    };
    let here = |v: &VertexId| part.component.vertices.here(v.index()).map(VertexId::new);
    let Some(vertices) = region.vertices.iter().map(here).collect::<Option<Vec<VertexId>>>() else {
        let reason = "it lies in several components, and nothing says how they share its curvature".to_owned();
        return Err(MetricError::TargetRegion { region: number, reason });
    };
    part.regions.push(Region { vertices, curvature: region.curvature });
    part.region_numbers.push(number);
    Ok(())
}

impl Part {
    fn apply(&mut self, target: &RicciTarget, lengths: Vec<f64>, amount: f64) -> Result<(Vec<f64>, f64), MetricError> {
        let mesh = self.component.mesh.clone();
        let mut started = match self.flow.take() {
            Some(flow) if flow.start == lengths => flow,
            _ => Box::new(Flow {
                flow: self
                    .goal(target, &lengths)
                    .and_then(|goal| RicciFlow::new(&mesh, &lengths, &goal))
                    .map_err(|error| self.as_asked(target, error))?,
                start: lengths,
            }),
        };
        let Flow { start, flow: ricci } = &mut *started;
        let lengths = match amount {
            a if a <= 0.0 => start.clone(),
            a if a >= 1.0 => ricci.limit().edge_lengths.clone(),
            a if a.is_nan() => return Err(MetricError::FlowTime { time: a }),
            a => ricci.advance_to(-libm::log1p(-a)).map_err(|error| error.of_flow(&mesh))?,
        };
        let error = ricci.curvature_error(&mesh, &lengths)?;
        self.flow = Some(started);
        Ok((lengths, error))
    }

    /// An error that names a region by its number in the target, and a cone by its vertex.
    fn as_asked(&self, target: &RicciTarget, error: MetricError) -> MetricError {
        match error {
            MetricError::TargetRegion { region, reason } => match self.region_numbers[region] {
                number if number < target.regions.len() => MetricError::TargetRegion { region: number, reason },
                _ => {
                    let vertex = self.regions[region].vertices.first();
                    let vertex = vertex.map_or(0, |&v| self.component.mesh.file_vertex(v));
                    MetricError::TargetCone { vertex, reason }
                }
            },
            other => other,
        }
    }

    /// The target for the metric that the flow starts from.
    fn goal(&self, target: &RicciTarget, lengths: &[f64]) -> Result<CurvatureTarget, MetricError> {
        let mesh = &*self.component.mesh;
        let metric = Metric::new(mesh, lengths.to_vec())?;
        let boundary = match target.turning {
            None => BoundaryCondition::Isometric,
            Some(total) => BoundaryCondition::TurningAngles(turning_angles(mesh, &metric, total)),
        };
        let interior = match target.curvature {
            Some(density) => InteriorCurvature::Density(density),
            None if self.regions.is_empty() => InteriorCurvature::Constant,
            None => InteriorCurvature::PerRegion(self.regions.clone()),
        };
        Ok(CurvatureTarget { interior, boundary, keep_area: !target.free_area })
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
