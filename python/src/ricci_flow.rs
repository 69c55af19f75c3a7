//! `immerse.ricci_flow`.

use std::sync::{Mutex, PoisonError};

use immerse::metric::{BoundaryCondition, CurvatureTarget, InteriorCurvature};
use numpy::PyArray1;
use pyo3::prelude::*;

use super::arrays::{doubles, shaped, vector};
use super::errors::raised;
use super::metric::Metric;

/// Ricci flow of a metric toward given curvatures, by conformal scaling: no positions are needed. Made by `ricci_flow`.
#[pyclass(module = "immerse", frozen)]
pub struct RicciFlow {
    start: Py<Metric>,
    flow: Mutex<immerse::metric::RicciFlow>,
}

/// Starts Ricci flow at a metric, and finds its limit.
///
/// Parameters
/// ----------
/// metric : Metric
///     On a connected mesh.
/// target : None or float or array of float, (|V|,)
///     What curvature is wanted: None, one that is constant, as much as Gauss-Bonnet says; a number, that Gaussian
///     curvature, of unit 1/length²; an array, that of each vertex as an angle in radians, as `Metric.curvatures`, of which
///     entries at the boundary are not read.
/// turning : array of float, (|V|,), optional
///     Turning angles of the boundary in radians, of which entries inside are not read. Left out, boundary edges keep their
///     lengths.
/// keep_area : bool
///     Whether the total area stays what it is, where nothing else decides it.
///
/// Raises
/// ------
/// Error
///     If no metric has such curvatures, or none was found.
///
/// Examples
/// --------
/// >>> flow = immerse.ricci_flow(metric)
/// >>> halfway, end = flow.at(1.0), flow.limit
#[pyfunction]
#[pyo3(signature = (metric, target=None, *, turning=None, keep_area=true))]
pub fn ricci_flow(
    metric: Bound<'_, Metric>,
    target: Option<&Bound<'_, PyAny>>,
    turning: Option<&Bound<'_, PyAny>>,
    keep_area: bool,
) -> PyResult<RicciFlow> {
    let py = metric.py();
    let mesh = metric.get().connectivity().clone();
    let per_vertex = |what: &str, given: &Bound<'_, PyAny>| {
        let array = doubles(what, given)?;
        shaped(py, what, &array, &[Some(mesh.vertex_count())])?;
        PyResult::Ok(array.entries()?.to_vec())
    };
    let interior = match target {
        None => InteriorCurvature::Constant,
        Some(target) => match target.extract::<f64>() {
            Ok(density) => InteriorCurvature::Density(density),
            Err(_) => InteriorCurvature::PerVertex(per_vertex("target", target)?),
        },
    };
    let boundary = match turning {
        None => BoundaryCondition::Isometric,
        Some(turning) => BoundaryCondition::TurningAngles(per_vertex("turning", turning)?),
    };
    let target = CurvatureTarget { interior, boundary, keep_area };
    let start = metric.get().metric.clone();
    let flow = py.detach(|| immerse::metric::RicciFlow::new(&mesh, start.edge_lengths(), &target));
    let flow = flow.map_err(|error| raised(py, &error))?;
    Ok(RicciFlow { start: metric.unbind(), flow: Mutex::new(flow) })
}

impl RicciFlow {
    fn metric_of(&self, py: Python<'_>, lengths: Vec<f64>) -> PyResult<Metric> {
        let start = self.start.get();
        let metric = immerse::Metric::new(start.connectivity(), lengths).map_err(|error| raised(py, &error))?;
        Ok(Metric::of(start.mesh.clone_ref(py), metric))
    }

    /// Something of the flow, which others wait for meanwhile.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut immerse::metric::RicciFlow) -> T + Send) -> T {
        py.detach(|| work(&mut self.flow.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}

#[pymethods]
impl RicciFlow {
    /// The metric at a time from 0 on, in units of area / 4 pi. The distance from the limit falls off exponentially, to about
    /// 1 % at 5. Cheapest for increasing times; the same bits in any order.
    fn at(&self, py: Python<'_>, time: f64) -> PyResult<Metric> {
        let lengths = self.with(py, |flow| flow.advance_to(time)).map_err(|error| raised(py, &error))?;
        self.metric_of(py, lengths)
    }

    /// Logarithms of the scale factors of the vertices at a time: lengths are multiplied by the exponential of the mean of
    /// their ends. float64, (|V|,).
    fn log_scale_at<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let scale = self.with(py, |flow| flow.log_scale_at(time)).map_err(|error| raised(py, &error))?;
        Ok(vector(py, scale))
    }

    /// The metric that the flow tends to, with curvatures exact up to rounding.
    #[getter]
    fn limit(&self, py: Python<'_>) -> PyResult<Metric> {
        let lengths = self.with(py, |flow| flow.limit().edge_lengths.clone());
        self.metric_of(py, lengths)
    }

    /// How far the curvature of any vertex of a metric on the same mesh is from its target, in radians.
    fn curvature_error(&self, metric: Bound<'_, Metric>) -> PyResult<f64> {
        let (py, metric) = (metric.py(), metric.get());
        let (mesh, lengths) = (metric.connectivity(), metric.metric.edge_lengths());
        let start = self.start.get().connectivity();
        if mesh.triangles() != start.triangles() {
            return Err(super::errors::refused(
                py,
                "this is a metric on another mesh",
                "give one on the mesh of the flow",
            ));
        }
        self.with(py, |flow| flow.curvature_error(mesh, lengths)).map_err(|error| raised(py, &error))
    }
}
