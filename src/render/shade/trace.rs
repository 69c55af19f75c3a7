//! Rays against the surface.

use std::time::Duration;

use glam::Vec3A;
use obvhs::{
    BvhBuildParams,
    cwbvh::{CwBvh, builder::build_cwbvh_from_tris},
    ray::{Ray, RayHit},
    triangle::Triangle,
};

use crate::render::stage::Stage;

/// Rays start this far above the surface, in framed radii.
pub const LIFT: f32 = 1e-3;

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
