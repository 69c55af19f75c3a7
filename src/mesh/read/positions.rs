//! Other files of the same connectivity.

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;

use super::file::{read, read_soup};
use super::soup::Soup;
use crate::mesh::{FaceId, Mesh, MeshError, VertexId};

/// Reads the vertex positions of a file whose faces are those of the mesh, in the same order; |V| values.
///
/// Vertices of the file are those of the mesh with the same number in the file that the mesh comes from. Where that does
/// not fit, the file is read as [`read`] does, and its vertices are counted without those that belong to no face.
///
/// # Errors
/// As [`read`], and [`MeshError::File`] if the faces are others, there are no positions, or vertices that were welded lie
/// apart.
pub fn read_positions(path: &Path, mesh: &Mesh) -> Result<Vec<DVec3>, MeshError> {
    let fail = |reason: String, remedy: &str| MeshError::File { path: path.into(), reason, remedy: remedy.into() };
    let (soup, _) = read_soup(path)?;
    if let (Some(positions), true) = (&soup.positions, same_faces(&soup, mesh)) {
        let size = positions.iter().fold(0.0, |most: f64, p| p.distance(positions[0]).max(most));
        if size > 0.0 {
            for [a, b] in mesh.welded_numbers().filter(|numbers| numbers.iter().all(|&n| n < positions.len())) {
                if positions[a].distance(positions[b]) > 1e-4 * size {
                    let reason =
                        format!("vertices {a} and {b} (counted from 0) are welded in the mesh, and lie apart here");
                    return Err(fail(reason, "move them to one place, or write weld = \"none\" under [mesh]"));
                }
            }
            return Ok(mesh.vertices().map(|v| positions[mesh.file_vertex(v)]).collect());
        }
    }
    let surface = read(path)?;
    let [here, there] = [mesh, &surface.mesh].map(Mesh::triangles);
    if here != there {
        let reason = match here.iter().zip(&there).position(|(a, b)| a != b) {
            Some(face) if here.len() == there.len() => {
                let face = FaceId::new(face);
                let (here, there) = (mesh.file_corners(face), surface.mesh.file_corners(face));
                format!("face {} has vertices {there:?}, in the mesh of the scene {here:?}", mesh.file_face(face))
            }
            _ => format!("it has {} faces, the mesh of the scene has {}", there.len(), here.len()),
        };
        return Err(fail(reason, "use a mesh with the same faces in the same order, only its positions may differ"));
    }
    surface.positions.ok_or_else(|| fail("it has no positions".into(), "use a file that has them"))
}

/// Whether a file has the polygons of a mesh in the same order, by the numbers of the file that the mesh comes from. How
/// polygons were cut does not matter, nor which way round they go.
fn same_faces(soup: &Soup, mesh: &Mesh) -> bool {
    let count = soup.positions.as_ref().map_or(0, Vec::len);
    let mut named = Vec::with_capacity(soup.triangles.len());
    for face in &soup.triangles {
        let [a, b, c] = face.map(|v| mesh.vertex_of_file(v as usize).ok().filter(|_| (v as usize) < count));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else { return false };
        named.push([a, b, c]);
    }
    let all_there = mesh.vertices().all(|v| mesh.file_vertex(v) < count);
    if named.len() != mesh.face_count() || !all_there {
        return false;
    }
    let of_soup: Vec<usize> = (0..named.len()).map(|f| soup.polygon(f)).collect();
    let of_mesh: Vec<usize> = mesh.faces().map(|f| mesh.file_face(f)).collect();
    let corners: Vec<[VertexId; 3]> = mesh.faces().map(|f| mesh.corners(f)).collect();
    let mut start = 0;
    of_soup == of_mesh
        && of_soup.chunk_by(|a, b| a == b).all(|polygon| {
            let range = start..start + polygon.len();
            start = range.end;
            let (here, there) = (&corners[range.clone()], &named[range]);
            match (here, there) {
                (&[[a, b, c]], &[other]) => other == [a, b, c] || other == [a, c, b],
                _ => outline(here) == outline(there),
            }
        })
}

/// The edges around a polygon, whichever way round.
fn outline(triangles: &[[VertexId; 3]]) -> HashSet<[VertexId; 2]> {
    let mut edges = HashSet::new();
    for &[a, b, c] in triangles {
        for [a, b] in [[a, b], [b, c], [c, a]] {
            let edge = [a.min(b), a.max(b)];
            if !edges.remove(&edge) {
                edges.insert(edge);
            }
        }
    }
    edges
}
