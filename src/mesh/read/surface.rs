//! From what a file says to a surface: seams welded, faults told in the file's own numbers, and other files of the same
//! connectivity.

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;

use super::{Soup, read, read_soup};
use crate::mesh::repair::{Repaired, Unrepairable, repair_welded};
use crate::mesh::weld::{Welded, small_distance, weld, weld_corners};
use crate::mesh::{Mesh, MeshError, Numbering, Surface, VertexId};
use crate::scene::Weld;

/// What matters here about a file's format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    /// Lists of corners, with equal coordinates merged; there are no numbers.
    Stl,
    Other,
}

impl Format {
    pub fn of(ending: &str) -> Format {
        match ending {
            "obj" => Format::Obj,
            "stl" => Format::Stl,
            _ => Format::Other,
        }
    }

    /// The number of the first vertex and of the first face.
    pub fn counts_from(self) -> u32 {
        u32::from(self == Format::Obj)
    }
}

impl Soup {
    /// The polygon of the file that a triangle is of.
    pub(super) fn polygon(&self, triangle: usize) -> usize {
        self.polygons.get(triangle).map_or(triangle, |&polygon| polygon as usize)
    }

    /// Lines of triangles, each once.
    pub(super) fn lines_of(&self, triangles: &[usize]) -> Vec<usize> {
        let mut lines: Vec<usize> = triangles.iter().filter_map(|&f| self.lines.get(f).copied()).collect();
        lines.dedup();
        lines
    }

    pub(super) fn in_file(&self, path: &Path, format: Format, error: MeshError, lines: &[usize]) -> MeshError {
        if let MeshError::Empty | MeshError::TooLarge { .. } = error {
            let message = error.to_string();
            let (reason, remedy) = message.split_once("; ").unwrap_or((&message, "correct it"));
            return MeshError::File { path: path.to_owned(), reason: reason.to_owned(), remedy: remedy.to_owned() };
        }
        let (path, error) = (path.to_owned(), Box::new(error));
        MeshError::InFile { path, lines: lines.to_vec(), counted_from: format.counts_from(), error }
    }

    /// Welds, orients and compacts.
    pub(super) fn surface(&self, format: Format, how: Option<Weld>) -> Result<Surface, Unrepairable> {
        // A file whose vertices all lie in one point has no positions.
        let positions = self.positions.as_ref().filter(|all| all.iter().any(|p| *p != all[0]));
        let mut notes = self.notes.clone();
        let (repaired, positions) = match positions {
            None => {
                if matches!(how, Some(Weld::Exact | Weld::Within(_))) {
                    notes.push("nothing was welded, because the file has no positions".to_owned());
                }
                let alone: Vec<u32> = (0..self.vertex_count as u32).collect();
                (repair_welded(self.vertex_count, &self.triangles, &alone)?, None)
            }
            Some(positions) => {
                let tolerance = match (how, format) {
                    (Some(Weld::None), _) => None,
                    (Some(Weld::Within(distance)), _) => Some(distance),
                    (None, Format::Stl) => Some(small_distance(&self.triangles, positions)),
                    (None | Some(Weld::Exact), _) => Some(0.0),
                };
                self.welded(format, positions, tolerance, &mut notes)?
            }
        };
        let Repaired { mesh, vertex_map, repairs, .. } = repaired;
        notes.extend(repairs);
        let faces = (0..self.triangles.len()).map(|f| self.polygon(f) as u32).collect();
        let meant = match format {
            Format::Stl => mesh.vertices().map(Some).collect(),
            _ => vertex_map,
        };
        let mesh = mesh.numbered(Numbering::new(meant, faces));
        Ok(Surface { mesh, positions, coordinates: None, edge_lengths: None, repairs: notes })
    }

    /// The mesh with its seams welded, and positions of its vertices.
    fn welded(
        &self,
        format: Format,
        positions: &[DVec3],
        tolerance: Option<f64>,
        notes: &mut Vec<String>,
    ) -> Result<(Repaired, Option<Vec<DVec3>>), Unrepairable> {
        let finished = |triangles: &[[u32; 3]], positions: &[DVec3], first: &[u32]| {
            // What is out of range is told by the repair.
            let name = |v: u32| first.get(v as usize).copied().unwrap_or(v);
            let named: Vec<[u32; 3]> = triangles.iter().map(|face| face.map(name)).collect();
            let repaired = repair_welded(positions.len(), &named, first)?;
            let places = repaired.input_vertices.iter().map(|&v| positions[v]).collect();
            Ok((repaired, Some(places)))
        };
        match weld(&self.triangles, positions, tolerance) {
            Some(welded) => {
                let result = finished(&self.triangles, positions, &welded.first)?;
                notes.extend(self.sentences(format, tolerance, &welded));
                Ok(result)
            }
            None => {
                // Bodies that touch share corners in STL files, and jitter leaves others alone. Taken apart they may weld.
                if let (Format::Stl, Some(tolerance)) = (format, tolerance) {
                    let corners: Vec<DVec3> = self.triangles.iter().flatten().map(|&v| positions[v as usize]).collect();
                    let apart: Vec<[u32; 3]> =
                        (0..self.triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
                    if let Some(welded) = weld_corners(&corners, tolerance) {
                        let (repaired, places) = finished(&apart, &corners, &welded.first)?;
                        let (before, after) = (positions.len(), repaired.mesh.vertex_count());
                        notes.push(format!(
                            "welded the corners of {} triangles along their edges, so that {before} different points \
                             became {after} vertices and bodies that touch stay apart",
                            self.triangles.len()
                        ));
                        return Ok((repaired, places));
                    }
                }
                let alone: Vec<u32> = (0..self.vertex_count as u32).collect();
                finished(&self.triangles, positions, &alone)
            }
        }
    }

    /// What was welded, and what might have been.
    fn sentences(&self, format: Format, tolerance: Option<f64>, welded: &Welded) -> Vec<String> {
        let mut sentences = Vec::new();
        let merged = welded.first.iter().enumerate().filter(|(v, first)| *v != **first as usize).count();
        if welded.glued > 0 {
            let within = match tolerance {
                Some(distance) if distance > 0.0 => format!("lie within {distance:.1e} of each other"),
                _ => "lie upon each other".to_owned(),
            };
            sentences.push(format!(
                "welded {} pairs of boundary edges that {within}, so that {merged} vertices became one with others; write \
                 weld = \"none\" under [mesh] to keep the seam open",
                welded.glued
            ));
        }
        let from = format.counts_from();
        let named = |a: u32, b: u32| match format {
            Format::Stl => String::new(),
            _ => format!(" (the first are {} and {} of the file, counted from {from})", a + from, b + from),
        };
        if let Some(&[a, b]) = welded.on_inside.first() {
            let count = welded.on_inside.len();
            let vertices = if count == 1 { "vertex lies" } else { "vertices lie" };
            let named = named(a, b);
            sentences.push(format!(
                "{count} boundary {vertices} at the place of one that is not on the boundary{named}, where nothing is welded"
            ));
        }
        if let Some(&[a, b]) = welded.coincident.first() {
            let count = welded.coincident.len();
            let vertices = if count == 1 { "vertex lies" } else { "vertices lie" };
            let place = match welded.distance {
                0.0 => "at the place of another one".to_owned(),
                distance => format!("within {distance:.1e} of another one"),
            };
            let named = named(a, b);
            let why = match (tolerance, welded.distance) {
                (None, 0.0) => "weld = \"exact\" under [mesh] glues edges where both ends do",
                (None | Some(_), distance) if distance > tolerance.unwrap_or(0.0) => {
                    "a distance as `weld` under [mesh] glues edges where both ends do"
                }
                _ => "their faces would lie upon each other, meet the wrong way round, or be more than two at an edge",
            };
            sentences.push(format!("{count} boundary {vertices} {place}{named} and not welded to it: {why}"));
        }
        sentences
    }
}

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
                let face = crate::mesh::FaceId::new(face);
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
