//! Normals of faces and of vertices.

use glam::{DVec3, Vec3, Vec3A};
use rayon::prelude::*;

/// Faces whose angles are in memory at the same time.
const FACES_AT_A_TIME: usize = 1 << 18;

/// Unit normals at vertices, |V|: those of the faces around, weighted by their angles.
pub fn smooth_normals(faces: &[[u32; 3]], positions: &[DVec3]) -> Vec<Vec3> {
    vertex_normals(faces, &face_normals(faces, positions), positions).into_iter().map(Vec3::from).collect()
}

/// Unit normals of faces.
pub fn face_normals(faces: &[[u32; 3]], positions: &[DVec3]) -> Vec<Vec3A> {
    let normal = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|vertex| positions[vertex as usize]);
        (b - a).cross(c - a).normalize_or_zero().as_vec3a()
    };
    faces.par_iter().map(normal).collect()
}

/// Sum of the normals around a vertex, weighted by the corner angles.
pub fn vertex_normals(faces: &[[u32; 3]], face_normals: &[Vec3A], positions: &[DVec3]) -> Vec<Vec3A> {
    let angles = |corners: &[u32; 3]| {
        let points = corners.map(|vertex| positions[vertex as usize]);
        let edges = [0, 1, 2].map(|k| (points[(k + 1) % 3] - points[k]).normalize_or_zero().as_vec3a());
        [0, 1, 2].map(|k| angle(-edges[k].dot(edges[(k + 2) % 3])))
    };
    let mut sums = vec![Vec3A::ZERO; positions.len()];
    // Angles on all threads, sums in the order of the faces: the same bits on any number of threads.
    for first in (0..faces.len()).step_by(FACES_AT_A_TIME) {
        let part = first..(first + FACES_AT_A_TIME).min(faces.len());
        let angles: Vec<[f32; 3]> = faces[part.clone()].par_iter().map(angles).collect();
        for ((corners, normal), angles) in faces[part.clone()].iter().zip(&face_normals[part]).zip(angles) {
            for (&vertex, angle) in corners.iter().zip(angles) {
                sums[vertex as usize] += *normal * angle;
            }
        }
    }
    sums.par_iter().map(|sum| sum.normalize_or_zero()).collect()
}

/// The angle of a cosine to 7e-5, which is plenty for a weight (Abramowitz and Stegun 4.4.45).
fn angle(cosine: f32) -> f32 {
    let x = cosine.abs().min(1.0);
    let acute = (1.0 - x).sqrt() * (1.570_728_8 + x * (-0.212_114_4 + x * (0.074_261 - x * 0.018_729_3)));
    if cosine < 0.0 { std::f32::consts::PI - acute } else { acute }
}
