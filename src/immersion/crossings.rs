//! Closed forms that count how often an edge crosses a path.

use crate::mesh::{EdgeId, HalfedgeId, Mesh};
use std::collections::VecDeque;

/// How often each edge crosses a closed path, or one from boundary to boundary, when it is pushed a little to its
/// left: a closed form whose period along a strip is how often the strip crosses the path.
///
/// Counting crossings of a strip would not do on a surface with boundary: along a strip around a boundary curve that
/// form has no period at all.
pub(super) fn crossings(mesh: &Mesh, path: &[EdgeId]) -> Vec<f64> {
    let path = oriented(mesh, path);
    let mut form = vec![0.0; mesh.edge_count()];
    let mut add = |h: HalfedgeId, count: f64| {
        let e = mesh.edge(h);
        form[e.index()] += if mesh.edge_halfedge(e) == h { count } else { -count };
    };
    let ends = path.last().zip(path.first()).map(|(&last, &first)| (last, mesh.tip(last), mesh.tail(first)));
    // A path that comes back to a boundary vertex may as well end there.
    let closing = ends.and_then(|(last, to, from)| (to == from && !mesh.is_boundary_vertex(to)).then_some(last));
    for (k, &h) in path.iter().enumerate() {
        let before = if k > 0 { Some(path[k - 1]) } else { closing };
        // Counterclockwise around the tail, to where the path came from or to the boundary.
        let mut side = h.previous();
        while before.is_none_or(|before| mesh.edge(before) != mesh.edge(side)) {
            add(side, -1.0);
            let Some(twin) = mesh.twin(side) else { break };
            side = twin.previous();
        }
        // Clockwise around the tip, where the path ends on the boundary.
        if k + 1 == path.len() && closing.is_none() {
            let mut side = h.next();
            loop {
                add(side, 1.0);
                let Some(twin) = mesh.twin(side) else { break };
                side = twin.next();
            }
        }
    }
    form
}

/// A path with its edges in order, each as a halfedge in the direction of the path. `path` begins with one of its
/// edges, from whose ends it is followed one after the other.
fn oriented(mesh: &Mesh, path: &[EdgeId]) -> Vec<HalfedgeId> {
    let Some((&first, rest)) = path.split_first() else { return Vec::new() };
    let [mut start, mut end] = mesh.edge_vertices(first);
    let mut ordered = VecDeque::from([(first, start)]);
    for &e in rest {
        let [a, b] = mesh.edge_vertices(e);
        let ends = [(a, b), (b, a)];
        if let Some((_, far)) = ends.into_iter().find(|(near, _)| *near == start) {
            ordered.push_front((e, far));
            start = far;
        } else if let Some((near, far)) = ends.into_iter().find(|(near, _)| *near == end) {
            ordered.push_back((e, near));
            end = far;
        }
    }
    let halfedge = |(e, tail)| mesh.halfedges_of(e).find(|&h| mesh.tail(h) == tail);
    ordered.into_iter().filter_map(halfedge).collect()
}
