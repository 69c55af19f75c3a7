//! The surface as the light sees it: view directions, unit size, in single precision.

use glam::{DVec3, Vec2, Vec3A};
use rayon::prelude::*;

use super::{
    normals::{face_normals, vertex_normals},
    project::Projection,
    sight::Sight,
};
use crate::render::{Camera, Field, Look, Output, Scenery};

/// The drawable part of a surface in stage space: axes as in view space, the origin in the middle of
/// what the camera frames, and the framed radius as the unit of length.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Shown triangles with finite corners and an area, without those that are wholly cut away.
    pub faces: Vec<[u32; 3]>,
    /// Which triangle of the scenery each of them is.
    pub triangles: Vec<u32>,
    /// One per vertex; those of vertices without a face mean nothing.
    pub positions: Vec<Vec3A>,
    /// Unit normals, angle-weighted.
    pub normals: Vec<Vec3A>,
    /// Pixel coordinates and depth, not a number for what is behind the eye.
    pub projected: Vec<DVec3>,
    /// Pixel coordinates alone.
    pub pixels: Vec<Vec2>,
    /// Unit normal of each face.
    pub face_normals: Vec<Vec3A>,
    /// Whether the eye sees the front of a face.
    pub shows_front: Vec<bool>,
    /// For each of the two fields of the pattern, its values at the corners of each face; empty without.
    pub along: [Vec<[f32; 3]>; 2],
    /// Faces that light cannot pass, all but those whose middle lies in a gap of the pattern.
    pub blocking: Vec<u32>,
    /// Triangles that were left out.
    pub skipped: usize,
    /// How world space is seen.
    pub projection: Projection,
    sight: Sight,
}

/// Coordinates beyond this many framed radii are left out: single precision holds nothing there.
const FARTHEST: f64 = 1e6;
/// Triangles thinner than this (height over length) have no normal.
const THINNEST: f64 = 1e-12;

impl Stage {
    pub fn new(scenery: &Scenery, camera: &Camera, look: &Look, output: &Output) -> Self {
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
                && (b - a).cross(c - a).length_squared() > THINNEST * THINNEST * longest * longest
        };
        let hidden = scenery.shown.iter().filter(|shown| !**shown).count();
        let mut triangles: Vec<u32> = (0..scenery.triangles.len())
            .into_par_iter()
            .filter(|&triangle| scenery.shown.get(triangle).copied().unwrap_or(true))
            .filter(|&triangle| usable(&scenery.triangles[triangle]))
            .map(|triangle| triangle as u32)
            .collect();
        let skipped = scenery.triangles.len() - hidden - triangles.len();
        let corners_of = |triangles: &[u32]| -> Vec<[u32; 3]> {
            triangles.par_iter().map(|&triangle| scenery.triangles[triangle as usize]).collect()
        };
        let mut faces = corners_of(&triangles);
        let mut face_normals = face_normals(&faces, &exact);
        // What is cut away still bends the normals at the cut.
        let normals = vertex_normals(&faces, &face_normals, &exact);
        if let Some(cut) = look.cut {
            let kept = |corners: &[u32; 3]| {
                corners.iter().any(|&vertex| scenery.positions[vertex as usize].dot(cut.normal) < cut.offset)
            };
            let kept: Vec<bool> = faces.par_iter().map(kept).collect();
            let mut flags = kept.iter();
            triangles.retain(|_| *flags.next().unwrap_or(&true));
            let mut flags = kept.iter();
            face_normals.retain(|_| *flags.next().unwrap_or(&true));
            faces = corners_of(&triangles);
        }

        let (eye, line_of_sight) = camera.view_ray(0.0, 0.0);
        let perspective = camera.is_perspective();
        let eye = ((eye - center) / radius).as_vec3a();
        let line_of_sight = line_of_sight.as_vec3a();
        let positions: Vec<Vec3A> = exact.par_iter().map(|position| position.as_vec3a()).collect();
        let shows_front = (faces.par_iter().zip(&face_normals))
            .map(|(corners, normal)| {
                let toward_eye = if perspective { eye - positions[corners[0] as usize] } else { -line_of_sight };
                normal.dot(toward_eye) > 0.0
            })
            .collect();
        let projection = Projection::new(camera, look, output);
        let projected: Vec<DVec3> =
            scenery.positions.par_iter().map(|&position| projection.projected(position)).collect();
        let at_corners = |field: Option<&Field>| match (field, look.pattern) {
            (Some(field), Some(_)) => triangles
                .par_iter()
                .zip(&faces)
                .map(|(&triangle, &corners)| field.at_corners(triangle as usize, corners))
                .collect(),
            _ => Vec::new(),
        };
        let along = scenery.along.map(at_corners);
        let is_blocking = |face: &u32| match (look.pattern, along[0].get(*face as usize)) {
            (Some(pattern), Some(values)) => !pattern.is_gap(f64::from(values.iter().sum::<f32>() / 3.0)),
            _ => true,
        };
        Self {
            blocking: (0..faces.len() as u32).into_par_iter().filter(is_blocking).collect(),
            pixels: projected.par_iter().map(|place| place.truncate().as_vec2()).collect(),
            along,
            sight: Sight::new(camera, output, |point| ((point - center) / radius).as_vec3a()),
            normals,
            positions,
            projected,
            face_normals,
            shows_front,
            skipped,
            projection,
            triangles,
            faces,
        }
    }

    /// Unit vector toward the eye and barycentric weights of the point of a face seen at a place in pixels.
    #[inline]
    pub fn sight(&self, face: usize, at: [f32; 2]) -> (Vec3A, [f32; 3]) {
        let (origin, direction) = self.ray(at);
        let weights = self.weights_along(face, origin, direction);
        if !weights.iter().all(|weight| weight.is_finite()) {
            return (-direction, [1.0 / 3.0; 3]);
        }
        let clamped = weights.map(|weight| weight.clamp(0.0, 1.0));
        let scale = 1.0 / (clamped[0] + clamped[1] + clamped[2]);
        (-direction, clamped.map(|weight| weight * scale))
    }

    /// Barycentric weights of the point of a face's plane seen at a place in pixels.
    pub fn weights_in_plane(&self, face: usize, at: [f32; 2]) -> [f32; 3] {
        let (origin, direction) = self.ray(at);
        self.weights_along(face, origin, direction)
    }

    /// Origin and unit direction of sight at a place in pixels.
    pub fn ray(&self, at: [f32; 2]) -> (Vec3A, Vec3A) {
        self.sight.ray(at)
    }

    /// Where a ray meets the plane of a face (Möller and Trumbore).
    fn weights_along(&self, face: usize, origin: Vec3A, direction: Vec3A) -> [f32; 3] {
        let [a, b, c] = self.faces[face].map(|vertex| self.positions[vertex as usize]);
        let (to_b, to_c, to_origin) = (b - a, c - a, origin - a);
        let across = direction.cross(to_c);
        let inverse = 1.0 / to_b.dot(across);
        let beta = to_origin.dot(across) * inverse;
        let gamma = direction.dot(to_origin.cross(to_b)) * inverse;
        [1.0 - beta - gamma, beta, gamma]
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
