//! `immerse.Mesh`.

use std::path::PathBuf;
use std::sync::Arc;

use immerse::mesh::{Surface, read};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::arrays::{indices, of_points, rows, shaped, table, vector};
use super::errors::{of_mesh, of_mistake};
use super::scenes;

/// An oriented triangle mesh: connectivity alone, without positions.
///
/// Parameters
/// ----------
/// faces : array of int, (n, 3)
///     Numbers of the corners of each face, from 0, counterclockwise as seen from the front. Every edge has one or two
///     faces, every vertex at least one, and all faces of a vertex form one fan.
/// vertex_count : int, optional
///     Number of vertices; left out, one more than the largest number in `faces`.
///
/// Raises
/// ------
/// Error
///     Naming the first face, edge or vertex that belongs to no oriented surface.
///
/// Examples
/// --------
/// >>> mesh = immerse.Mesh([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
/// >>> mesh.edges.shape
/// (6, 2)
#[pyclass(module = "immerse", frozen)]
pub struct Mesh {
    /// Connectivity.
    pub mesh: Arc<immerse::Mesh>,
}

impl Mesh {
    /// Of the library's mesh.
    pub fn of(mesh: impl Into<Arc<immerse::Mesh>>) -> Mesh {
        Mesh { mesh: mesh.into() }
    }
}

type Places<'py> = Option<Bound<'py, PyArray2<f64>>>;

/// The mesh, and where its vertices are.
fn split(py: Python<'_>, surface: Surface) -> PyResult<(Mesh, Places<'_>)> {
    let positions = surface.positions.map(|positions| of_points(py, positions)).transpose()?;
    Ok((Mesh::of(surface.mesh), positions))
}

#[pymethods]
impl Mesh {
    #[new]
    #[pyo3(signature = (faces, vertex_count=None))]
    fn new(py: Python<'_>, faces: &Bound<'_, PyAny>, vertex_count: Option<usize>) -> PyResult<Mesh> {
        let array = indices("faces", faces)?;
        shaped(py, "faces", &array, &[None, Some(3)])?;
        let entries = array.entries()?;
        let made = py.detach(|| {
            let faces = rows::<u32, [u32; 3]>(entries);
            let count = vertex_count.unwrap_or_else(|| entries.iter().max().map_or(0, |last| *last as usize + 1));
            immerse::Mesh::from_faces(count, faces)
        });
        Ok(Mesh::of(made.map_err(|error| of_mesh(py, &error))?))
    }

    /// Reads an OBJ, PLY, OFF or STL file, chosen by its ending.
    ///
    /// Polygons are cut into triangles, seams are welded, and faces are oriented alike, as in scenes.
    ///
    /// Returns
    /// -------
    /// (Mesh, array of float64 (|V|, 3) or None)
    ///     The mesh, and where its vertices are; None if the file does not say it.
    ///
    /// Raises
    /// ------
    /// Error
    ///     With the line of the file that is at fault.
    /// OSError
    ///     If the file cannot be opened.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<(Mesh, Places<'_>)> {
        let surface = py.detach(|| read(&path)).map_err(|error| of_mesh(py, &error))?;
        split(py, surface)
    }

    /// A generated shape by its name and parameters, those of `[mesh]` in scenes: `sphere`, `uv_sphere`, `octasphere`,
    /// `flat_torus`, `torus`, `cylinder`, `annulus`, `disk`, `hyperbolic_disk`, `polyhedron`, `implicit`.
    ///
    /// Returns
    /// -------
    /// (Mesh, array of float64 (|V|, 3) or None)
    ///     The mesh, and where its vertices are; None for a shape that is known by its lengths alone.
    ///
    /// Examples
    /// --------
    /// >>> mesh, positions = immerse.Mesh.shape("torus", major_radius=1.0, minor_radius=0.4)
    #[staticmethod]
    #[pyo3(signature = (name, /, **parameters))]
    fn shape<'py>(
        py: Python<'py>,
        name: &str,
        parameters: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<(Mesh, Places<'py>)> {
        let section = PyDict::new(py);
        section.set_item("shape", name)?;
        if let Some(parameters) = parameters {
            section.update(parameters.as_mapping())?;
        }
        let whole = PyDict::new(py);
        whole.set_item("mesh", section)?;
        let scene = scenes::scene_of(whole.as_any(), PathBuf::new())?;
        let surface = py.detach(|| scene.surface()).map_err(|error| of_mistake(py, &error))?;
        split(py, surface)
    }

    /// Numbers of the corners of each face, counterclockwise: uint32, (|F|, 3).
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        table(py, self.mesh.triangles())
    }

    /// Numbers of the two ends of each edge: uint32, (|E|, 2). This is the order of every array with an entry per edge.
    #[getter]
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        table(py, self.mesh.edges().map(|e| self.mesh.edge_vertices(e).map(|v| v.0)).collect())
    }

    /// The edges along each face, from corner k to corner k + 1: uint32, (|F|, 3).
    #[getter]
    fn face_edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        table(py, self.mesh.faces().map(|f| f.halfedges().map(|h| self.mesh.edge(h).0)).collect())
    }

    /// Whether each vertex lies on the boundary: bool, (|V|,).
    #[getter]
    fn on_boundary<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        vector(py, self.mesh.vertices().map(|v| self.mesh.is_boundary_vertex(v)).collect())
    }

    /// Number of vertices, |V|.
    #[getter]
    fn vertex_count(&self) -> usize {
        self.mesh.vertex_count()
    }

    /// Number of edges, |E|.
    #[getter]
    fn edge_count(&self) -> usize {
        self.mesh.edge_count()
    }

    /// Number of faces, |F|.
    #[getter]
    fn face_count(&self) -> usize {
        self.mesh.face_count()
    }

    /// |V| - |E| + |F|.
    #[getter]
    fn euler_characteristic(&self) -> i64 {
        self.mesh.euler_characteristic()
    }

    /// Sum of the genera of all components.
    #[getter]
    fn genus(&self) -> usize {
        self.mesh.genus()
    }

    /// Number of generators, which is that of the digits of a class: twice the genus, and the boundary loops but one of
    /// each component.
    #[getter]
    fn generators(&self) -> usize {
        self.mesh.betti()
    }

    /// Number of connected components.
    #[getter]
    fn components(&self) -> usize {
        self.mesh.components().len()
    }

    /// Number of boundary loops.
    #[getter]
    fn boundary_loops(&self) -> usize {
        self.mesh.boundary_loops().len()
    }

    fn __repr__(&self) -> String {
        let mesh = &self.mesh;
        let (v, e, f) = (mesh.vertex_count(), mesh.edge_count(), mesh.face_count());
        format!("<immerse.Mesh: {v} vertices, {e} edges, {f} faces, genus {}>", mesh.genus())
    }
}
