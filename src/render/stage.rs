//! The surface as the light sees it: view directions, unit size, in single precision.

use glam::{DVec3, Vec2, Vec3A};
use rayon::prelude::*;

use super::{Camera, Output, Scenery, project::Projection};

/// The drawable part of a surface in stage space: axes as in view space, the origin in the middle of
/// what the camera frames, and the framed radius as the unit of length.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Shown triangles with finite corners and an area.
    pub faces: Vec<[u32; 3]>,
    /// Which triangle of the scenery each of them is.
    pub triangles: Vec<u32>,
    /// One per vertex; those of vertices without a face mean nothing.
    pub positions: Vec<Vec3A>,
    /// Unit normals, angle-weighted.
    pub normals: Vec<Vec3A>,
    /// Pixel coordinates, not a number for what is behind the eye.
    pub pixels: Vec<Vec2>,
    /// Unit normal of each face.
    pub face_normals: Vec<Vec3A>,
    /// Whether the eye sees the front of a face.
    pub shows_front: Vec<bool>,
    /// Triangles that were left out.
    pub skipped: usize,
    /// The view's origin and scale in stage space.
    center: DVec3,
    radius: f64,
}

/// Coordinates beyond this many framed radii are left out: single precision holds nothing there.
const FARTHEST: f64 = 1e6;
/// Triangles thinner than this (height over length) have no normal.
const THINNEST: f64 = 1e-12;

impl Stage {
    pub fn new(scenery: &Scenery, camera: &Camera, output: &Output) -> Self {
        let (center_in_world, radius) = camera.subject();
        let view_from_world = camera.view_from_world();
        let center = view_from_world.transform_point3(center_in_world);
        let exact: Vec<DVec3> = scenery
            .positions
            .par_iter()
            .map(|&position| (view_from_world.transform_point3(position) - center) / radius)
            .collect();
        let usable = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|vertex| exact[vertex as usize]);
            let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
            [a, b, c].iter().all(|corner| corner.is_finite() && corner.abs().max_element() < FARTHEST)
                && (b - a).cross(c - a).length() > THINNEST * longest
        };
        let shown = |triangle: &usize| scenery.shown.get(*triangle).copied().unwrap_or(true);
        let candidates = (0..scenery.triangles.len()).into_par_iter().filter(shown);
        let hidden = scenery.shown.iter().filter(|shown| !**shown).count();
        let triangles: Vec<u32> = candidates
            .filter(|&triangle| usable(&scenery.triangles[triangle]))
            .map(|triangle| triangle as u32)
            .collect();
        let faces: Vec<[u32; 3]> = triangles.iter().map(|&triangle| scenery.triangles[triangle as usize]).collect();

        let (eye, sight) = camera.view_ray(0.0, 0.0);
        let perspective = camera.is_perspective();
        let eye = (eye - center) / radius;
        let face_normals: Vec<DVec3> = faces
            .par_iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|vertex| exact[vertex as usize]);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        let shows_front = faces
            .par_iter()
            .zip(&face_normals)
            .map(|(corners, normal)| {
                let toward_eye = if perspective { eye - exact[corners[0] as usize] } else { -sight };
                normal.dot(toward_eye) > 0.0
            })
            .collect();
        let projection = Projection::new(camera, output);
        let pixels = scenery.positions.par_iter().map(|&position| {
            let clip = projection.clip(position);
            if clip.w > 0.0 && clip.z <= clip.w { projection.pixel(clip).truncate().as_vec2() } else { Vec2::NAN }
        });
        Self {
            normals: vertex_normals(&faces, &face_normals, &exact),
            positions: exact.iter().map(|position| position.as_vec3a()).collect(),
            pixels: pixels.collect(),
            face_normals: face_normals.iter().map(|normal| normal.as_vec3a()).collect(),
            shows_front,
            skipped: scenery.triangles.len() - hidden - faces.len(),
            triangles,
            faces,
            center,
            radius,
        }
    }

    /// A point of view space in stage space.
    pub fn of_view(&self, point: DVec3) -> Vec3A {
        ((point - self.center) / self.radius).as_vec3a()
    }

    /// Whether a vertex is a corner of a face whose front, and one whose back, the eye sees.
    pub fn sides_seen(&self) -> Vec<[bool; 2]> {
        let mut seen = vec![[false; 2]; self.positions.len()];
        for (corners, &front) in self.faces.iter().zip(&self.shows_front) {
            for &vertex in corners {
                seen[vertex as usize][usize::from(!front)] = true;
            }
        }
        seen
    }
}

/// Sum of the normals around a vertex, weighted by the corner angles.
fn vertex_normals(faces: &[[u32; 3]], face_normals: &[DVec3], positions: &[DVec3]) -> Vec<Vec3A> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    for (corners, &normal) in faces.iter().zip(face_normals) {
        let points = corners.map(|vertex| positions[vertex as usize]);
        for k in 0..3 {
            let to_next = (points[(k + 1) % 3] - points[k]).normalize_or_zero();
            let to_previous = (points[(k + 2) % 3] - points[k]).normalize_or_zero();
            sums[corners[k] as usize] += normal * libm::acos(to_next.dot(to_previous).clamp(-1.0, 1.0));
        }
    }
    sums.iter().map(|sum| sum.normalize_or_zero().as_vec3a()).collect()
}
