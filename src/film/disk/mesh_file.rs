//! What is known of the surface of a film beside its frames: `mesh.npz`.

use std::io;
use std::sync::Arc;

use glam::DVec3;

use crate::mesh::{Mesh, VertexId};
use crate::npy::{ArrayReader, ArrayWriter};

/// The surface of a film, and all that pictures want to know of it, so that nobody asks the scene again.
#[derive(Clone, Debug)]
pub struct FilmMesh {
    /// Connectivity.
    pub mesh: Arc<Mesh>,
    /// What x, y and z of each vertex mean in the scene, |V|, if the mesh has positions or coordinates.
    pub places: Option<Vec<DVec3>>,
    /// Pinned vertices, each once, in order.
    pub pins: Vec<VertexId>,
    /// The sides of the parallelogram that a flat torus is glued of, if it is one.
    pub lattice: Option<[[f64; 2]; 2]>,
}

impl FilmMesh {
    /// A mesh of which nothing else is known.
    pub fn of(mesh: Arc<Mesh>) -> FilmMesh {
        FilmMesh { mesh, places: None, pins: Vec::new(), lattice: None }
    }

    /// The bytes of the file.
    pub(super) fn to_npz(&self) -> io::Result<Vec<u8>> {
        let FilmMesh { mesh, places, pins, lattice } = self;
        let count = |n: usize| n as u64;
        let mut file = ArrayWriter::new();
        file.array("triangles", &[count(mesh.face_count()), 3], mesh.triangles().into_iter().flatten())?;
        file.array("edges", &[count(mesh.edge_count()), 2], edges(mesh))?;
        file.array("file_vertex", &[count(mesh.vertex_count())], mesh.file_vertices())?;
        file.array("file_face", &[count(mesh.face_count())], mesh.file_faces())?;
        let mut pinned = vec![0_u8; mesh.vertex_count()];
        pins.iter().for_each(|v| pinned[v.index()] = 1);
        file.array("pinned", &[count(pinned.len())], pinned)?;
        if let Some(places) = places {
            file.array("places", &[count(places.len()), 3], places.iter().flat_map(|place| place.to_array()))?;
        }
        if let Some(lattice) = lattice {
            file.array("lattice", &[2, 2], lattice.iter().flatten().copied())?;
        }
        file.finish()
    }

    /// What a file with these bytes holds, on a mesh that was made of its triangles.
    pub(super) fn from_npz(bytes: &[u8], mesh: Mesh) -> Result<FilmMesh, String> {
        let mut file = ArrayReader::new(bytes)?;
        let vertices = mesh.vertex_count();
        let places = match file.has("places") {
            true => Some(file.array::<f64>("places", &[vertices as u64, 3])?),
            false => None,
        };
        let places = places.map(|places| places.as_chunks().0.iter().map(|&p| DVec3::from_array(p)).collect());
        if file.has("edges") && file.array::<u32>("edges", &[mesh.edge_count() as u64, 2])? != edges(&mesh) {
            return Err("array `edges` does not list the edges of the triangles".to_owned());
        }
        let pinned = file.array::<u8>("pinned", &[vertices as u64])?;
        let pins = (0..pinned.len()).filter(|&v| pinned[v] != 0).map(VertexId::new).collect();
        let lattice = match file.has("lattice") {
            true => {
                file.array::<f64>("lattice", &[2, 2])?.try_into().ok().map(|[a, b, c, d]: [f64; 4]| [[a, b], [c, d]])
            }
            false => None,
        };
        Ok(FilmMesh { mesh: Arc::new(mesh), places, pins, lattice })
    }
}

/// The ends of all edges, from and to: the order of every array that has an entry per edge.
fn edges(mesh: &Mesh) -> Vec<u32> {
    mesh.edges().flat_map(|e| mesh.edge_vertices(e)).map(|v| v.index() as u32).collect()
}

/// Whether a file with these bytes lists its edges, as those of earlier builds do not.
pub(super) fn lists_edges(bytes: &[u8]) -> Result<bool, String> {
    Ok(ArrayReader::new(bytes)?.has("edges"))
}

/// Corners of so many faces.
pub(super) fn triangles_of(bytes: &[u8], faces: usize) -> Result<Vec<[u32; 3]>, String> {
    let corners = ArrayReader::new(bytes)?.array::<u32>("triangles", &[faces as u64, 3])?;
    Ok(corners.as_chunks().0.to_vec())
}

/// The number of each of so many faces in the mesh file.
pub(super) fn file_faces_of(bytes: &[u8], faces: usize) -> Result<Vec<u32>, String> {
    ArrayReader::new(bytes)?.array::<u32>("file_face", &[faces as u64])
}

/// The number of each of so many vertices in the mesh file.
pub(super) fn file_vertices_of(bytes: &[u8], vertices: usize) -> Result<Vec<u32>, String> {
    ArrayReader::new(bytes)?.array::<u32>("file_vertex", &[vertices as u64])
}
