//! Polyhedra whose faces are cut into small flat triangles.

use std::collections::HashMap;

use glam::DVec3;

use super::limits::{at_least, face_count, finite, invalid};
use super::named_polyhedra::named;
use crate::mesh::{MeshError, Surface, polygon, repair};
use crate::scene::PolyhedronSource;

const SHAPE: &str = "polyhedron";

/// A polyhedron with every edge divided into `subdivisions` parts. Quadrilaterals are cut along a diagonal,
/// polygons of five or more sides into a fan around the mean of their corners (if that sees all sides, and else into
/// triangles between corners), and each of these triangles into `subdivisions²` similar ones. Explicit polygons are oriented and compacted by [`repair`].
///
/// # Errors
/// [`MeshError::Shape`] for an unknown name, no subdivisions, polygons with fewer than three corners or
/// unknown ones, or with an outline that crosses itself; what [`repair`] refuses.
pub fn polyhedron(source: &PolyhedronSource, subdivisions: usize) -> Result<Surface, MeshError> {
    at_least(SHAPE, "subdivisions", subdivisions, 1)?;
    let (mut corners, polygons) = match source {
        PolyhedronSource::Named(name) => named(name).ok_or_else(|| {
            invalid(
                SHAPE,
                format!("`{name}` is not known"),
                "choose tetrahedron, cube, octahedron, dodecahedron, icosahedron, genus_two or genus_two_saddle, \
                 or give `vertices` and `polygons`",
            )
        })?,
        PolyhedronSource::Explicit { vertices, polygons } => {
            finite(SHAPE, "vertices", vertices.as_flattened())?;
            (vertices.iter().map(|&v| DVec3::from(v)).collect(), polygons.clone())
        }
    };
    let mut triangles = Vec::new();
    for (n, polygon) in polygons.iter().enumerate() {
        if polygon.len() < 3 {
            return Err(invalid(SHAPE, format!("polygon {n} has {} corners", polygon.len()), "give it three or more"));
        }
        if let Some(v) = polygon.iter().find(|&&v| v >= corners.len()) {
            let reason = format!("polygon {n} names vertex {v}, and there are only {}", corners.len());
            return Err(invalid(SHAPE, reason, "vertices count from 0"));
        }
    }
    for (n, polygon) in polygons.iter().enumerate() {
        let polygon: Vec<u32> = polygon.iter().map(|&v| v as u32).collect();
        match middle(&polygon, &corners) {
            Some(point) if polygon.len() > 4 => {
                let center = corners.len() as u32;
                corners.push(point);
                triangles.extend((0..polygon.len()).map(|k| [center, polygon[k], polygon[(k + 1) % polygon.len()]]));
            }
            _ => polygon::cut(&polygon, Some(&corners), &mut triangles).map_err(|polygon::CrossesItself| {
                invalid(SHAPE, format!("the outline of polygon {n} crosses or touches itself"), "give it an inside")
            })?,
        }
    }
    let squared = (subdivisions as f64) * (subdivisions as f64);
    face_count(SHAPE, triangles.len() as f64 * squared, "lower `subdivisions`")?;
    let coarse = repair(corners.len(), &triangles)?;
    let corners: Vec<DVec3> = coarse.input_vertices.iter().map(|&v| corners[v]).collect();
    let (positions, faces) = subdivide(&corners, &coarse.mesh.triangles(), subdivisions);
    let mut surface = super::embedded(positions, &faces)?;
    surface.repairs = coarse.repairs;
    Ok(surface)
}

/// The mean of the corners of a polygon, if all sides are seen from there.
fn middle(polygon: &[u32], corners: &[DVec3]) -> Option<DVec3> {
    let points: Vec<DVec3> = polygon.iter().map(|&v| corners[v as usize]).collect();
    let center = points.iter().sum::<DVec3>() / points.len() as f64;
    let sides = || points.iter().zip(points.iter().cycle().skip(1)).map(|(&a, &b)| (a - center).cross(b - center));
    let normal: DVec3 = sides().sum();
    sides().all(|side| side.dot(normal) > 0.0).then_some(center)
}

/// Divides every edge into `n` equal parts and every triangle into `n²`. The corners keep their numbers.
pub(super) fn subdivide(corners: &[DVec3], triangles: &[[u32; 3]], n: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut positions = corners.to_vec();
    let mut faces = Vec::with_capacity(triangles.len() * n * n);
    // Per edge, from its smaller corner: the first of the n − 1 vertices inside it.
    let mut inside_edges: HashMap<[u32; 2], u32> = HashMap::new();
    for &[a, b, c] in triangles {
        let at = |i: usize, j: usize| {
            // Exact at the corners and the same from both sides of an edge.
            let k = n - i - j;
            let mut terms = [(a, k), (b, i), (c, j)];
            terms.sort_unstable();
            terms.iter().map(|&(v, weight)| corners[v as usize] * weight as f64).sum::<DVec3>() / n as f64
        };
        let mut on_edge = |from: u32, to: u32, step: usize| {
            let (key, step) = if from < to { ([from, to], step) } else { ([to, from], n - step) };
            let first = *inside_edges.entry(key).or_insert_with(|| {
                let first = positions.len() as u32;
                let [p, q] = key.map(|v| corners[v as usize]);
                positions.extend((1..n).map(|s| (p * (n - s) as f64 + q * s as f64) / n as f64));
                first
            });
            first + step as u32 - 1
        };
        // Vertex (i, j) is a + i/n (b − a) + j/n (c − a).
        let mut numbers = Vec::with_capacity((n + 1) * (n + 2) / 2);
        let mut interior = Vec::new();
        for j in 0..=n {
            for i in 0..=n - j {
                numbers.push(match (i, j) {
                    (0, 0) => a,
                    _ if i == n => b,
                    _ if j == n => c,
                    (_, 0) => on_edge(a, b, i),
                    (0, _) => on_edge(a, c, j),
                    _ if i + j == n => on_edge(b, c, j),
                    _ => {
                        interior.push((numbers.len(), at(i, j)));
                        0
                    }
                });
            }
        }
        for (slot, p) in interior {
            numbers[slot] = positions.len() as u32;
            positions.push(p);
        }
        let number = |i: usize, j: usize| numbers[j * (n + 1) - j * j.saturating_sub(1) / 2 + i];
        for j in 0..n {
            for i in 0..n - j {
                faces.push([number(i, j), number(i + 1, j), number(i, j + 1)]);
                if i + j + 1 < n {
                    faces.push([number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]);
                }
            }
        }
    }
    (positions, faces)
}
