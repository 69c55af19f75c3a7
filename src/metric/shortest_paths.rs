//! Shortest ways along edges.

use crate::mesh::{Mesh, VertexId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Length of the shortest way along edges from a vertex to each, |V|, given the lengths of the edges, |E| (Dijkstra's
/// algorithm). Infinite where there is no way.
pub fn shortest_paths(mesh: &Mesh, lengths: &[f64], source: VertexId) -> Vec<f64> {
    let mut distances = vec![f64::INFINITY; mesh.vertex_count()];
    distances[source.index()] = 0.0;
    // The bits of numbers that are not negative are in their order.
    let mut waiting = BinaryHeap::from([(Reverse(0), source)]);
    while let Some((Reverse(bits), v)) = waiting.pop() {
        if f64::from_bits(bits) > distances[v.index()] {
            continue;
        }
        for h in mesh.outgoing(v) {
            // On the boundary the last side of the star leads here.
            for (h, end) in [(h, mesh.tip(h)), (h.previous(), mesh.tail(h.previous()))] {
                let distance = distances[v.index()] + lengths[mesh.edge(h).index()];
                if distance < distances[end.index()] {
                    distances[end.index()] = distance;
                    waiting.push((Reverse(distance.to_bits()), end));
                }
            }
        }
    }
    distances
}
