//! Lengths and bending angles that a file decrees for the edges of a mesh.

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;

use super::edges::{EdgeNumbers, Listed};
use super::file::read_soup;
use super::format::FileFormat;
use super::formats::arrays::{self, Arrays, LengthArray};
use super::positions::same_faces;
use super::problem::{Problem, read_bytes};
use super::soup::Soup;
use crate::mesh::{FaceId, HalfedgeId, Mesh, MeshError, VertexId};

const SAME_FACES: &str = "use a file with the same faces in the same order, by the numbers of the file of the mesh";

/// Reads the lengths that a file decrees for the edges of a mesh, |E|; `None` if it decrees none, so that those of its
/// positions are meant.
///
/// An `.npz` file has `edge_lengths`: rows `u, v, length`, or one length for each row of `edges`, or for each edge of the
/// mesh in its order, as the frames of films have them. It may have `halfedge_lengths` (with `faces`) in their place. An
/// `.npy` file is one of these arrays. A `.fold` file has `edges_length`. Vertices have the numbers of the file of the mesh.
///
/// # Errors
/// [`MeshError::File`] if the file cannot be read, has other faces, misses an edge or gives it two lengths.
pub fn read_lengths(path: &Path, mesh: &Mesh) -> Result<Option<Vec<f64>>, MeshError> {
    let numbers = match FileFormat::of(path) {
        Some(FileFormat::Npy) => {
            let parse = |bytes: &[u8]| arrays::parse_length_array(bytes).and_then(|array| of_array(array, mesh));
            parse(&read_bytes(path)?).map_err(|problem| problem.in_file(path))?
        }
        Some(FileFormat::Npz) => {
            let arrays = Arrays::read(&read_bytes(path)?).map_err(|problem| problem.in_file(path))?;
            let Some(lengths) = arrays.lengths else { return Ok(None) };
            let same = match arrays.faces {
                None => true,
                Some((faces, _)) if matches!(lengths, LengthArray::InOrder(_)) => faces == mesh.triangles(),
                Some((triangles, _)) => {
                    let vertex_count = mesh.file_vertex_count();
                    same_faces(&Soup { vertex_count, triangles, ..Soup::default() }, mesh)
                }
            };
            if !same {
                return Err(Problem::new("its faces are not those of the mesh", SAME_FACES).in_file(path));
            }
            of_array(lengths, mesh).map_err(|problem| problem.in_file(path))?
        }
        Some(FileFormat::Fold) => {
            let (soup, _) = read_soup(path)?;
            return lengths_of(&soup, mesh).map_err(|problem| problem.in_file(path));
        }
        _ => return Ok(None),
    };
    numbers.lengths_on(mesh, None).map(Some).map_err(|problem| problem.in_file(path))
}

/// The lengths that a mesh with the same faces decrees, |E|.
pub(super) fn lengths_of(soup: &Soup, mesh: &Mesh) -> Result<Option<Vec<f64>>, Problem> {
    check_faces(soup, mesh)?;
    let positions = soup.positions.as_ref().map(|all| on(mesh, all));
    soup.lengths.as_ref().map(|lengths| lengths.lengths_on(mesh, positions.as_deref())).transpose()
}

/// Positions of the vertices of a mesh among those of a file with the same numbers.
fn on(mesh: &Mesh, positions: &[DVec3]) -> Vec<DVec3> {
    mesh.vertices().map(|v| positions[mesh.file_vertex(v)]).collect()
}

/// Lengths whose edges are named, or are those of the mesh in its order.
fn of_array(lengths: LengthArray, mesh: &Mesh) -> Result<EdgeNumbers, Problem> {
    match lengths {
        LengthArray::OfEdges(numbers) => Ok(numbers),
        LengthArray::InOrder(values) if values.len() != mesh.edge_count() => {
            let reason = format!("it has {} lengths, the mesh has {} edges", values.len(), mesh.edge_count());
            Err(Problem::new(reason, "give one for each row of `edges` of the film's mesh.npz, or rows u, v, length"))
        }
        LengthArray::InOrder(values) => {
            let ends = mesh.edges().map(|e| mesh.file_ends(e)).collect();
            let values = values.into_iter().map(Some).collect();
            Ok(EdgeNumbers { what: "length", listed: Listed::Rows, ends, values })
        }
    }
}

fn check_faces(soup: &Soup, mesh: &Mesh) -> Result<(), Problem> {
    match same_faces(soup, mesh) {
        true => Ok(()),
        false => Err(Problem::new("its faces are not those of the mesh", SAME_FACES)),
    }
}

/// Reads the bending angles that a FOLD file decrees for the edges of a mesh, |E|, in radians, positive as on a sphere whose
/// normals point outward; `None` if the file decrees none, so that those of its positions are meant. Edges inside of its
/// polygons stay flat; where it says that an angle is not known, and at the boundary, there is none.
///
/// # Errors
/// [`MeshError::File`] if the file cannot be read or has other faces, if there are mountains and valleys on a flat sheet and
/// no angles, or faces of the file disagree in orientation along an edge that has one.
pub fn read_bending_angles(path: &Path, mesh: &Mesh) -> Result<Option<Vec<Option<f64>>>, MeshError> {
    if FileFormat::of(path) != Some(FileFormat::Fold) {
        return Ok(None);
    }
    let (soup, _) = read_soup(path)?;
    angles_of(&soup, mesh).map_err(|problem| problem.in_file(path))
}

/// The bending angles that a mesh with the same faces decrees, |E|.
pub(super) fn angles_of(soup: &Soup, mesh: &Mesh) -> Result<Option<Vec<Option<f64>>>, Problem> {
    check_faces(soup, mesh)?;
    let Some(numbers) = &soup.angles else {
        let is_flat = |positions: &[DVec3]| positions.iter().all(|p| p.z == positions[0].z);
        if soup.has_creases && soup.positions.as_deref().is_none_or(is_flat) {
            let reason =
                "it has mountains and valleys on a flat sheet, and no `edges_foldAngle` says how far they fold";
            return Err(Problem::new(reason, "add `edges_foldAngle`, in degrees, valleys positive"));
        }
        return Ok(None);
    };
    angles_on(numbers, soup, mesh).map(Some)
}

fn angles_on(numbers: &EdgeNumbers, soup: &Soup, mesh: &Mesh) -> Result<Vec<Option<f64>>, Problem> {
    let mut angles = numbers.on(mesh)?;
    let signs = orientations(soup, mesh);
    for e in mesh.edges() {
        let angle = &mut angles[e.index()];
        let Some(sides) = mesh.edge_sides(e) else {
            *angle = None;
            continue;
        };
        let [a, b] = sides.map(HalfedgeId::face);
        if angle.is_none() && mesh.file_face(a) == mesh.file_face(b) {
            *angle = Some(0.0);
        }
        if let Some(angle) = angle.as_mut().filter(|angle| **angle != 0.0) {
            let [first, second] = [a, b].map(|f| signs[f.index()]);
            if first != second {
                let [u, v] = mesh.file_ends(e);
                let reason = format!("the faces at edge {u},{v} disagree in orientation, so that its fold has no side");
                return Err(Problem::new(reason, "list the vertices of all faces counterclockwise"));
            }
            *angle *= first;
        }
    }
    Ok(angles)
}

/// Per face 1 where the file goes round it the same way, and -1 where the mesh turned it over.
fn orientations(soup: &Soup, mesh: &Mesh) -> Vec<f64> {
    let mut directed: HashSet<(usize, VertexId, VertexId)> = HashSet::new();
    for (k, triangle) in soup.triangles.iter().enumerate() {
        let corners = triangle.map(|v| mesh.vertex_of_file(v as usize).ok());
        for [a, b] in [[0, 1], [1, 2], [2, 0]] {
            if let (Some(a), Some(b)) = (corners[a], corners[b]) {
                directed.insert((soup.polygon(k), a, b));
            }
        }
    }
    let turned = |f: FaceId| {
        let polygon = mesh.file_face(f);
        // Cuts inside of a polygon go both ways.
        f.halfedges().into_iter().any(|h| {
            let (a, b) = (mesh.tail(h), mesh.tip(h));
            !directed.contains(&(polygon, a, b)) && directed.contains(&(polygon, b, a))
        })
    };
    mesh.faces().map(|f| if turned(f) { -1.0 } else { 1.0 }).collect()
}
