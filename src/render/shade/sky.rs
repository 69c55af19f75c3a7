//! How much of the sky each vertex sees.

use glam::Vec3A;
use rayon::prelude::*;

use super::{
    directions::{disk_points, scrambled_turn, side_normal, tangents, turned},
    trace::{LIFT, Occluder},
};
use crate::render::stage::Stage;

/// Rays per vertex and side toward the sky. Dense meshes have fewer, because neighbours help there.
const SKY_RAYS: std::ops::RangeInclusive<usize> = 12..=96;
/// About as many rays as are sent from all vertices together.
const SKY_RAY_BUDGET: usize = 2_500_000;
/// Averaging over neighbours removes what noise is left: this many times with all rays, more often with
/// fewer.
const SKY_SMOOTHING: usize = 2;
/// Rays and smoothing where both sides of a whole film are wanted.
const FEW_RAYS: usize = 8;
const FEW_RAYS_SMOOTHING: usize = 8;

/// The share of the sky that each vertex sees on one side (0 front, 1 back), within reach of occluders.
pub fn sky_per_vertex(stage: &Stage, occluder: &Occluder, seen: &[[bool; 2]], side: usize, reach: f32) -> Vec<f32> {
    let wanted = seen.iter().filter(|sides| sides[side]).count().max(1);
    let rays = (SKY_RAY_BUDGET / wanted).clamp(*SKY_RAYS.start(), *SKY_RAYS.end());
    let sky = sky_of_rays(stage, occluder, |vertex| seen[vertex][side], side, reach, rays);
    let is_seen = |face: usize| usize::from(!stage.shows_front[face]) == side;
    (0..SKY_SMOOTHING * SKY_RAYS.end() / rays).fold(sky, |sky, _| smoothed(stage, &sky, is_seen))
}

/// The same of both sides, wherever the eye is, with so few rays that a film of it is cheap.
pub fn sky_all_around(stage: &Stage, reach: f32) -> [Vec<f32>; 2] {
    let occluder = Occluder::new(stage);
    [0, 1].map(|side| {
        let sky = sky_of_rays(stage, &occluder, |_| true, side, reach, FEW_RAYS);
        (0..FEW_RAYS_SMOOTHING).fold(sky, |sky, _| smoothed(stage, &sky, |_| true))
    })
}

/// What so many rays from each wanted vertex see.
fn sky_of_rays(
    stage: &Stage,
    occluder: &Occluder,
    is_wanted: impl Fn(usize) -> bool + Sync,
    side: usize,
    reach: f32,
    rays: usize,
) -> Vec<f32> {
    let points = disk_points(rays);
    (0..stage.positions.len())
        .into_par_iter()
        .with_min_len(64)
        .map(|vertex| {
            let normal = side_normal(stage.normals[vertex], side);
            if !is_wanted(vertex) || normal == Vec3A::ZERO {
                return 1.0;
            }
            let [right, up] = tangents(normal);
            let turn = scrambled_turn(vertex as u32);
            let origin = stage.positions[vertex] + normal * LIFT;
            let hidden: f32 = points
                .iter()
                .map(|&place| {
                    // Even on the disk is cosine-weighted on the hemisphere.
                    let [x, y] = turned(place, turn);
                    let height = (1.0 - x * x - y * y).max(0.0).sqrt();
                    let direction = (right * x + up * y + normal * height).normalize();
                    occluder.distance(origin, direction, reach).map_or(0.0, |far| (1.0 - far / reach).max(0.0).sqrt())
                })
                .sum();
            1.0 - hidden / rays as f32
        })
        .collect()
}

/// Each vertex takes half of its value from its neighbours, over some of the faces.
fn smoothed(stage: &Stage, values: &[f32], is_seen: impl Fn(usize) -> bool) -> Vec<f32> {
    let mut sums = vec![(0.0_f32, 0.0_f32); values.len()];
    for (_, corners) in stage.faces.iter().enumerate().filter(|(face, _)| is_seen(*face)) {
        for k in 0..3 {
            let around = values[corners[(k + 1) % 3] as usize] + values[corners[(k + 2) % 3] as usize];
            let sum = &mut sums[corners[k] as usize];
            *sum = (sum.0 + around, sum.1 + 2.0);
        }
    }
    let blend =
        |(&value, &(sum, count)): (&f32, &(f32, f32))| if count > 0.0 { (value + sum / count) / 2.0 } else { value };
    values.iter().zip(&sums).map(blend).collect()
}
