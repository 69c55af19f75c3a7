//! `immerse.ImmersedSurface` and `immerse.Frame`: what was found.

use std::path::PathBuf;
use std::sync::Arc;

use glam::DVec3;
use immerse::evolve::{self, FrameReport};
use immerse::immersion::{bending_angles, length_errors, mean_curvatures};
use immerse::mesh::write_obj;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::{of_points, of_quaternions, rows, vector};
use super::errors::{of_write, raised};
use super::mesh::Mesh;
use super::metric::Metric;

/// A surface in space, and what it is worth. Its arrays are read-only, and are the very memory that the surface was computed
/// in: copy one to change it.
#[pyclass(module = "immerse", frozen, subclass)]
pub struct ImmersedSurface {
    mesh: Py<Mesh>,
    positions: Py<PyArray2<f64>>,
    frames: Py<PyArray2<f64>>,
    rims: Py<PyArray1<u32>>,
    asked: Py<PyArray1<f64>>,
    report: FrameReport,
}

impl ImmersedSurface {
    /// Of a frame, which is taken apart if nobody else holds it.
    pub fn of(py: Python<'_>, mesh: Py<Mesh>, frame: Arc<evolve::Frame>) -> PyResult<ImmersedSurface> {
        let frame = Arc::try_unwrap(frame).unwrap_or_else(|shared| (*shared).clone());
        let evolve::Frame { positions, face_frames, spin: _, edge_lengths, rims, report } = frame;
        Ok(ImmersedSurface {
            mesh,
            positions: of_points(py, positions)?.unbind(),
            frames: of_quaternions(py, face_frames)?.unbind(),
            rims: vector(py, rims.into_iter().map(|e| e.0).collect()).unbind(),
            asked: vector(py, edge_lengths).unbind(),
            report,
        })
    }

    /// Its connectivity.
    pub fn connectivity(&self) -> &Arc<immerse::Mesh> {
        &self.mesh.get().mesh
    }

    /// The ends of its rims.
    pub fn rim_ends(&self, py: Python<'_>) -> PyResult<Vec<[u32; 2]>> {
        let mesh = self.connectivity();
        let rims = self.rims.bind(py).try_readonly()?;
        let ends = |&e: &u32| mesh.edge_vertices(immerse::mesh::EdgeId(e)).map(|v| v.0);
        Ok(rims.as_slice()?.iter().map(ends).collect())
    }

    /// Where its vertices are.
    pub fn places<'py>(&self, py: Python<'py>) -> PyResult<PyReadonlyArray2<'py, f64>> {
        Ok(self.positions.bind(py).try_readonly()?)
    }

    /// A value per vertex or edge of the surface.
    fn measured<'py>(
        &self,
        py: Python<'py>,
        measure: impl Fn(&immerse::Mesh, &[DVec3]) -> Vec<f64> + Sync,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let array = self.places(py)?;
        let (mesh, places) = (self.connectivity(), rows(array.as_slice()?));
        Ok(vector(py, py.detach(|| measure(mesh, places))))
    }
}

#[pymethods]
impl ImmersedSurface {
    /// The mesh.
    #[getter]
    fn mesh(&self, py: Python<'_>) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// Where the vertices are, in the unit of the lengths: float64, (|V|, 3), read-only.
    #[getter]
    fn positions(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.positions.clone_ref(py)
    }

    /// The unit quaternion w, x, y, z of each face, which turns it from its own plane into space (Eq. 10): float64,
    /// (|F|, 4), read-only.
    #[getter]
    fn frames(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.frames.clone_ref(py)
    }

    /// Numbers of the rims, the edges where the surface folds over, in order; `mesh.edges[rims]` are their ends. uint32,
    /// (n,), read-only.
    #[getter]
    fn rims(&self, py: Python<'_>) -> Py<PyArray1<u32>> {
        self.rims.clone_ref(py)
    }

    /// The lengths that were asked for: float64, (|E|,), read-only.
    #[getter]
    fn asked_lengths(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.asked.clone_ref(py)
    }

    /// The lengths that it has: float64, (|E|,).
    #[getter]
    fn lengths<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.measured(py, immerse::metric::lengths_of_positions)
    }

    /// Relative error of each length: float64, (|E|,).
    #[getter]
    fn length_errors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let asked = self.asked.bind(py).try_readonly()?.as_slice()?.to_vec();
        let metric = immerse::Metric::new(self.connectivity(), asked).map_err(|error| raised(py, &error))?;
        self.measured(py, |mesh, places| length_errors(mesh, &metric, places))
    }

    /// The metric that it has.
    #[getter]
    fn metric(&self, py: Python<'_>) -> PyResult<Metric> {
        let lengths = self.measured(py, immerse::metric::lengths_of_positions)?.to_vec()?;
        let metric = immerse::Metric::new(self.connectivity(), lengths).map_err(|error| raised(py, &error))?;
        Ok(Metric::of(self.mesh.clone_ref(py), metric))
    }

    /// Mean curvature of each vertex, of unit 1/length, positive where the surface bulges to the front: float64, (|V|,).
    #[getter]
    fn mean_curvatures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.measured(py, mean_curvatures)
    }

    /// Angle between the two faces of each edge in radians, positive as on a sphere whose normals point outward: float64,
    /// (|E|,). The target bending angles of an `Immersion` are such angles.
    #[getter]
    fn bending_angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.measured(py, bending_angles)
    }

    /// What the surface is worth, as in the files of a film: `l2_length_error`, `max_length_error`, `rims`, `pinch_points`,
    /// `spin_class`, `energy`, `converged`, `steps`, `seconds` and more.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let text = serde_json::to_string(&self.report)
            .map_err(|error| pyo3::exceptions::PyRuntimeError::new_err(error.to_string()))?;
        let report = py.import("json")?.call_method1("loads", (text,))?.cast_into::<PyDict>()?;
        report.set_item("seconds", self.report.seconds)?;
        Ok(report)
    }

    /// The regular homotopy class, measured on the positions, one digit per generator; None if the surface is pinched, so
    /// that it has none.
    #[getter]
    fn spin_class(&self) -> Option<&str> {
        (!self.report.has_no_class()).then_some(self.report.spin_class.as_str())
    }

    /// The volume that it encloses, positive where its front is outside; None for a surface with boundary.
    #[getter]
    fn enclosed_volume(&self) -> Option<f64> {
        self.report.enclosed_volume
    }

    /// Writes vertices and faces as a Wavefront OBJ file, which appears whole or not at all.
    ///
    /// Raises
    /// ------
    /// OSError
    ///     If the system refuses.
    fn write_obj(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let array = self.places(py)?;
        let (mesh, places) = (self.connectivity(), rows(array.as_slice()?));
        py.detach(|| write_obj(&path, mesh, places)).map_err(|error| of_write(py, &error))
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let name = slf.get_type().name()?;
        let FrameReport { l2_length_error, rims, spin_class, .. } = &slf.get().report;
        Ok(format!(
            "<immerse.{name}: length error {:.4} %, class \"{spin_class}\", {rims} rims>",
            100.0 * l2_length_error
        ))
    }
}

/// A frame of a film: the surface at a time.
#[pyclass(module = "immerse", frozen, extends = ImmersedSurface)]
pub struct Frame {
    number: usize,
    time: f64,
}

impl Frame {
    /// Of the library's frame.
    pub fn of(py: Python<'_>, mesh: Py<Mesh>, frame: Arc<evolve::Frame>) -> PyResult<Py<Frame>> {
        let own = Frame { number: frame.report.frame, time: frame.report.time };
        let surface = ImmersedSurface::of(py, mesh, frame)?;
        Py::new(py, PyClassInitializer::from(surface).add_subclass(own))
    }
}

#[pymethods]
impl Frame {
    /// Its number in the film, from 1.
    #[getter]
    fn number(&self) -> usize {
        self.number
    }

    /// Its time, in the units of the clock.
    #[getter]
    fn time(&self) -> f64 {
        self.time
    }
}
