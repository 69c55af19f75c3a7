//! How much of the sky and of each light a surface point sees.
//!
//! The sky is sampled once per vertex and side, where it varies slowly. Shadows have edges: they are
//! sampled at the vertices only to find out which faces are wholly lit or wholly dark, and per pixel in
//! the others.

use glam::Vec3A;
use rayon::prelude::*;

use super::{
    directions::{disk_points, scrambled_turn, side_normal, tangents, turned},
    sky::sky_per_vertex,
    trace::{LIFT, Occluder},
};
use crate::render::{Light, Lights, Look, Material, stage::Stage};

/// What was found out before shading.
pub struct Visibility {
    occluder: Occluder,
    /// Share of the sky per vertex, for the front and the back; empty if nobody asks.
    sky: [Vec<f32>; 2],
    /// For each light, per face: lit, dark, or to be looked at.
    shade: Vec<Vec<Shade>>,
    shadow_points: Vec<[f32; 2]>,
}

/// How a light falls on a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// No shadow anywhere near.
    Lit,
    /// Shadow everywhere.
    Dark,
    /// Perhaps an edge of a shadow.
    Mixed,
}

/// Rays per shadow.
const SHADOW_RAYS: usize = 16;
/// How many of these rays are sent first: those that point to the edge of the light.
const SHADOW_PROBES: usize = 6;
/// Radius of a light, as the tangent of the angle it is seen under.
const LIGHT_RADIUS: f32 = 0.08;
/// Shadow rays rise above the surface by at least this sine, so that a coarse mesh does not shade itself.
const LEAST_RISE: f32 = 0.15;
/// Faces with an edge longer than this, in pixels, are looked at between their corners too.
const LARGE_FACE: f32 = 48.0;
/// How far apart, in pixels, the points lie at which such a face is looked at.
const PROBES_APART: f32 = 24.0;
/// A face that would have more such points along an edge than this is looked at pixel by pixel.
const MOST_PROBES: f32 = 32.0;

impl Visibility {
    pub fn new(stage: &Stage, lights: &Lights, look: &Look) -> Self {
        let lit = look.material != Material::Flat;
        let occlusion = lit && look.occlusion > 0.0 && look.occlusion_reach > 0.0;
        let shadows = lit && look.shadows && lights.all().iter().any(|light| light.casts_shadow());
        if !occlusion && !shadows && look.ground_shadow == 0.0 {
            let sky = [Vec::new(), Vec::new()];
            return Self { occluder: Occluder::none(), sky, shade: Vec::new(), shadow_points: Vec::new() };
        }
        let occluder = Occluder::new(stage);
        let seen = stage.sides_seen();
        let sky = [0, 1].map(|side| {
            if occlusion { sky_per_vertex(stage, &occluder, &seen, side, look.occlusion_reach) } else { Vec::new() }
        });
        let mut visibility = Self {
            occluder,
            sky,
            shade: Vec::new(),
            shadow_points: disk_points(SHADOW_RAYS).into_iter().rev().collect(),
        };
        if shadows {
            visibility.shade =
                lights.all().iter().map(|light| visibility.shade_per_face(stage, light, &seen)).collect();
        }
        visibility
    }

    /// What is in the way of light, if the look wants to know.
    pub fn occluder(&self) -> &Occluder {
        &self.occluder
    }

    /// Share of the sky seen from one side (0 front, 1 back) of a place between vertices.
    pub fn sky_seen(&self, side: usize, corners: [u32; 3], weights: [f32; 3]) -> f32 {
        let sky = &self.sky[side];
        if sky.is_empty() { 1.0 } else { (0..3).map(|k| sky[corners[k] as usize] * weights[k]).sum() }
    }

    /// How a light falls on a face.
    pub fn shade(&self, light: usize, face: usize) -> Shade {
        self.shade.get(light).and_then(|faces| faces.get(face)).copied().unwrap_or(Shade::Lit)
    }

    /// Share of a light seen from a point whose normal, on the side that is looked at, is given. The
    /// pattern of rays is turned by `turn` (cosine, sine).
    pub fn light_seen(&self, light: &Light, point: Vec3A, normal: Vec3A, turn: [f32; 2]) -> f32 {
        let rise = normal.dot(light.direction());
        let center = (light.direction() + normal * (LEAST_RISE - rise).max(0.0)).normalize();
        let [right, up] = tangents(center);
        let origin = point + normal * LIFT;
        let blocked = |points: &[[f32; 2]]| {
            let blocked = points.iter().filter(|&&place| {
                let [x, y] = turned(place, turn);
                self.occluder.blocks(origin, (center + (right * x + up * y) * LIGHT_RADIUS).normalize())
            });
            blocked.count()
        };
        // If the rays along the edge of the light agree, so will the others.
        let (outer, inner) = self.shadow_points.split_at(SHADOW_PROBES);
        match blocked(outer) {
            0 => 1.0,
            SHADOW_PROBES => 0.0,
            count => 1.0 - (count + blocked(inner)) as f32 / SHADOW_RAYS as f32,
        }
    }

    fn shade_per_face(&self, stage: &Stage, light: &Light, seen: &[[bool; 2]]) -> Vec<Shade> {
        if !light.casts_shadow() {
            return Vec::new();
        }
        // Least and greatest share per vertex and side; vertices that face away say nothing.
        let shares: Vec<[[f32; 2]; 2]> = (0..stage.positions.len())
            .into_par_iter()
            .with_min_len(64)
            .map(|vertex| {
                [0, 1].map(|side| {
                    let normal = side_normal(stage.normals[vertex], side);
                    if !seen[vertex][side] || normal.dot(light.direction()) <= -light.wrap() {
                        return [1.0, 0.0];
                    }
                    let share = self.light_seen(light, stage.positions[vertex], normal, scrambled_turn(vertex as u32));
                    [share, share]
                })
            })
            .collect();
        let widen = |[low, high]: [f32; 2], share: &[f32; 2]| [low.min(share[0]), high.max(share[1])];
        let over_faces = |shares: &[[[f32; 2]; 2]]| -> Vec<[f32; 2]> {
            let sides = stage.shows_front.iter().map(|&front| usize::from(!front));
            let corners = stage.faces.iter().zip(sides);
            corners
                .map(|(f, side)| f.iter().fold([1.0, 0.0], |range, &v| widen(range, &shares[v as usize][side])))
                .collect()
        };
        // One ring of neighbours more, because a shadow's edge may miss all three corners.
        let mut around = vec![[[1.0, 0.0]; 2]; stage.positions.len()];
        for (face, range) in over_faces(&shares).iter().enumerate() {
            let side = usize::from(!stage.shows_front[face]);
            for &vertex in &stage.faces[face] {
                around[vertex as usize][side] = widen(around[vertex as usize][side], range);
            }
        }
        let ranges = over_faces(&around);
        ranges
            .par_iter()
            .enumerate()
            .with_min_len(64)
            .map(|(face, &range)| {
                let pixels = stage.faces[face].map(|vertex| stage.pixels[vertex as usize]);
                let longest = (0..3).map(|k| pixels[k].distance(pixels[(k + 1) % 3])).fold(0.0, f32::max);
                let parts = (longest / PROBES_APART).ceil();
                match shade_of(range) {
                    Shade::Mixed => Shade::Mixed,
                    shade if longest < LARGE_FACE => shade,
                    _ if parts.is_nan() || parts > MOST_PROBES => Shade::Mixed,
                    _ => shade_of(self.range_within(stage, light, face, parts as usize, range)),
                }
            })
            .collect()
    }

    /// The range of shares of a light at the corners of a face, widened by those at the points of a grid that cuts each of
    /// its edges into `parts` pieces.
    fn range_within(&self, stage: &Stage, light: &Light, face: usize, parts: usize, range: [f32; 2]) -> [f32; 2] {
        let corners = stage.faces[face].map(|vertex| vertex as usize);
        let side = usize::from(!stage.shows_front[face]);
        let mut range = range;
        for (i, j) in (0..=parts).flat_map(|i| (0..=parts - i).map(move |j| (i, j))) {
            let weights = [i, j, parts - i - j].map(|part| part as f32 / parts as f32);
            let blend = |values: &[Vec3A]| (0..3).map(|k| values[corners[k]] * weights[k]).sum::<Vec3A>();
            let normal = side_normal(blend(&stage.normals).normalize_or_zero(), side);
            if normal.dot(light.direction()) > -light.wrap() {
                let turn = scrambled_turn((face * 1024 + i * 32 + j) as u32);
                let share = self.light_seen(light, blend(&stage.positions), normal, turn);
                range = [range[0].min(share), range[1].max(share)];
                if shade_of(range) == Shade::Mixed {
                    break;
                }
            }
        }
        range
    }
}

/// What the least and the greatest share of a light say; no light arrives where the least is above the greatest.
fn shade_of([low, high]: [f32; 2]) -> Shade {
    match (low, high) {
        (low, high) if low > high || low >= 1.0 => Shade::Lit,
        (_, high) if high <= 0.0 => Shade::Dark,
        _ => Shade::Mixed,
    }
}
