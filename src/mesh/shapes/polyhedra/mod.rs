//! Polyhedra whose faces are cut into small flat triangles.

mod named;
mod subdivide;

use glam::DVec3;

use super::error::ShapeFault;
use super::limits::{LEAST_SUBDIVISIONS, at_least, face_count, finite, invalid};
use super::shape::PolyhedronSource;
use crate::mesh::limits::check_size;
use crate::mesh::{MeshError, Surface, polygon, repair};
use named::named;

pub(super) use named::icosahedron;
pub use named::names;
pub(super) use subdivide::subdivide;

const SHAPE: &str = "polyhedron";

/// A polyhedron with every edge divided into `subdivisions` parts.
///
/// Quadrilaterals are cut along a diagonal. Polygons of five or more sides are cut into a fan around the mean of their
/// corners if all sides are seen from there, and otherwise into triangles between corners. Each of these triangles is
/// cut into `subdivisions²` similar ones. Explicit polygons are oriented and compacted by [`repair`].
///
/// # Errors
/// [`MeshError::Shape`] for an unknown name, no subdivisions, and polygons with fewer than three corners, with unknown
/// corners or with an outline that crosses itself. Other errors are those of [`repair`].
pub fn polyhedron(source: &PolyhedronSource, subdivisions: usize) -> Result<Surface, MeshError> {
    at_least(SHAPE, "subdivisions", subdivisions, LEAST_SUBDIVISIONS)?;
    let (mut corners, polygons) = match source {
        PolyhedronSource::Named(name) => named(name).ok_or_else(|| {
            let fault = ShapeFault::UnknownName { name: name.clone(), known: names().collect() };
            invalid(SHAPE, "name", fault)
        })?,
        PolyhedronSource::Explicit { vertices, polygons } => {
            finite(SHAPE, "vertices", vertices.as_flattened())?;
            (vertices.iter().map(|&v| DVec3::from(v)).collect(), polygons.clone())
        }
    };
    let mut triangles = Vec::new();
    for (n, polygon) in polygons.iter().enumerate() {
        let invalid = |fault| invalid(SHAPE, "polygons", fault);
        if polygon.len() < 3 {
            return Err(invalid(ShapeFault::TooFewCorners { polygon: n, corners: polygon.len() }).into());
        }
        if let Some(&vertex) = polygon.iter().find(|&&v| v >= corners.len()) {
            return Err(invalid(ShapeFault::UnknownCorner { polygon: n, vertex, vertices: corners.len() }).into());
        }
    }
    // Every polygon may be given a middle.
    check_size(corners.len().saturating_add(polygons.len()), polygons.len())?;
    for (n, polygon) in polygons.iter().enumerate() {
        let polygon: Vec<u32> = polygon.iter().map(|&v| v as u32).collect();
        match middle(&polygon, &corners) {
            Some(point) if polygon.len() > 4 => {
                let center = corners.len() as u32;
                corners.push(point);
                triangles.extend((0..polygon.len()).map(|k| [center, polygon[k], polygon[(k + 1) % polygon.len()]]));
            }
            _ => polygon::cut(&polygon, Some(&corners), &mut triangles).map_err(|polygon::CrossesItself| {
                invalid(SHAPE, "polygons", ShapeFault::CrossesItself { polygon: n })
            })?,
        }
    }
    let squared = (subdivisions as f64) * (subdivisions as f64);
    face_count(SHAPE, "subdivisions", triangles.len() as f64 * squared, "lower `subdivisions`")?;
    let coarse = repair(corners.len(), &triangles)?;
    let corners: Vec<DVec3> = coarse.input_vertices.iter().map(|&v| corners[v]).collect();
    let (positions, faces) = subdivide(&corners, &coarse.mesh.triangles(), subdivisions);
    let mut surface = Surface::from_positions(positions, &faces)?;
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
