//! Surfaces whose isometric immersion is known.

use super::{polished, polished_by};
use crate::support::Random;
use glam::DVec3;
use immerse::immersion::{RigidMotion, bending_angles, length_error, pinch_points};
use immerse::mesh::{Mesh, Surface, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::polish::{Ending, Polish};

fn parts(surface: &Surface) -> (&Mesh, Vec<DVec3>, Metric) {
    let positions = surface.positions.clone().expect("positions");
    let metric = Metric::new(&surface.mesh, lengths_of_positions(&surface.mesh, &positions)).expect("a metric");
    (&surface.mesh, positions, metric)
}

fn disturbed(positions: &[DVec3], amount: f64, seed: u64) -> Vec<DVec3> {
    let mut random = Random::new(seed);
    positions.iter().map(|p| *p + random.vector() * amount).collect()
}

/// The largest distance between two surfaces, over rigid motions.
fn distance(positions: &[DVec3], original: &[DVec3]) -> f64 {
    let motion = RigidMotion::onto(original, positions, &vec![1.0; original.len()]);
    positions.iter().zip(original).map(|(p, q)| motion.point(*p).distance(*q)).fold(0.0, f64::max)
}

#[test]
fn a_disturbed_ellipsoid_comes_back_as_shell_and_as_membrane() {
    let mut surface = shapes::sphere(1.0, 6).expect("a sphere");
    let places = surface.positions.as_mut().expect("positions");
    places.iter_mut().for_each(|p| *p *= DVec3::new(1.0, 0.7, 0.5));
    let (mesh, original, metric) = parts(&surface);
    for seed in 0..3 {
        let noisy = disturbed(&original, 5e-3, seed);
        for is_membrane in [false, true] {
            let out = polished_by(&Polish { is_membrane, ..Polish::default() }, mesh, &metric, &noisy, &[]);
            assert!(distance(&out.positions, &original) < 1e-10, "{is_membrane} {:?}", out.report);
            assert!(out.report.l2_length_error < 1e-12 && out.report.l2_length_error_before > 1e-3, "{:?}", out.report);
            assert_eq!(out.report.ending, Ending::Isometric);
        }
    }
}

#[test]
fn a_flat_disk_stays_flat() {
    let surface = shapes::disk(1.0, 8).expect("a disk");
    let (mesh, original, metric) = parts(&surface);
    let out = polished(mesh, &metric, &original, &[]);
    assert!(out.positions.iter().all(|p| p.z.abs() < 1e-14), "{:?}", out.report);
    assert!(out.report.l2_length_error < 1e-13, "{:?}", out.report);
}

#[test]
fn polish_leaves_a_surface_where_it_was_and_in_its_units() {
    let surface = shapes::sphere(1.0, 4).expect("a sphere");
    let (mesh, original, metric) = parts(&surface);
    let far: Vec<DVec3> = disturbed(&original, 1e-2, 1).iter().map(|p| *p + DVec3::new(30.0, -5.0, 2.0)).collect();
    let out = polished(mesh, &metric, &far, &[]);
    let middle = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
    assert!(middle(&out.positions).distance(middle(&far)) < 1e-3);
    let doubled =
        Metric::new(mesh, metric.edge_lengths().iter().map(|length| 2.0 * length).collect()).expect("a metric");
    let twice: Vec<DVec3> = far.iter().map(|p| *p * 2.0).collect();
    let out_doubled = polished(mesh, &doubled, &twice, &[]);
    let halves: Vec<DVec3> = out_doubled.positions.iter().map(|p| *p * 0.5).collect();
    assert!(distance(&halves, &out.positions) < 1e-11);
}

#[test]
fn lengths_that_no_surface_has_end_at_a_fit_without_a_fold() {
    // The three upper edges are too short to meet above the lowest face.
    let mesh = Mesh::from_faces(4, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).expect("a tetrahedron");
    let metric = Metric::from_fn(&mesh, |a, b| if a.max(b) == 3 { 0.55 } else { 1.0 }).expect("a metric");
    let corner = |angle: f64| DVec3::new(angle.cos(), angle.sin(), 0.0) / 3.0_f64.sqrt();
    let third = std::f64::consts::TAU / 3.0;
    let begin = [corner(0.0), corner(third), corner(2.0 * third), DVec3::new(0.0, 0.0, 0.2)];
    let out = polished(&mesh, &metric, &begin, &[]);
    assert_ne!(out.report.ending, Ending::Isometric, "{:?}", out.report);
    let error = length_error(&mesh, &metric, &out.positions).l2;
    assert!(error > 5e-3 && error == out.report.l2_length_error, "{:?}", out.report);
    assert!(error < out.report.l2_length_error_before, "{:?}", out.report);
    let begins = bending_angles(&mesh, &begin);
    let folds = bending_angles(&mesh, &out.positions);
    assert!(folds.iter().zip(begins).all(|(after, before)| after * before > 0.0), "{folds:?}");
    assert!(pinch_points(&mesh, &out.positions).is_empty());
}
