//! Disks of constant negative curvature.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::editable::Editable;
use super::error::ShapeFault;
use super::limits::{LEAST_DISK_FACES, at_least, face_count, invalid, positive};
use crate::mesh::{Mesh, MeshError, Surface};

const SHAPE: &str = "hyperbolic_disk";
/// Rounds of smoothing and flips. They raise the mean of the triangles' smallest angles from 49 to 53 degrees
/// (and lower the very smallest from 40 to 34); more rounds add less than half a degree.
const ROUNDS: usize = 5;

/// A disk of geodesic `radius` in the plane of constant `curvature` < 0, with about `faces` well-shaped
/// triangles of equal size. It has the geodesic distances as edge lengths, no positions, and coordinates in the
/// Poincaré disk, where the centre is the origin and the whole plane the unit disk.
///
/// Vertex 0 is near the centre; the boundary vertices are the last ones, counterclockwise.
///
/// # Errors
/// [`MeshError::Shape`] for a curvature that is not negative, a radius that is not positive or more than
/// 20 / √−curvature, fewer than 6 faces, too many faces, or so few that edges would be longer than the
/// curvature allows.
pub fn hyperbolic_disk(curvature: f64, radius: f64, faces: usize) -> Result<Surface, MeshError> {
    if !(curvature.is_finite() && curvature < 0.0) {
        return Err(invalid(SHAPE, "curvature", ShapeFault::NotNegative(curvature)).into());
    }
    positive(SHAPE, "radius", radius)?;
    at_least(SHAPE, "faces", faces, LEAST_DISK_FACES)?;
    face_count(SHAPE, "faces", faces as f64, "lower `faces`")?;
    let unit = 1.0 / (-curvature).sqrt();
    let r = radius / unit;
    if !(1e-6..=20.0).contains(&r) {
        return Err(invalid(SHAPE, "radius", ShapeFault::RadiusOutOfRange(r)).into());
    }
    // Area of an equilateral triangle of edge h, nearly flat: √3/4 h².
    let area = 4.0 * PI * libm::pow(libm::sinh(r / 2.0), 2.0);
    let h = (area / faces as f64 / (3f64.sqrt() / 4.0)).sqrt();
    if h > 1.0 {
        let least = (area / (3f64.sqrt() / 4.0)).ceil();
        return Err(invalid(SHAPE, "faces", ShapeFault::TooCoarse { faces, edge: h, least }).into());
    }
    let rings = concentric_rings(r, h);
    let mut triangles = stitched(&rings);
    let mut points: Vec<Point> = rings.iter().flat_map(|ring| ring.points()).collect();
    let interior = points.len() - rings.last().map_or(0, |ring| ring.count);
    relax(&mut points, interior, &mut triangles);

    let mesh = Mesh::from_faces(points.len(), &triangles)?;
    let edge_lengths = mesh
        .edges()
        .map(|e| {
            let [u, v] = mesh.edge_vertices(e);
            unit * distance(points[u.index()], points[v.index()])
        })
        .collect();
    // Stereographic projection to the Poincaré disk.
    let coordinates = Some(points.iter().map(|p| DVec3::new(p.x, p.y, 0.0) / (1.0 + p.z)).collect());
    Ok(Surface { mesh, positions: None, coordinates, edge_lengths: Some(edge_lengths), repairs: Vec::new() })
}

/// A point of the hyperboloid `z² = 1 + x² + y²`, `z` > 0; the centre of the disk is (0, 0, 1).
type Point = DVec3;

fn minkowski(p: DVec3, q: DVec3) -> f64 {
    p.z * q.z - p.x * q.x - p.y * q.y
}

/// Geodesic distance, without the cancellation of `acosh(minkowski)` for near points: in polar
/// coordinates, `sinh²(d/2) = sinh²((r − s)/2) + sinh r sinh s sin²(angle/2)`.
fn distance(p: Point, q: Point) -> f64 {
    let (sinh_r, sinh_s) = (libm::hypot(p.x, p.y), libm::hypot(q.x, q.y));
    let radial = libm::sinh(0.5 * (libm::asinh(sinh_r) - libm::asinh(sinh_s)));
    let angle = libm::atan2(p.x * q.y - p.y * q.x, p.x * q.x + p.y * q.y);
    let across = libm::sin(0.5 * angle);
    2.0 * libm::asinh((radial * radial + sinh_r * sinh_s * across * across).sqrt())
}

/// Equally spaced points at one distance from the centre.
struct Ring {
    distance: f64,
    count: usize,
    /// Where the first one is, as a share of the spacing.
    shift: f64,
}

impl Ring {
    fn angle(&self, k: usize) -> f64 {
        (k as f64 + self.shift) / self.count as f64
    }

    fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let (sinh, cosh) = (libm::sinh(self.distance), libm::cosh(self.distance));
        (0..self.count).map(move |k| {
            let (sin, cos) = libm::sincos(TAU * self.angle(k));
            DVec3::new(sinh * cos, sinh * sin, cosh)
        })
    }
}

fn concentric_rings(radius: f64, h: f64) -> Vec<Ring> {
    let count = (radius / (h * 3f64.sqrt() / 2.0)).round().max(1.0) as usize;
    let mut rings = vec![Ring { distance: 0.0, count: 1, shift: 0.0 }];
    for k in 1..=count {
        let distance = radius * k as f64 / count as f64;
        let around = (TAU * libm::sinh(distance) / h).round().max(6.0);
        rings.push(Ring { distance, count: around as usize, shift: 0.5 * (k % 2) as f64 });
    }
    rings
}

/// Joins neighbouring rings, always advancing on the ring whose next vertex comes first.
fn stitched(rings: &[Ring]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    let mut start = 0;
    for pair in rings.windows(2) {
        let (inner, outer) = (&pair[0], &pair[1]);
        let inside = |k: usize| (start + k % inner.count) as u32;
        let outside = |k: usize| (start + inner.count + k % outer.count) as u32;
        let inner_steps = if inner.count == 1 { 0 } else { inner.count };
        let (mut i, mut o) = (0, 0);
        while i < inner_steps || o < outer.count {
            let outer_first = inner.angle(i) + inner.angle(i + 1) >= outer.angle(o) + outer.angle(o + 1);
            if o < outer.count && (i == inner_steps || outer_first) {
                triangles.push([inside(i), outside(o), outside(o + 1)]);
                o += 1;
            } else {
                triangles.push([inside(i), outside(o), inside(i + 1)]);
                i += 1;
            }
        }
        start += inner.count;
    }
    triangles
}

/// Alternates Delaunay flips with moving each interior point to the area-weighted mean of the centroids
/// of its triangles. The boundary stays.
fn relax(points: &mut [Point], interior: usize, triangles: &mut Vec<[u32; 3]>) {
    let mut mesh = Editable::new(points.len(), triangles);
    flip_to_delaunay(&mut mesh, points);
    for _ in 0..ROUNDS {
        for v in 0..interior {
            let mut sum = DVec3::ZERO;
            for [a, b, c] in mesh.star(v as u32) {
                let (p, q, r) = (points[a as usize], points[b as usize], points[c as usize]);
                sum += triangle_area(p, q, r) * (p + q + r);
            }
            points[v] = sum / minkowski(sum, sum).sqrt();
        }
        flip_to_delaunay(&mut mesh, points);
    }
    *triangles = mesh.triangles();
}

fn flip_to_delaunay(mesh: &mut Editable, points: &[Point]) {
    let at = |v: u32| points[v as usize];
    // Lengths of geodesics are not quite those of a flat triangulation, so flips could go round in circles.
    const PASSES: usize = 10;
    for _ in 0..PASSES {
        let mut flips = 0;
        for [u, v] in mesh.edges() {
            let Some(diamond) = mesh.diamond(u, v) else { continue };
            let opposite: f64 = diamond.opposite.iter().map(|&w| angle(at(w), at(u), at(v))).sum();
            if opposite > PI + 1e-3 && mesh.can_flip(&diamond) {
                mesh.flip(&diamond);
                flips += 1;
            }
        }
        if flips == 0 {
            break;
        }
    }
}

/// Area of the flat triangle with the geodesic lengths.
fn triangle_area(p: Point, q: Point, r: Point) -> f64 {
    let (a, b, c) = (distance(p, q), distance(q, r), distance(r, p));
    let s = 0.5 * (a + b + c);
    (s * (s - a) * (s - b) * (s - c)).max(0.0).sqrt()
}

/// Angle at `p` of the flat triangle with the geodesic lengths.
fn angle(p: Point, q: Point, r: Point) -> f64 {
    let (a, b, c) = (distance(q, r), distance(p, q), distance(p, r));
    libm::acos(((b * b + c * c - a * a) / (2.0 * b * c)).clamp(-1.0, 1.0))
}
