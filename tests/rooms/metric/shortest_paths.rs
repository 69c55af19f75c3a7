//! Shortest paths along edges, against relaxing all edges until nothing changes.

use crate::support::Random;
use immerse::mesh::{Mesh, VertexId, shapes};
use immerse::metric::shortest_paths;

fn bellman_ford(mesh: &Mesh, lengths: &[f64], source: VertexId) -> Vec<f64> {
    let mut distances = vec![f64::INFINITY; mesh.vertex_count()];
    distances[source.index()] = 0.0;
    for _ in 0..mesh.vertex_count() {
        for e in mesh.edges() {
            let [a, b] = mesh.edge_vertices(e).map(VertexId::index);
            let length = lengths[e.index()];
            distances[b] = distances[b].min(distances[a] + length);
            distances[a] = distances[a].min(distances[b] + length);
        }
    }
    distances
}

#[test]
fn they_are_the_shortest_also_along_boundaries() {
    let mut random = Random::new(5);
    // Closed, with boundary, and in two components.
    let two = Mesh::from_faces(6, &[[0, 1, 2], [3, 4, 5]]).expect("two triangles");
    let meshes = [
        shapes::sphere(1.0, 3).expect("a sphere").mesh,
        shapes::disk(1.0, 4).expect("a disk").mesh,
        shapes::annulus(0.5, 1.0, 12, 3).expect("an annulus").mesh,
        two,
    ];
    for mesh in &meshes {
        let lengths: Vec<f64> = mesh.edges().map(|_| 0.1 + random.unit()).collect();
        for source in mesh.vertices().step_by(5) {
            let (found, expected) = (shortest_paths(mesh, &lengths, source), bellman_ford(mesh, &lengths, source));
            for (a, b) in found.iter().zip(&expected) {
                assert!(a == b || (a - b).abs() < 1e-12, "{a} instead of {b}");
            }
        }
    }
    assert!(shortest_paths(&meshes[3], &[1.0; 6], VertexId::new(0))[3].is_infinite());
}
