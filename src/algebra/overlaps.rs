//! Boxes that overlap, and triangles that may cross because theirs do.

use glam::DVec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;
use std::time::Duration;

/// An axis-parallel box: its least corner and its greatest.
pub type Box3 = [DVec3; 2];

/// How much larger boxes in single precision are, as a share of the size of all.
const MARGIN: f32 = 1e-6;
/// Boxes that are looked at together.
const TASK: usize = 256;

/// The smallest box around some points.
pub fn box_of(points: impl Iterator<Item = DVec3>) -> Box3 {
    points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
}

/// What boxes have in common, if they have.
pub fn common(one: Box3, other: Box3) -> Option<Box3> {
    let [low, high] = [one[0].max(other[0]), one[1].min(other[1])];
    low.cmple(high).all().then_some([low, high])
}

/// Whether triangles have a vertex in common.
pub fn share_a_vertex(one: &[u32; 3], other: &[u32; 3]) -> bool {
    one.iter().any(|v| other.contains(v))
}

/// What there is to say of pairs of boxes that overlap or nearly do, in order: the number of the first one, then that of the other, which
/// is greater. All corners must be finite.
pub fn overlaps<T: Send>(boxes: &[Box3], what: impl Fn(usize, usize) -> Option<T> + Sync) -> Vec<T> {
    let Some(&[origin, _]) = boxes.first() else { return Vec::new() };
    // Boxes are in single precision, around a corner, and a little too large.
    let single: Vec<Boxed> = boxes
        .par_iter()
        .map(|corners| {
            let [min, max] = corners.map(|corner| (corner - origin).as_vec3a());
            Boxed(Aabb { min, max })
        })
        .collect();
    let size = single
        .iter()
        .fold(0.0_f32, |size, Boxed(Aabb { min, max })| size.max(min.abs().max_element()).max(max.abs().max_element()));
    let tree = build_bvh2(&single, BvhBuildParams::fast_build(), &mut Duration::default());
    let of_one = |index: usize| {
        let mut partners = Vec::new();
        let Boxed(Aabb { min, max }) = single[index];
        let around = Aabb { min: min - MARGIN * size, max: max + MARGIN * size };
        tree.aabb_traverse(around, |tree, node| {
            let node = &tree.nodes[node as usize];
            let leaf = node.first_index as usize..(node.first_index + node.prim_count) as usize;
            partners.extend(tree.primitive_indices[leaf].iter().map(|&other| other as usize).filter(|&o| o > index));
            true
        });
        partners.sort_unstable();
        let what = &what;
        partners.into_iter().filter_map(move |other| what(index, other))
    };
    (0..boxes.len()).into_par_iter().with_min_len(TASK).flat_map_iter(of_one).collect()
}

struct Boxed(Aabb);

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}
