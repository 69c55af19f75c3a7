//! What is known of each pixel besides its colour.

use glam::{DVec3, Vec2, Vec3, Vec3A};

use super::shader::Shader;
use crate::render::{
    Layers,
    raster::{FIRST_TUBE, NOTHING, Seen},
};

/// Layers in the making, row by row.
pub struct LayerBuilder<'a> {
    shader: &'a Shader<'a>,
    layers: Layers,
}

impl<'a> LayerBuilder<'a> {
    pub fn new(shader: &'a Shader) -> Self {
        let fields = shader.scenery.fields.iter().map(|field| (field.name.clone(), Vec::new())).collect();
        Self { shader, layers: Layers { fields, ..Layers::default() } }
    }

    /// Adds the pixels of a row that begins at x, y.
    pub fn push_row(&mut self, [first, y]: [usize; 2], row: &[Seen]) {
        for (x, seen) in (first..).zip(row) {
            if seen.id < FIRST_TUBE {
                self.push_surface(seen.id as usize, [x as f32 + 0.5, y as f32 + 0.5]);
                continue;
            }
            let distance = match seen.id {
                NOTHING => f32::INFINITY,
                _ => self.shader.camera.distance(f64::from(seen.depth)) as f32,
            };
            self.push_no_surface(distance);
        }
    }

    fn push_surface(&mut self, face: usize, at: [f32; 2]) {
        let Shader { scenery, stage, .. } = *self.shader;
        let (_, weights) = stage.sight(face, at);
        let corners = stage.faces[face];
        let triangle = stage.triangles[face] as usize;
        let side = usize::from(!stage.shows_front[face]);
        let mixed =
            |points: &[DVec3]| -> DVec3 { (0..3).map(|k| points[corners[k] as usize] * f64::from(weights[k])).sum() };
        let position = mixed(scenery.positions);
        let view_normal: Vec3A = (0..3).map(|k| stage.normals[corners[k] as usize] * weights[k]).sum();
        let view_normal = view_normal.normalize_or(stage.face_normals[face]);
        let view_from_world = self.shader.camera.view_from_world();
        let world_from_view = view_from_world.matrix3.transpose();
        let normal = (world_from_view * Vec3::from(view_normal).as_dvec3()).as_vec3();
        let motion = if scenery.next_positions.is_empty() {
            Vec2::ZERO
        } else {
            let pixel = |point: DVec3| stage.projection.pixel(stage.projection.clip(point)).truncate();
            let motion = (pixel(mixed(scenery.next_positions)) - pixel(position)).as_vec2();
            if motion.is_finite() { motion } else { Vec2::ZERO }
        };
        let layers = &mut self.layers;
        layers.depth.push(-view_from_world.transform_point3(position).z as f32);
        layers.normals.push(normal);
        layers.positions.push(position.as_vec3());
        layers.face_ids.push(triangle as u32);
        layers.sides.push(if side == 0 { 1.0 } else { -1.0 });
        layers.motion.push(motion);
        layers.occlusion.push(self.shader.visibility.sky_seen(side, corners, weights));
        for ((_, values), field) in layers.fields.iter_mut().zip(scenery.fields) {
            let at_corners = field.at_corners(triangle, corners);
            values.push((0..3).map(|k| at_corners[k] * weights[k]).sum());
        }
    }

    fn push_no_surface(&mut self, distance: f32) {
        let layers = &mut self.layers;
        layers.depth.push(distance);
        layers.normals.push(Vec3::ZERO);
        layers.positions.push(Vec3::ZERO);
        layers.face_ids.push(u32::MAX);
        layers.sides.push(0.0);
        layers.motion.push(Vec2::ZERO);
        layers.occlusion.push(1.0);
        layers.fields.iter_mut().for_each(|(_, values)| values.push(f32::NAN));
    }

    pub fn finish(self) -> Layers {
        self.layers
    }
}
