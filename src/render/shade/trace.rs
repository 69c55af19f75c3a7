//! Rays against the surface.

use std::time::Duration;

use glam::Vec3A;
use obvhs::{
    BvhBuildParams,
    cwbvh::{CwBvh, builder::build_cwbvh_from_tris},
    ray::{Ray, RayHit},
    triangle::Triangle,
};

use super::stage::Stage;

/// The triangles of the stage in a tree.
pub struct Occluder {
    tree: Option<CwBvh>,
    /// In the order of the tree's leaves.
    triangles: Vec<Triangle>,
}

impl Occluder {
    pub fn new(stage: &Stage) -> Self {
        let triangles: Vec<Triangle> = stage
            .blocking
            .iter()
            .map(|&face| {
                let [v0, v1, v2] = stage.faces[face as usize].map(|vertex| stage.positions[vertex as usize]);
                Triangle { v0, v1, v2 }
            })
            .collect();
        if triangles.is_empty() {
            return Self::none();
        }
        let tree = build_cwbvh_from_tris(&triangles, BvhBuildParams::fast_build(), &mut Duration::default());
        let triangles = tree.primitive_indices.iter().map(|&index| triangles[index as usize]).collect();
        Self { tree: Some(tree), triangles }
    }

    /// Nothing in the way.
    pub fn none() -> Self {
        Self { tree: None, triangles: Vec::new() }
    }

    /// Distance to the first triangle within `reach`.
    pub fn distance(&self, origin: Vec3A, direction: Vec3A, reach: f32) -> Option<f32> {
        let mut hit = RayHit::none();
        let ray = Ray::new(origin, direction, 0.0, reach);
        let found = self.tree.as_ref()?.ray_traverse(ray, &mut hit, |ray, index| self.triangles[index].intersect(ray));
        found.then_some(hit.t)
    }

    /// Whether anything lies in this direction.
    pub fn blocks(&self, origin: Vec3A, direction: Vec3A) -> bool {
        let Some(tree) = &self.tree else { return false };
        let ray = Ray::new(origin, direction, 0.0, f32::MAX);
        !tree.ray_traverse_miss(ray, |ray, index| self.triangles[index].intersect(ray))
    }
}

/// Two unit vectors that make a right-handed frame with a unit normal (Duff et al. 2017).
pub fn tangents(normal: Vec3A) -> [Vec3A; 2] {
    let sign = 1.0_f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    [
        Vec3A::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vec3A::new(b, sign + normal.y * normal.y * a, -normal.y),
    ]
}

/// Points spread evenly over the unit disk along a spiral.
pub fn disk_points(count: usize) -> Vec<[f32; 2]> {
    (0..count)
        .map(|index| {
            let radius = ((index as f32 + 0.5) / count as f32).sqrt();
            let angle = index as f32 * std::f32::consts::PI * (3.0 - 5.0_f32.sqrt());
            [radius * libm::cosf(angle), radius * libm::sinf(angle)]
        })
        .collect()
}

/// Cosine and sine of an angle that differs from vertex to vertex without any pattern.
pub fn scrambled_turn(seed: u32) -> [f32; 2] {
    let mut hash = seed.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B;
    hash = (hash ^ (hash >> 16)).wrapping_mul(0x7FEB_352D);
    hash = (hash ^ (hash >> 15)).wrapping_mul(0x846C_A68B);
    let angle = (hash ^ (hash >> 16)) as f32 / u32::MAX as f32 * std::f32::consts::TAU;
    [libm::cosf(angle), libm::sinf(angle)]
}

/// Turns a point of the disk.
pub fn turned([x, y]: [f32; 2], [cos, sin]: [f32; 2]) -> [f32; 2] {
    [x * cos - y * sin, x * sin + y * cos]
}
