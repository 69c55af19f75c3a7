//! The shadow of a surface on the ground below it.

use glam::{DVec3, Vec3A, Vec4};
use rayon::prelude::*;

use super::{
    directions::{disk_points, scrambled_turn, tangents, turned},
    shader::Shader,
    trace::Occluder,
};
use crate::render::{Picture, Plane};

/// Texels along a side of the square in which darkness is known.
const SIDE: usize = 144;
/// Half the side of that square in framed radii.
const REACH: f32 = 2.4;
/// Rays toward the light, and as many to the sky.
const RAYS: usize = 32;
/// Radius of the light, as the tangent of the angle it is seen under: softer than on the surface.
const LIGHT_RADIUS: f32 = 0.22;
/// Lights lower than this (sine) are raised, so that shadows stay near.
const LOWEST: f32 = 0.5;
/// How far something darkens the ground by hiding the sky, in framed radii.
const SKY_REACH: f32 = 1.2;
/// Shares of the light that the key and the sky give.
const KEY_SHARE: f32 = 0.55;
const SKY_SHARE: f32 = 0.75;

/// Darkness on a square of the ground, sampled on a grid.
struct Ground {
    origin: Vec3A,
    normal: Vec3A,
    axes: [Vec3A; 2],
    darkness: Vec<f32>,
}

/// Darkens the background of a picture where the surface throws a shadow on a plane below it (of the world; its
/// normal points up). Nothing happens if the eye is below the plane.
pub fn draw_ground_shadow(picture: &mut Picture, plane: Plane, shader: &Shader) {
    let strength = shader.look.ground_shadow;
    let Some(ground) = Ground::new(plane, shader) else { return };
    let (width, [left, top]) = (picture.width, picture.corner);
    picture.beauty.par_iter_mut().enumerate().with_min_len(4096).for_each(|(index, pixel)| {
        if pixel.w < 1.0 {
            let (origin, direction) =
                shader.stage.ray([(left + index % width) as f32 + 0.5, (top + index / width) as f32 + 0.5]);
            let darkness = strength * ground.darkness_along(origin, direction);
            *pixel += Vec4::W * ((1.0 - pixel.w) * darkness);
        }
    });
}

impl Ground {
    fn new(plane: Plane, shader: &Shader) -> Option<Self> {
        let (center, radius) = shader.camera.subject();
        let foot: DVec3 = center - plane.normal * (plane.normal.dot(center) - plane.offset);
        let view_from_world = shader.camera.view_from_world();
        // Stage space has its origin in the middle of what is framed, and the framed radius as its unit.
        let origin = (view_from_world.matrix3 * (foot - center) / radius).as_vec3a();
        let normal = (view_from_world.matrix3 * plane.normal).as_vec3a().normalize();
        let (eye, sight) = shader.stage.ray([shader.output.width() as f32 / 2.0, shader.output.height() as f32 / 2.0]);
        if shader.stage.faces.is_empty() || (eye - origin).dot(normal) <= 0.0 && sight.dot(normal) >= 0.0 {
            return None;
        }
        let occluder = shader.visibility.occluder();
        let axes = tangents(normal);
        let mut ground = Self { origin, normal, axes, darkness: Vec::new() };
        let key = shader.lights.all().iter().find(|light| light.casts_shadow()).map(|light| {
            let rise = light.direction().dot(normal);
            (light.direction() + normal * (LOWEST - rise).max(0.0)).normalize()
        });
        let points = disk_points(RAYS);
        let darkness: Vec<f32> = (0..SIDE * SIDE)
            .into_par_iter()
            .with_min_len(SIDE)
            .map(|texel| ground.darkness_of(texel, occluder, key, &points))
            .collect();
        ground.darkness = blurred(&blurred(&darkness));
        Some(ground)
    }

    fn darkness_of(&self, texel: usize, occluder: &Occluder, key: Option<Vec3A>, points: &[[f32; 2]]) -> f32 {
        let place = |index: usize| ((index as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0) * REACH;
        let (x, y) = (place(texel % SIDE), place(texel / SIDE));
        // Nothing is left of the shadow at the border of the square.
        let away = (x * x + y * y).sqrt() / REACH;
        if away >= 1.0 {
            return 0.0;
        }
        let point = self.origin + self.axes[0] * x + self.axes[1] * y + self.normal * 1e-3;
        let turn = scrambled_turn(texel as u32);
        let mean =
            |of: &dyn Fn([f32; 2]) -> f32| points.iter().map(|&p| of(turned(p, turn))).sum::<f32>() / RAYS as f32;
        let sky = mean(&|[x, y]| {
            let height = (1.0 - x * x - y * y).max(0.0).sqrt();
            let direction = (self.axes[0] * x + self.axes[1] * y + self.normal * height).normalize();
            occluder.distance(point, direction, SKY_REACH).map_or(0.0, |far| (1.0 - far / SKY_REACH).max(0.0))
        });
        let key = key.map_or(0.0, |toward| {
            let [right, up] = tangents(toward);
            mean(&|[x, y]| {
                let direction = (toward + (right * x + up * y) * LIGHT_RADIUS).normalize();
                f32::from(occluder.blocks(point, direction))
            })
        });
        let fade = ((1.0 - away) / 0.35).clamp(0.0, 1.0);
        (1.0 - (1.0 - KEY_SHARE * key) * (1.0 - SKY_SHARE * sky)) * fade * fade * (3.0 - 2.0 * fade)
    }

    fn darkness_along(&self, origin: Vec3A, direction: Vec3A) -> f32 {
        let far = (self.origin - origin).dot(self.normal) / direction.dot(self.normal);
        if !far.is_finite() || far <= 0.0 {
            return 0.0;
        }
        let offset = origin + direction * far - self.origin;
        let place = self.axes.map(|axis| (offset.dot(axis) / REACH * 0.5 + 0.5) * SIDE as f32 - 0.5);
        if place.iter().any(|&value| !(0.0..(SIDE - 1) as f32).contains(&value)) {
            return 0.0;
        }
        let [column, row] = place.map(|value| value as usize);
        let [across, down] = [place[0] - column as f32, place[1] - row as f32];
        let at = |column: usize, row: usize| self.darkness[row * SIDE + column];
        let upper = at(column, row) * (1.0 - across) + at(column + 1, row) * across;
        let lower = at(column, row + 1) * (1.0 - across) + at(column + 1, row + 1) * across;
        upper * (1.0 - down) + lower * down
    }
}

/// Each texel with its eight neighbours, weighted 1 2 1 both ways.
fn blurred(values: &[f32]) -> Vec<f32> {
    let at = |column: usize, row: usize| values[row.min(SIDE - 1) * SIDE + column.min(SIDE - 1)];
    let smoothed = |texel: usize| {
        let (column, row) = (texel % SIDE, texel / SIDE);
        let line = |row: usize| at(column.saturating_sub(1), row) + 2.0 * at(column, row) + at(column + 1, row);
        (line(row.saturating_sub(1)) + 2.0 * line(row) + line(row + 1)) / 16.0
    };
    (0..SIDE * SIDE).map(smoothed).collect()
}
