//! `immerse.Immersion`.

use glam::DVec3;
use immerse::evolve::Orientation;
use immerse::immersion::{PinGroup, Pins, TargetBending};
use immerse::mesh::VertexId;
use immerse::timeline::Number;
use pyo3::prelude::*;

use super::arrays::{doubles, finite, indices, points, rows, shaped};
use super::errors::{of_evolve, raised, refused};
use super::metric::Metric;
use super::shape::ImmersedSurface;
use super::watching::Watcher;

/// An isometric immersion that is asked for: a metric, a class, and what frames start from.
///
/// Parameters
/// ----------
/// metric : Metric
/// spin_class : str, optional
///     The regular homotopy class, one digit per generator, such as "01" on a torus; "" on a sphere, which has none. Left
///     out, that of `start`, or all zeros.
/// seed : int
///     Frames start at random from this seed. The same seed gives the same bits, on any number of threads.
/// start : array of float, (|V|, 3), optional
///     Positions of a shape whose frames are taken in place of random ones, and upon which the surface is laid.
/// bending : array of float, (|E|,), optional
///     Target bending angles in radians, signed as `ImmersedSurface.bending_angles`.
/// pins : (array of int (n,), array of float (n, 3)), optional
///     Vertices that are held, and where.
/// orientation : str
///     Which of two mirror images: "outward", the one whose front is outside, or "as it comes".
/// accuracy : float, optional
///     Done as soon as the L2 length error is at most this and there are no rims; left out, done when frames stand still.
///
/// Raises
/// ------
/// Error
///     From `relax`, for what does not fit the mesh; arrays of another shape are refused here already.
///
/// Examples
/// --------
/// >>> shape = immerse.Immersion(metric, spin_class="01", seed=0).relax()
/// >>> shape.positions, shape.report["l2_length_error"]
#[pyclass(module = "immerse", frozen)]
pub struct Immersion {
    metric: Py<Metric>,
    class: Option<immerse::Class>,
    seed: u64,
    start: Option<Vec<DVec3>>,
    bending: Option<Vec<f64>>,
    pins: Option<(Vec<VertexId>, Vec<DVec3>)>,
    orientation: Orientation,
    accuracy: Option<f64>,
}

#[pymethods]
impl Immersion {
    #[new]
    #[pyo3(signature = (
        metric, *, spin_class=None, seed=0, start=None, bending=None, pins=None, orientation="outward", accuracy=None
    ))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        metric: Bound<'_, PyAny>,
        spin_class: Option<&str>,
        seed: i128,
        start: Option<&Bound<'_, PyAny>>,
        bending: Option<&Bound<'_, PyAny>>,
        pins: Option<(Bound<'_, PyAny>, Bound<'_, PyAny>)>,
        orientation: &str,
        accuracy: Option<f64>,
    ) -> PyResult<Immersion> {
        let py = metric.py();
        let Ok(metric) = metric.cast_into::<Metric>() else {
            let remedy = "give a Metric; `Metric(mesh, lengths)` makes one of edge lengths, `Metric.from_positions` of positions";
            return Err(refused(py, "an immersion is one of a metric, and something else was given", remedy));
        };
        let mesh = metric.get().connectivity().clone();
        let Ok(seed) = u64::try_from(seed) else {
            return Err(refused(py, format!("the seed is {seed}"), "give a whole number from 0 to 2^64 - 1"));
        };
        let class =
            spin_class.map(str::parse).transpose().map_err(|error: immerse::spin::SpinError| raised(py, &error))?;
        let start = start
            .map(|start| {
                let array = doubles("start", start)?;
                points(py, "start", &array, mesh.vertex_count())?;
                PyResult::Ok(rows(array.entries()?).to_vec())
            })
            .transpose()?;
        let bending = bending
            .map(|bending| {
                let array = doubles("bending", bending)?;
                shaped(py, "bending", &array, &[Some(mesh.edge_count())])?;
                finite(py, "bending", array.entries()?)?;
                PyResult::Ok(array.entries()?.to_vec())
            })
            .transpose()?;
        let pins = pins
            .map(|(vertices, places)| {
                let vertices = indices("the vertices of pins", &vertices)?;
                shaped(py, "the vertices of pins", &vertices, &[None])?;
                let places = doubles("the places of pins", &places)?;
                points(py, "the places of pins", &places, vertices.entries()?.len())?;
                let vertices = vertices.entries()?.iter().map(|&v| VertexId(v)).collect::<Vec<_>>();
                if let Some(v) = vertices.iter().find(|v| v.index() >= mesh.vertex_count()) {
                    let reason = format!("vertex {} is pinned, and there are {} vertices", v.0, mesh.vertex_count());
                    return Err(refused(py, reason, "name vertices of the mesh, counted from 0"));
                }
                Ok((vertices, rows(places.entries()?).to_vec()))
            })
            .transpose()?;
        let orientation = match orientation {
            "outward" => Orientation::Outward,
            "as it comes" => Orientation::AsItComes,
            other => {
                return Err(refused(
                    py,
                    format!("there is no orientation {other:?}"),
                    "write \"outward\" or \"as it comes\"",
                ));
            }
        };
        if let Some(accuracy) = accuracy.filter(|accuracy| !(accuracy.is_finite() && *accuracy > 0.0)) {
            return Err(refused(py, format!("accuracy is {accuracy}"), "give a length error above 0, such as 1e-4"));
        }
        Ok(Immersion { metric: metric.unbind(), class, seed, start, bending, pins, orientation, accuracy })
    }

    /// Finds the surface. Other threads of Python run meanwhile.
    ///
    /// Parameters
    /// ----------
    /// progress : callable, optional
    ///     Called after every step with a `Progress`. If it returns False the relaxation ends; None goes on.
    ///
    /// Raises
    /// ------
    /// Error
    ///     For what does not fit the mesh.
    /// Stopped
    ///     If `progress` returned False. What it raises, and KeyboardInterrupt, end the relaxation after the step.
    #[pyo3(signature = (progress=None))]
    fn relax(&self, py: Python<'_>, progress: Option<Py<PyAny>>) -> PyResult<ImmersedSurface> {
        let metric = self.metric.get();
        let mesh = metric.connectivity().as_ref();
        let mut immersion = immerse::Immersion::of(mesh, &metric.metric).seed(self.seed).orientation(self.orientation);
        if let Some(class) = &self.class {
            immersion = immersion.class(class.clone());
        }
        if let Some(start) = &self.start {
            immersion = immersion.start_at(start);
        }
        if let Some(angles) = &self.bending {
            immersion = immersion.bending(TargetBending::of_shape(mesh, angles.clone(), Number::Constant(1.0)));
        }
        if let Some((vertices, places)) = &self.pins {
            let group = PinGroup::new(vertices.clone(), places.clone()).map_err(|error| raised(py, &error))?;
            immersion = immersion.pins(Pins::new(mesh, vec![group]));
        }
        if let Some(accuracy) = self.accuracy {
            immersion = immersion.accuracy(accuracy);
        }
        let mut watcher = Watcher::new(progress, 1);
        let found = py.detach(|| {
            let mut simulation = immersion.simulation().map_err(Fault::Setup)?;
            // The simulation ends here, so that nobody else holds its frame.
            simulation.next_frame(&mut watcher).map_err(Fault::Evolve)
        });
        match (watcher.raised(), found) {
            (Some(error), _) => Err(error),
            (None, Ok(frame)) => ImmersedSurface::of(py, metric.mesh.clone_ref(py), frame),
            (None, Err(Fault::Setup(error))) => Err(raised(py, &error)),
            (None, Err(Fault::Evolve(error))) => Err(of_evolve(py, &error)),
        }
    }

    /// The metric.
    #[getter]
    fn metric(&self, py: Python<'_>) -> Py<Metric> {
        self.metric.clone_ref(py)
    }
}

/// Why there is no surface.
enum Fault {
    Setup(immerse::evolve::SetupError),
    Evolve(immerse::evolve::EvolveError),
}
