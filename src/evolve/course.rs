//! What is asked of the surface over time: its metric, its target bending angles, the places of its pins.

use super::error::EvolveError;
use crate::immersion::{NoAngle, PinError, Pins, TargetBending};
use crate::mesh::{Component, Mesh, VertexId};
use crate::metric::{Metric, MetricAt, MetricPart, MetricProgram, NoMetric};
use glam::DVec3;
use std::sync::Arc;

/// The same for all components; each asks for its own share, at times of its own.
#[derive(Debug)]
pub(super) struct Course {
    mesh: Arc<Mesh>,
    program: MetricProgram,
    bending: Option<TargetBending>,
    pins: Pins,
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
    /// Of a film that begins at a time.
    pub fn new(
        mesh: Arc<Mesh>,
        mut program: MetricProgram,
        bending: Option<TargetBending>,
        pins: Pins,
        time: f64,
    ) -> Result<Course, NoMetric> {
        let last = Asked::of(&mut program, &mesh, time)?;
        Ok(Course { mesh, program, bending, pins, last })
    }

    /// The metric that was asked for last, at first that of the first frame, and how far a flow is from its target.
    pub fn last(&self) -> (Arc<Metric>, Option<f64>) {
        (self.last.metric.clone(), self.last.curvature_error)
    }

    /// The metric as a function of time.
    pub fn program(&self) -> &MetricProgram {
        &self.program
    }

    pub fn pins(&self) -> &Pins {
        &self.pins
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
            self.last = Asked::of(&mut self.program, &self.mesh, time)?;
        }
        Ok(&self.last)
    }

    /// The metric of a component.
    pub fn metric_of(&mut self, component: &Component, time: f64) -> Result<Arc<Metric>, EvolveError> {
        let whole = self.metric(time)?.metric.clone();
        Ok(metric_of(component, &whole, time)?)
    }

    /// The target bending angles in radians, |E|; `None` for a shell that is flat at rest.
    pub fn angles(&self, time: f64) -> Result<Option<Vec<f64>>, NoAngle> {
        self.bending.as_ref().map(|bending| bending.at(time)).transpose()
    }

    /// Those of a component.
    pub fn angles_of(&self, component: &Component, time: f64) -> Result<Option<Vec<f64>>, NoAngle> {
        Ok(self.angles(time)?.map(|angles| component.edges.pick(&angles)))
    }

    /// Per edge of a component: whether a bending angle is asked for.
    pub fn is_bent(&self, component: &Component) -> Option<Vec<bool>> {
        self.bending.as_ref().map(|bending| component.edges.pick(bending.is_asked()))
    }

    /// The pinned vertices of a component, numbered as in it, with their places.
    pub fn pins_of(&self, component: &Component, time: f64) -> Result<Vec<(VertexId, DVec3)>, PinError> {
        let here = |(v, place): (VertexId, DVec3)| Some((VertexId::new(component.vertices.here(v.index())?), place));
        Ok(self.pins.at(time)?.into_iter().filter_map(here).collect())
    }
}

impl Asked {
    fn of(program: &mut MetricProgram, mesh: &Mesh, time: f64) -> Result<Asked, NoMetric> {
        let MetricAt { metric, curvature_error } = program.at(mesh, time)?;
        Ok(Asked { time, metric: Arc::new(metric), curvature_error })
    }
}

/// The metric of a component of a surface with this one at a time, shared where it is all of it.
pub(super) fn metric_of(component: &Component, whole: &Arc<Metric>, time: f64) -> Result<Arc<Metric>, NoMetric> {
    if component.mesh.edge_count() == whole.edge_lengths().len() {
        return Ok(whole.clone());
    }
    Metric::new(&component.mesh, component.edges.pick(whole.edge_lengths())).map(Arc::new).map_err(|error| NoMetric {
        time,
        part: MetricPart::Lengths,
        error,
    })
}
