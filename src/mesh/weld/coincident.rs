//! Points that coincide, found by hashing.

use crate::mesh::union_find::root;
use glam::DVec3;
use std::collections::HashMap;

/// Per vertex the first of the vertices that coincide with it. Points within the tolerance of each other coincide, and so
/// do points that are joined by a chain of such points.
pub(super) fn coincident(vertices: &[u32], positions: &[DVec3], tolerance: f64) -> HashMap<u32, u32> {
    let mut parents: Vec<u32> = (0..vertices.len() as u32).collect();
    let at = |k: u32| positions[vertices[k as usize] as usize];
    if tolerance == 0.0 {
        let mut seen = HashMap::new();
        for k in 0..vertices.len() as u32 {
            parents[k as usize] = *seen.entry(bits(at(k))).or_insert(k);
        }
    } else {
        // In a cell of this size all are within the tolerance, and cells up to two away may be.
        let size = tolerance / 3f64.sqrt();
        let cell = |p: DVec3| (p / size).floor();
        let mut cells: HashMap<[u64; 3], Vec<u32>> = HashMap::new();
        (0..vertices.len() as u32).for_each(|k| cells.entry(bits(cell(at(k)))).or_default().push(k));
        for k in 0..vertices.len() as u32 {
            let here = cell(at(k));
            for step in 0..125 {
                let aside = DVec3::from([step % 5, step / 5 % 5, step / 25].map(|n| f64::from(n) - 2.0));
                let Some(others) = cells.get(&bits(here + aside)) else { continue };
                let whole = root(&mut parents, k);
                if root(&mut parents, others[0]) == whole {
                    continue; // all of a cell hang together once the first of them has been here
                }
                for &other in others.iter().filter(|other| at(**other).distance(at(k)) <= tolerance) {
                    let (a, b) = (root(&mut parents, k), root(&mut parents, other));
                    parents[a.max(b) as usize] = a.min(b);
                }
            }
        }
    }
    (0..vertices.len() as u32).map(|k| (vertices[k as usize], vertices[root(&mut parents, k) as usize])).collect()
}

/// Vertices of one list that have exactly the position of a vertex of another list, each with that vertex.
pub(super) fn at_equal_positions(these: &[u32], those: &[u32], positions: &[DVec3]) -> Vec<[u32; 2]> {
    if these.is_empty() {
        return Vec::new();
    }
    let there: HashMap<[u64; 3], u32> = those.iter().map(|&v| (bits(positions[v as usize]), v)).collect();
    these.iter().filter_map(|&v| there.get(&bits(positions[v as usize])).map(|&other| [v, other])).collect()
}

/// Adding zero turns -0 into +0.
fn bits(p: DVec3) -> [u64; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}
