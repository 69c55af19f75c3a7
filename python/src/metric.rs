//! `immerse.Metric`.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;
use immerse::immersion::gaussian_curvatures;
use immerse::metric::lengths_of_positions;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use super::arrays::{Given, doubles, points, rows, table, tuple, vector};
use super::errors::{raised, refused};
use super::mesh::Mesh;

/// How far the lengths of the two sides of an edge may be apart, as a share: rounding.
const SAME_LENGTH: f64 = 1e-9;

/// Edge lengths on a mesh, and what they determine.
///
/// Parameters
/// ----------
/// mesh : Mesh
/// lengths : array of float, (|E|,) or (|F|, 3) or (|E|, 3)
///     Positive lengths, in any unit. Of shape (|E|,): one per edge, in the order of `mesh.edges`. Of shape (|F|, 3): in
///     each face from corner k to corner k + 1; the two sides of an edge must agree. Of shape (|E|, 3): rows of the two
///     ends of an edge and its length, each edge once, in any order.
///
/// Raises
/// ------
/// Error
///     Naming the edge or the face where lengths are not positive and finite, or break the triangle inequality.
#[pyclass(module = "immerse", frozen)]
pub struct Metric {
    /// Its mesh.
    pub mesh: Py<Mesh>,
    /// The library's metric.
    pub metric: Arc<immerse::Metric>,
}

impl Metric {
    /// Of the library's metric.
    pub fn of(mesh: Py<Mesh>, metric: immerse::Metric) -> Metric {
        Metric { mesh, metric: Arc::new(metric) }
    }

    /// Its connectivity.
    pub fn connectivity(&self) -> &Arc<immerse::Mesh> {
        &self.mesh.get().mesh
    }

    fn of_lengths(py: Python<'_>, mesh: Py<Mesh>, lengths: Vec<f64>) -> PyResult<Metric> {
        let connectivity = &mesh.get().mesh;
        let metric = py.detach(|| immerse::Metric::new(connectivity, lengths)).map_err(|error| raised(py, &error))?;
        Ok(Metric::of(mesh, metric))
    }
}

#[pymethods]
impl Metric {
    #[new]
    fn new(mesh: Bound<'_, PyAny>, lengths: &Bound<'_, PyAny>) -> PyResult<Metric> {
        let py = mesh.py();
        let mesh = mesh_of(mesh)?;
        let connectivity = &mesh.get().mesh;
        let array = doubles("lengths", lengths)?;
        let (edges, faces) = (connectivity.edge_count(), connectivity.face_count());
        let lengths = match *array.shape() {
            [_] => array.entries()?.to_vec(),
            [found, 3] if found == faces => of_sides(py, connectivity, &array)?,
            [found, 3] if found == edges => of_rows(py, connectivity, &array)?,
            _ => {
                let reason = format!("lengths has shape {}", tuple(array.shape()));
                let remedy = format!(
                    "give one per edge, ({edges},), one per side of each face, ({faces}, 3), or rows of two ends and a \
                     length, ({edges}, 3)"
                );
                return Err(refused(py, reason, remedy));
            }
        };
        Metric::of_lengths(py, mesh.clone().unbind(), lengths)
    }

    /// The metric of a surface in space: the distances of the ends of each edge.
    ///
    /// Parameters
    /// ----------
    /// mesh : Mesh
    /// positions : array of float, (|V|, 3)
    #[staticmethod]
    fn from_positions(mesh: Bound<'_, PyAny>, positions: &Bound<'_, PyAny>) -> PyResult<Metric> {
        let py = mesh.py();
        let mesh = mesh_of(mesh)?;
        let array = doubles("positions", positions)?;
        points(py, "positions", &array, mesh.get().mesh.vertex_count())?;
        let places: &[DVec3] = rows(array.entries()?);
        let connectivity = &mesh.get().mesh;
        let lengths = py.detach(|| lengths_of_positions(connectivity, places));
        Metric::of_lengths(py, mesh.clone().unbind(), lengths)
    }

    /// The metric of a function that is called once, with the numbers of both ends of all edges.
    ///
    /// Parameters
    /// ----------
    /// mesh : Mesh
    /// length : callable
    ///     Given two arrays of uint32, (|E|,) each, returns an array of float, (|E|,).
    #[staticmethod]
    fn from_function(mesh: Bound<'_, PyAny>, length: &Bound<'_, PyAny>) -> PyResult<Metric> {
        let py = mesh.py();
        let mesh = mesh_of(mesh)?;
        let connectivity = &mesh.get().mesh;
        let end = |k: usize| vector(py, connectivity.edges().map(|e| connectivity.edge_vertices(e)[k].0).collect());
        let array = doubles("what the function returns", &length.call1((end(0), end(1)))?)?;
        super::arrays::shaped(py, "what the function returns", &array, &[Some(connectivity.edge_count())])?;
        Metric::of_lengths(py, mesh.clone().unbind(), array.entries()?.to_vec())
    }

    /// The mesh.
    #[getter]
    fn mesh(&self, py: Python<'_>) -> Py<Mesh> {
        self.mesh.clone_ref(py)
    }

    /// Length of each edge: float64, (|E|,).
    #[getter]
    fn lengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.metric.edge_lengths().to_vec())
    }

    /// Angle at each corner of each face, in radians: float64, (|F|, 3).
    #[getter]
    fn angles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mesh = self.connectivity();
        table(py, mesh.faces().map(|f| [0, 1, 2].map(|k| self.metric.corner_angle(f, k))).collect())
    }

    /// Area of each face: float64, (|F|,).
    #[getter]
    fn areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.metric.face_areas().to_vec())
    }

    /// A third of the area of the faces around each vertex: float64, (|V|,).
    #[getter]
    fn vertex_areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.metric.vertex_areas(self.connectivity()))
    }

    /// Curvature of each vertex as an angle in radians: 2 pi minus the sum of the angles around it, at the boundary pi minus
    /// that. All of them add up to 2 pi times the Euler characteristic. float64, (|V|,).
    #[getter]
    fn curvatures<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let mesh = self.connectivity();
        vector(py, mesh.vertices().map(|v| self.metric.curvature(mesh, v)).collect())
    }

    /// Gaussian curvature of each vertex, of unit 1/length²: the angle over the area of the vertex. At the boundary it is the
    /// mean of that around. float64, (|V|,).
    #[getter]
    fn gaussian_curvatures<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, gaussian_curvatures(self.connectivity(), &self.metric))
    }

    fn __repr__(&self) -> String {
        let (edges, area) = (self.connectivity().edge_count(), self.metric.total_area());
        format!("<immerse.Metric: {edges} edge lengths, area {area:.6}>")
    }
}

/// The mesh that a metric is to be on.
fn mesh_of(given: Bound<'_, PyAny>) -> PyResult<Bound<'_, Mesh>> {
    let (py, name) = (given.py(), given.get_type().name()?.to_string());
    given.cast_into::<Mesh>().map_err(|_| {
        refused(
            py,
            format!("a metric is one on a mesh, and a {name} was given"),
            "give a Mesh first; `Mesh(faces)` makes one",
        )
    })
}

/// From the lengths of the sides of all faces.
fn of_sides(py: Python<'_>, mesh: &immerse::Mesh, array: &Given<'_, f64>) -> PyResult<Vec<f64>> {
    let sides = array.entries()?;
    let mut lengths = Vec::with_capacity(mesh.edge_count());
    for e in mesh.edges() {
        let h = mesh.edge_halfedge(e);
        let length = sides[h.index()];
        if let Some(twin) = mesh.twin(h) {
            let other = sides[twin.index()];
            if (length - other).abs() > SAME_LENGTH * length.abs() {
                let ends = mesh.edge_vertices(e).map(|v| v.0);
                let (face, beside) = (h.face().index(), twin.face().index());
                let reason = format!(
                    "the edge between vertices {ends:?} has length {length} in face {face} and {other} in face {beside}"
                );
                return Err(refused(py, reason, "give both the same"));
            }
        }
        lengths.push(length);
    }
    Ok(lengths)
}

/// From rows of two ends and a length.
fn of_rows(py: Python<'_>, mesh: &immerse::Mesh, array: &Given<'_, f64>) -> PyResult<Vec<f64>> {
    let key = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let ends = |e| mesh.edge_vertices(e).map(|v| v.0);
    let edges: HashMap<[u32; 2], usize> = mesh.edges().map(|e| (key(ends(e)), e.index())).collect();
    let mut lengths = vec![None; mesh.edge_count()];
    let number = |x: f64| (x >= 0.0 && x.fract() == 0.0 && x <= f64::from(u32::MAX)).then_some(x as u32);
    for (row, &[a, b, length]) in rows::<f64, [f64; 3]>(array.entries()?).iter().enumerate() {
        let edge = number(a).zip(number(b)).and_then(|(a, b)| edges.get(&key([a, b])));
        let Some(&edge) = edge else {
            let reason = format!("row {row} of lengths names vertices {a} and {b}, between which there is no edge");
            return Err(refused(py, reason, "name the ends of an edge of the mesh; `mesh.edges` has all of them"));
        };
        if lengths[edge].replace(length).is_some() {
            let reason = format!("row {row} of lengths names the edge between vertices {a} and {b} once more");
            return Err(refused(py, reason, "name every edge once"));
        }
    }
    // As many rows as edges, and none twice.
    Ok(lengths.into_iter().flatten().collect())
}
