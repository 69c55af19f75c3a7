//! From what a file says to a surface whose seams are welded.

use glam::DVec3;

use super::format::FileFormat;
use super::soup::Soup;
use crate::mesh::repair::{Repaired, Unrepairable, repair_welded};
use crate::mesh::weld::{Welded, small_distance, weld, weld_corners};
use crate::mesh::{Numbering, Surface, Weld};

impl Soup {
    /// Welds, orients and compacts.
    pub(super) fn surface(&self, format: FileFormat, how: Option<Weld>) -> Result<Surface, Unrepairable> {
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
                    (None, FileFormat::Stl) => Some(small_distance(&self.triangles, positions)),
                    // Sheets that are folded lie upon each other, and arrays say which vertices are one.
                    (None, FileFormat::Fold | FileFormat::Npz | FileFormat::Npy) => None,
                    (None | Some(Weld::Exact), _) => Some(0.0),
                };
                self.welded(format, positions, tolerance, &mut notes)?
            }
        };
        let Repaired { mesh, vertex_map, repairs, input_vertices } = repaired;
        let coordinates = self.coordinates.as_ref().filter(|all| positions.is_none() && all.len() == self.vertex_count);
        let coordinates = coordinates.map(|all| input_vertices.iter().map(|&v| all[v]).collect());
        notes.extend(repairs);
        let faces = (0..self.triangles.len()).map(|f| self.polygon(f) as u32).collect();
        let meant = match format {
            FileFormat::Stl => mesh.vertices().map(Some).collect(),
            _ => vertex_map,
        };
        let mesh = mesh.numbered(Numbering::new(meant, faces));
        Ok(Surface { mesh, positions, coordinates, edge_lengths: None, repairs: notes })
    }

    /// The mesh with its seams welded, and positions of its vertices.
    fn welded(
        &self,
        format: FileFormat,
        positions: &[DVec3],
        tolerance: Option<f64>,
        notes: &mut Vec<String>,
    ) -> Result<(Repaired, Option<Vec<DVec3>>), Unrepairable> {
        let finished = |triangles: &[[u32; 3]], positions: &[DVec3], first: &[u32]| {
            // What is out of range is told by the repair.
            let name = |v: u32| first.get(v as usize).copied().unwrap_or(v);
            let named: Vec<[u32; 3]> = triangles.iter().map(|face| face.map(name)).collect();
            let repaired = repair_welded(positions.len(), &named, first)?;
            let kept = repaired.input_vertices.iter().map(|&v| positions[v]).collect();
            Ok((repaired, Some(kept)))
        };
        match weld(&self.triangles, positions, tolerance) {
            Some(welded) => {
                let result = finished(&self.triangles, positions, &welded.first)?;
                notes.extend(self.sentences(format, tolerance, &welded));
                Ok(result)
            }
            None => {
                // Bodies that touch share corners in STL files, and jitter leaves others alone. Taken apart they may weld.
                if let (FileFormat::Stl, Some(tolerance)) = (format, tolerance) {
                    let corners: Vec<DVec3> = self.triangles.iter().flatten().map(|&v| positions[v as usize]).collect();
                    let apart: Vec<[u32; 3]> =
                        (0..self.triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
                    if let Some(welded) = weld_corners(&corners, tolerance) {
                        let (repaired, kept) = finished(&apart, &corners, &welded.first)?;
                        let (before, after) = (positions.len(), repaired.mesh.vertex_count());
                        notes.push(format!(
                            "welded the corners of {} triangles along their edges, so that {before} different points \
                             became {after} vertices and bodies that touch stay apart",
                            self.triangles.len()
                        ));
                        return Ok((repaired, kept));
                    }
                }
                let alone: Vec<u32> = (0..self.vertex_count as u32).collect();
                finished(&self.triangles, positions, &alone)
            }
        }
    }

    /// What was welded, and what might have been.
    fn sentences(&self, format: FileFormat, tolerance: Option<f64>, welded: &Welded) -> Vec<String> {
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
            FileFormat::Stl => String::new(),
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
