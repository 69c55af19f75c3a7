//! What is asked of the surface over time: its metric, its target bending angles, the places of its pins.

use super::EvolveError;
use crate::immersion::{BendingError, PinError, Pins, TargetBending};
use crate::mesh::{Component, Mesh, VertexId};
use crate::metric::{Metric, MetricAt, MetricError, MetricProgram};
use crate::scene::AtKey;
use glam::DVec3;
use std::sync::Arc;

/// The same for all components; each asks for its own share, at times of its own.
#[derive(Debug)]
pub(super) struct Course {
    mesh: Arc<Mesh>,
    pub program: MetricProgram,
    bending: Option<TargetBending>,
    pub pins: Pins,
    /// What was asked for last, which several components ask for one after another.
    last: Asked,
}

/// The metric of the whole surface at a time.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    time: f64,
    pub metric: Arc<Metric>,
    pub curvature_error: Option<f64>,
}

impl Course {
    /// With the metric of one time, which the caller has asked the program for.
    pub fn new(
        mesh: Arc<Mesh>,
        program: MetricProgram,
        bending: Option<TargetBending>,
        pins: Pins,
        (time, metric, curvature_error): (f64, Arc<Metric>, Option<f64>),
    ) -> Course {
        let last = Asked { time, metric, curvature_error };
        Course { mesh, program, bending, pins, last }
    }

    /// Whether anything depends on time.
    pub fn changes(&self) -> bool {
        self.program.changes() || self.changes_besides_metric()
    }

    /// Whether bending angles or pins do.
    pub fn changes_besides_metric(&self) -> bool {
        self.pins.changes() || self.bending.as_ref().is_some_and(TargetBending::changes)
    }

    /// The metric of the whole surface.
    pub fn metric(&mut self, time: f64) -> Result<&Asked, EvolveError> {
        if self.last.time != time {
            let MetricAt { metric, curvature_error } =
                self.program.at(&self.mesh, time).map_err(|error| EvolveError::Metric { time, error })?;
            self.last = Asked { time, metric: Arc::new(metric), curvature_error };
        }
        Ok(&self.last)
    }

    /// The metric of a component.
    pub fn metric_of(&mut self, component: &Component, time: f64) -> Result<Arc<Metric>, EvolveError> {
        let whole = self.metric(time)?.metric.clone();
        metric_of(component, &whole)
            .map_err(|error| EvolveError::Metric { time, error: AtKey { key: "metric".to_owned(), error } })
    }

    /// The target bending angles of a component in radians, one per edge; `None` for a shell that is flat at rest.
    pub fn angles_of(&self, component: &Component, time: f64) -> Result<Option<Vec<f64>>, AtKey<BendingError>> {
        let angles = self.bending.as_ref().map(|bending| bending.at(time)).transpose()?;
        Ok(angles.map(|angles| component.edges.pick(&angles)))
    }

    /// Per edge of a component: whether a bending angle is asked for.
    pub fn is_bent(&self, component: &Component) -> Option<Vec<bool>> {
        self.bending.as_ref().map(|bending| component.edges.pick(bending.is_asked()))
    }

    /// The pinned vertices of a component, numbered as in it, with their places.
    pub fn pins_of(&self, component: &Component, time: f64) -> Result<Vec<(VertexId, DVec3)>, AtKey<PinError>> {
        let here = |(v, place): (VertexId, DVec3)| Some((VertexId::new(component.vertices.here(v.index())?), place));
        Ok(self.pins.at(time)?.into_iter().filter_map(here).collect())
    }

    /// Whether there is an answer at a time, found without simulating.
    pub fn check(&mut self, time: f64) -> Result<(), EvolveError> {
        if self.program.changes() {
            self.metric(time)?;
        }
        self.pins.at(time)?;
        self.bending.as_ref().map(|bending| bending.at(time)).transpose()?;
        Ok(())
    }
}

/// The metric of a component of a surface with this one, shared where it is all of it.
pub(super) fn metric_of(component: &Component, whole: &Arc<Metric>) -> Result<Arc<Metric>, MetricError> {
    if component.mesh.edge_count() == whole.edge_lengths().len() {
        return Ok(whole.clone());
    }
    Metric::new(&component.mesh, component.edges.pick(whole.edge_lengths())).map(Arc::new)
}
