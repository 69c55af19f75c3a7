//! Which of its boundary loops stand for a component.

use super::{HalfedgeId, Mesh};
use glam::DVec3;

/// Of each component that has a boundary its longest loop, as indices into [`Mesh::boundary_loops`]: by the lengths of
/// edges between `positions`, or where there are none by their number. Of equally long ones the first.
pub fn longest_loops(mesh: &Mesh, positions: Option<&[DVec3]>) -> Vec<usize> {
    chosen_loops(mesh, positions, |_| true)
}

/// Of each component that has a boundary the loop around all its others, as indices into [`Mesh::boundary_loops`]: the
/// one whose box contains theirs. Where there is none, or there are no `positions`, the longest.
pub fn outer_loops(mesh: &Mesh, positions: Option<&[DVec3]>) -> Vec<usize> {
    let Some(positions) = positions else { return longest_loops(mesh, None) };
    let boxes: Vec<[DVec3; 2]> = mesh
        .boundary_loops()
        .iter()
        .map(|cycle| {
            let points = || cycle.iter().map(|&h| positions[mesh.tail(h).index()]);
            [points().fold(DVec3::INFINITY, DVec3::min), points().fold(DVec3::NEG_INFINITY, DVec3::max)]
        })
        .collect();
    let contains = |a: usize, b: usize| {
        let ([low, high], slack) = (boxes[a], 1e-9 * boxes[a][0].distance(boxes[a][1]));
        boxes[b][0].cmpge(low - slack).all() && boxes[b][1].cmple(high + slack).all()
    };
    let others = loops_of_components(mesh);
    let of = |k: usize| others.iter().find(|of| of.contains(&k)).into_iter().flatten();
    chosen_loops(mesh, Some(positions), |k| of(k).all(|&other| contains(k, other)))
}

/// Boundary loops of each component that has any.
fn loops_of_components(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut component = vec![0; mesh.face_count()];
    let components = mesh.components();
    for (k, faces) in components.iter().enumerate() {
        faces.iter().for_each(|f| component[f.index()] = k);
    }
    let mut of = vec![Vec::new(); components.len()];
    for (k, cycle) in mesh.boundary_loops().iter().enumerate() {
        of[component[cycle[0].face().index()]].push(k);
    }
    of.retain(|loops| !loops.is_empty());
    of
}

/// The longest loop of each component among those preferred or, if none is, among all.
fn chosen_loops(mesh: &Mesh, positions: Option<&[DVec3]>, preferred: impl Fn(usize) -> bool) -> Vec<usize> {
    let loops = mesh.boundary_loops();
    let length = |k: usize| -> f64 {
        let side =
            |&h: &HalfedgeId| positions.map_or(1.0, |p| p[mesh.tail(h).index()].distance(p[mesh.tip(h).index()]));
        loops[k].iter().map(side).sum()
    };
    let longest = |of: &[usize]| {
        // Up to rounding, so that the first of two equal ones is meant.
        let most = of.iter().map(|&k| length(k)).fold(0.0, f64::max);
        of.iter().copied().find(|&k| length(k) >= most * (1.0 - 1e-9))
    };
    let choose = |of: Vec<usize>| {
        let first: Vec<usize> = of.iter().copied().filter(|&k| preferred(k)).collect();
        longest(if first.is_empty() { &of } else { &first })
    };
    loops_of_components(mesh).into_iter().filter_map(choose).collect()
}
