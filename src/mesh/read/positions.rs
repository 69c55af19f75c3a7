//! Other files of the same connectivity.

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;

use super::file::{read, read_soup};
use super::format::FileFormat;
use super::formats::arrays::Arrays;
use super::problem::{Problem, read_bytes};
use super::soup::Soup;
use crate::mesh::surface::first_out_of_reach;
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
    if let Some(positions) = alone(path, mesh)? {
        return Ok(positions);
    }
    let (soup, _) = read_soup(path)?;
    if let Some(positions) = positions_of(&soup, mesh).map_err(|problem| problem.in_file(path))? {
        return Ok(positions);
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

/// Positions of the vertices of a mesh among those of a file with the same faces, by their numbers; |V| values. `None` where
/// the faces are others, or there are no positions.
pub(super) fn positions_of(soup: &Soup, mesh: &Mesh) -> Result<Option<Vec<DVec3>>, Problem> {
    let (Some(positions), true) = (&soup.positions, same_faces(soup, mesh)) else { return Ok(None) };
    let size = positions.iter().fold(0.0, |most: f64, p| p.distance(positions[0]).max(most));
    if size == 0.0 {
        return Ok(None);
    }
    for [a, b] in mesh.welded_numbers().filter(|numbers| numbers.iter().all(|&n| n < positions.len())) {
        if positions[a].distance(positions[b]) > 1e-4 * size {
            let reason = format!("vertices {a} and {b} (counted from 0) are welded in the mesh, and lie apart here");
            return Err(Problem::new(reason, "move them to one place, or write weld = \"none\" under [mesh]"));
        }
    }
    Ok(Some(mesh.vertices().map(|v| positions[mesh.file_vertex(v)]).collect()))
}

/// Positions of an `.npz` file that has no faces, as a frame of a film: one for each vertex, in the program's own order. `None`
/// for all other files.
fn alone(path: &Path, mesh: &Mesh) -> Result<Option<Vec<DVec3>>, MeshError> {
    if FileFormat::of(path) != Some(FileFormat::Npz) {
        return Ok(None);
    }
    let arrays = Arrays::read(&read_bytes(path)?).map_err(|problem| problem.in_file(path))?;
    let (None, Some(positions)) = (arrays.faces, arrays.positions) else { return Ok(None) };
    let [own, of_file] = [mesh.vertex_count(), mesh.file_vertex_count()];
    let reason = match positions.len() {
        count if count != own => format!("it has {count} positions, the mesh has {own} vertices"),
        _ if own != of_file && !arrays.is_frame => {
            format!("it has no `faces` to say whether its {own} rows are the {of_file} vertices of the mesh file")
        }
        _ => {
            return match first_out_of_reach(&positions) {
                Some((v, place)) => {
                    let reason = format!("vertex {v} is at {place:?}, which is too far away");
                    Err(Problem::new(reason, "use another unit").in_file(path))
                }
                None => Ok(Some(positions)),
            };
        }
    };
    Err(Problem::new(reason, "take the frame of a film of this mesh, or add `faces`").in_file(path))
}

/// Whether a file has the polygons of a mesh in the same order, by the numbers of the file that the mesh comes from. How
/// polygons were cut does not matter, nor which way round they go.
pub(super) fn same_faces(soup: &Soup, mesh: &Mesh) -> bool {
    let count = soup.vertex_count;
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
