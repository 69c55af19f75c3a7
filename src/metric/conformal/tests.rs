//! Derivatives against finite differences, and flips against the metric they must not change.

use super::target::{BoundaryCondition, CurvatureTarget, Goal, InteriorCurvature, Region};
use super::triangulation::Triangulation;
use crate::mesh::shapes::PolyhedronSource;
use crate::mesh::{Mesh, Surface, VertexId, shapes};
use crate::metric::Metric;

/// Numbers in [−1, 1] without any pattern to speak of.
fn noise(n: usize, seed: u64) -> Vec<f64> {
    (0..n)
        .map(|k| {
            let x = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ seed.wrapping_mul(0xD1B5_4A32_D192_ED03);
            let x = (x ^ (x >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            (x >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
        .collect()
}

fn surfaces() -> Vec<(Mesh, Metric)> {
    let two = PolyhedronSource::Named("genus_two".to_owned());
    let surfaces = [shapes::sphere(1.0, 3), shapes::polyhedron(&two, 2), shapes::disk(1.0, 4)];
    surfaces
        .into_iter()
        .map(|surface| {
            let Surface { mesh, positions, .. } = surface.expect("a surface");
            let lengths = crate::metric::lengths_of_positions(&mesh, &positions.expect("positions"));
            let uneven = lengths.iter().zip(noise(lengths.len(), 1)).map(|(l, r)| l * (1.0 + 0.1 * r)).collect();
            let metric = Metric::new(&mesh, uneven).expect("a metric");
            (mesh, metric)
        })
        .collect()
}

/// Fourth-order central difference of a vector along a line.
fn slope(at: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
    let h = 1e-3;
    let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(at);
    (0..a.len()).map(|i| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * h)).collect()
}

fn assert_near(name: &str, a: &[f64], b: &[f64], tolerance: f64) {
    let size = b.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    assert!(size > 0.0, "{name}: vanishes, nothing is tested");
    for (i, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() < tolerance * size, "{name} {i}: {a} against {b}");
    }
}

#[test]
fn derivatives_match_finite_differences() {
    for (mesh, metric) in surfaces() {
        let triangulation = Triangulation::new(&mesh, metric.edge_lengths());
        let n = mesh.vertex_count();
        let (u, x) = (noise(n, 2).iter().map(|r| 0.1 * r).collect::<Vec<_>>(), noise(n, 3));
        let shape = triangulation.shape(&u).expect("a metric");
        let shape_at = |t: f64| {
            let moved: Vec<f64> = u.iter().zip(&x).map(|(u, x)| u + t * x).collect();
            triangulation.shape(&moved).expect("a metric")
        };
        let curvature = triangulation.apply_laplacian(&shape, &x);
        assert_near("curvature", &curvature, &slope(|t| shape_at(t).curvature), 1e-8);
        assert_near("area", &triangulation.area_change(&shape, &x), &slope(|t| shape_at(t).areas), 1e-8);

        let mut product = vec![0.0; n];
        for (i, j, value) in triangulation.laplacian(&shape) {
            product[i] += value * x[j];
            if i != j {
                product[j] += value * x[i];
            }
        }
        assert_near("matrix", &product, &curvature, 1e-12);

        // Curvature is a gradient: its derivative is symmetric.
        let y = noise(n, 4);
        let pair = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (xy, yx) = (pair(&curvature, &y), pair(&triangulation.apply_laplacian(&shape, &y), &x));
        assert!((xy - yx).abs() < 1e-12 * xy.abs().max(1.0), "{xy} against {yx}");
        assert!(pair(&curvature, &x) > 0.0, "not convex");

        let part = |k: usize, curvature: f64| Region {
            vertices: mesh.vertices().filter(|v| v.index() % 3 == k).collect::<Vec<VertexId>>(),
            curvature,
        };
        let regions = InteriorCurvature::PerRegion(vec![part(0, 1.0), part(2, -0.5)]);
        for interior in [InteriorCurvature::Constant, InteriorCurvature::Density(-0.3), regions] {
            for boundary in [BoundaryCondition::Isometric, BoundaryCondition::TurningAngles(vec![0.1; n])] {
                let target = CurvatureTarget { interior: interior.clone(), boundary, keep_area: true };
                let Ok(goal) = Goal::new(&target, &mesh, &metric) else { continue };
                let held = |values: Vec<f64>| -> Vec<f64> {
                    values.iter().zip(&goal.free).map(|(v, free)| if *free { *v } else { 0.0 }).collect()
                };
                let numeric = held(slope(|t| goal.curvature(&triangulation, &shape_at(t))));
                assert_near("target", &held(goal.curvature_change(&triangulation, &shape, &x)), &numeric, 1e-8);
            }
        }
    }
}

#[test]
fn delaunay_flips_keep_the_metric_and_can_be_taken_back() {
    let mut flips = 0;
    for (mesh, metric) in surfaces() {
        let original = Triangulation::new(&mesh, metric.edge_lengths());
        let unscaled = vec![0.0; mesh.vertex_count()];
        let before = original.shape(&unscaled).expect("a metric");
        let mut flipped = original.clone();
        let mut log = Vec::new();
        flipped.flip_to_intrinsic_delaunay(&mut log).expect("Delaunay");
        flips += log.len();
        let after = flipped.shape(&unscaled).expect("a metric");
        let areas = [&before, &after].map(|shape| shape.areas.iter().sum::<f64>());
        assert!((areas[0] / areas[1] - 1.0).abs() < 1e-12, "{areas:?}");
        for (a, b) in before.curvature.iter().zip(&after.curvature) {
            assert!((a - b).abs() < 1e-10, "curvature {a} became {b}");
        }
        let mut again = Vec::new();
        flipped.flip_to_delaunay(&unscaled, &mut again).expect("Delaunay");
        assert!(again.is_empty(), "was not Delaunay");
        flipped.unflip(&log).expect("straight edges");
        assert_near("length", &flipped.lengths, &original.lengths, 1e-12);
    }
    assert!(flips > 20, "the examples are Delaunay already");
}

/// Flips by Ptolemy's relation leave the conformal class, whatever scale factors they are made for.
#[test]
fn flips_at_other_scales_can_be_undone() {
    for (mesh, metric) in surfaces().into_iter().filter(|(mesh, _)| mesh.boundary_loops().is_empty()) {
        let mut triangulation = Triangulation::new(&mesh, metric.edge_lengths());
        let unscaled = vec![0.0; mesh.vertex_count()];
        triangulation.flip_to_intrinsic_delaunay(&mut Vec::new()).expect("Delaunay");
        let before = triangulation.shape(&unscaled).expect("a metric");
        let far: Vec<f64> = noise(mesh.vertex_count(), 7).iter().map(|r| 2.0 * r).collect();
        let mut log = Vec::new();
        triangulation.flip_to_delaunay(&far, &mut log).expect("Delaunay");
        assert!(!log.is_empty(), "the example needs no flips");
        triangulation.shape(&far).expect("Delaunay implies triangle inequalities");
        triangulation.flip_to_delaunay(&unscaled, &mut log).expect("Delaunay");
        let after = triangulation.shape(&unscaled).expect("a metric");
        for (a, b) in before.curvature.iter().zip(&after.curvature) {
            assert!((a - b).abs() < 1e-10, "curvature {a} became {b}");
        }
    }
}
