//! The polyhedron of genus 2 with negative curvature at every corner.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use immerse::immersion::pinch_points;
use immerse::mesh::shapes::PolyhedronSource;
use immerse::mesh::{Surface, shapes};
use immerse::metric::{Metric, lengths_of_positions};

fn saddle(subdivisions: usize) -> (Surface, Vec<DVec3>) {
    let source = PolyhedronSource::Named("genus_two_saddle".to_owned());
    let surface = shapes::polyhedron(&source, subdivisions).expect("a polyhedron");
    let positions = surface.positions.clone().expect("positions");
    (surface, positions)
}

#[test]
fn every_corner_has_more_than_a_full_turn_of_angles() {
    for subdivisions in [1, 17] {
        let (surface, positions) = saddle(subdivisions);
        let mesh = &surface.mesh;
        assert_eq!(mesh.euler_characteristic(), -2);
        assert_eq!((mesh.components().len(), mesh.boundary_loops().len()), (1, 0));
        assert_eq!(mesh.face_count(), 28 * subdivisions * subdivisions);
        assert!(surface.repairs.is_empty(), "{:?}", surface.repairs);
        let metric = Metric::new(mesh, lengths_of_positions(mesh, &positions)).expect("a metric");
        let curvatures: Vec<f64> = mesh.vertices().map(|v| metric.curvature(mesh, v)).collect();
        let (corners, flat): (Vec<f64>, Vec<f64>) = curvatures.iter().partition(|k| k.abs() > 1e-9);
        assert_eq!((corners.len(), flat.len()), (12, mesh.vertex_count() - 12));
        assert!(corners.iter().all(|&k| k < -0.29), "{corners:?}");
        assert!((corners.iter().sum::<f64>() + 2.0 * TAU).abs() < 1e-10, "Gauss-Bonnet");
        let angle = |[a, b, c]: [DVec3; 3]| (b - a).angle_between(c - a);
        let angles = (mesh.triangles().into_iter())
            .map(|t| t.map(|v| positions[v as usize]))
            .flat_map(|[a, b, c]| [[a, b, c], [b, c, a], [c, a, b]].map(angle));
        let thinnest = angles.fold(PI, f64::min);
        assert!(thinnest > 25f64.to_radians(), "{}", thinnest.to_degrees());
        assert!(pinch_points(mesh, &positions).is_empty());
    }
}

#[test]
fn it_does_not_cross_itself_and_faces_outward() {
    let (surface, p) = saddle(1);
    let triangles = surface.mesh.triangles();
    let at = |t: [u32; 3]| t.map(|v| p[v as usize]);
    let volume: f64 = triangles.iter().map(|&t| at(t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
    assert!(volume > 1.0, "{volume}");
    for e in surface.mesh.edges() {
        let ends = surface.mesh.edge_vertices(e).map(|v| v.index() as u32);
        for t in triangles.iter().filter(|t| !t.contains(&ends[0]) && !t.contains(&ends[1])) {
            let ([from, to], [a, b, c]) = (ends.map(|v| p[v as usize]), at(*t));
            // Where the line of the edge meets the plane of the triangle, in barycentric coordinates.
            let Some(x) = (DMat3::from_cols(b - a, c - a, from - to).determinant().abs() > 1e-12)
                .then(|| DMat3::from_cols(b - a, c - a, from - to).inverse() * (from - a))
            else {
                continue;
            };
            let inside = x.x >= 0.0 && x.y >= 0.0 && x.x + x.y <= 1.0 && (0.0..=1.0).contains(&x.z);
            assert!(!inside, "edge {ends:?} pierces triangle {t:?}");
        }
    }
}
