//! A result does not depend on the rigid motion that random frames happen to choose.

use crate::support::Random;
use glam::{DQuat, DVec3};
use immerse::evolve::Unobserved;
use immerse::immersion::{RigidMotion, frames_of_positions};
use immerse::mesh::Selection;
use immerse::mesh::Surface;
use immerse::metric::{Metric, lengths_of_positions};
use immerse::scene::{LengthSource, PinSection, Scene, StartFrom};

/// An egg that is no solid of revolution.
fn egg() -> (Surface, Vec<DVec3>) {
    let mut surface = immerse::mesh::shapes::sphere(1.0, 4).unwrap();
    let positions = surface.positions.as_mut().unwrap();
    for p in positions.iter_mut() {
        *p = DVec3::new(2.0 * p.x, p.y, 0.6 * p.z) * (1.0 + 0.2 * p.x + 0.1 * p.y + 0.15 * p.z);
    }
    let positions = positions.clone();
    (surface, positions)
}

fn moved(positions: &[DVec3], random: &mut Random) -> (DQuat, Vec<DVec3>) {
    let (rotation, shift) = (random.frame(), 3.0 * random.vector());
    (rotation, positions.iter().map(|&p| rotation * p + shift).collect())
}

fn distance(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn a_moved_surface_is_brought_back_with_its_frames() {
    let (surface, reference) = egg();
    let mesh = &surface.mesh;
    let metric = Metric::new(mesh, lengths_of_positions(mesh, &reference)).unwrap();
    let identity = vec![DQuat::IDENTITY; mesh.face_count()];
    let reference_frames = frames_of_positions(mesh, &metric, &reference, &identity);
    let weights = metric.vertex_areas(mesh);
    assert!((weights.iter().sum::<f64>() - metric.total_area()).abs() < 1e-12);
    let mut random = Random::new(1);
    for _ in 0..20 {
        let (_, positions) = moved(&reference, &mut random);
        let frames = frames_of_positions(mesh, &metric, &positions, &identity);
        let motion = RigidMotion::onto(&reference, &positions, &weights);
        let back: Vec<DVec3> = positions.iter().map(|&p| motion.point(p)).collect();
        assert!(distance(&back, &reference) < 1e-12);
        for (frame, reference) in frames.iter().zip(&reference_frames) {
            assert!(motion.frame(*frame).dot(*reference).abs() > 1.0 - 1e-12);
        }
    }
}

#[test]
fn principal_axes_do_not_depend_on_the_motion_and_are_ordered() {
    let (surface, reference) = egg();
    let weights = vec![1.0; surface.mesh.vertex_count()];
    let aligned = |positions: &[DVec3]| -> Vec<DVec3> {
        let motion = RigidMotion::to_principal_axes(positions, &weights);
        positions.iter().map(|&p| motion.point(p)).collect()
    };
    let first = aligned(&reference);
    let extent = |axis: usize| first.iter().map(|p| p[axis].abs()).fold(0.0, f64::max);
    assert!(extent(0) > extent(1) && extent(1) > extent(2));
    assert!(first.iter().sum::<DVec3>().length() < 1e-10);
    assert!(first.iter().map(|p| p.x).sum::<f64>().abs() < 1e-10);
    assert!(first.iter().map(|p| p.x.powi(3)).sum::<f64>() > 0.0);
    // No reflection: three vertices keep their orientation.
    let volume = |p: &[DVec3]| (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    assert!((volume(&first) - volume(&reference)).abs() < 1e-12);
    let mut random = Random::new(2);
    for _ in 0..20 {
        assert!(distance(&aligned(&moved(&reference, &mut random).1), &first) < 1e-12);
    }
}

/// Part of the way from one motion to another: about a point that stays, by an angle that is not exceeded.
#[test]
fn motions_turn_toward_others_by_a_bounded_angle() {
    let (surface, reference) = egg();
    let weights = Metric::new(&surface.mesh, lengths_of_positions(&surface.mesh, &reference)).unwrap();
    let weights = weights.vertex_areas(&surface.mesh);
    let mut random = Random::new(5);
    for _ in 0..20 {
        let points = moved(&reference, &mut random).1;
        let here = RigidMotion::onto(&moved(&reference, &mut random).1, &points, &weights);
        let goal = RigidMotion::onto(&reference, &points, &weights);
        let pivot = points[7];
        let angle = |a: &RigidMotion, b: &RigidMotion| {
            let turn = a.frame(DQuat::IDENTITY).conjugate() * b.frame(DQuat::IDENTITY);
            2.0 * turn.w.abs().min(1.0).acos()
        };
        let whole = angle(&here, &goal);
        for part in [0.0, 0.3, 1.0, 2.0] {
            let between = here.toward(&goal, part * whole, pivot);
            assert!((between.point(pivot) - here.point(pivot)).length() < 1e-12);
            assert!((angle(&here, &between) - part.min(1.0) * whole).abs() < 1e-6);
            assert!((angle(&between, &goal) - (1.0 - part.min(1.0)) * whole).abs() < 1e-6);
        }
    }
}

#[test]
fn values_that_are_not_numbers_do_no_harm() {
    let points = [DVec3::NAN, DVec3::X];
    let motion = RigidMotion::onto(&[DVec3::X, DVec3::Y], &points, &[1.0, 1.0]);
    assert!(motion.frame(DQuat::IDENTITY).is_finite());
    assert!(RigidMotion::to_principal_axes(&points, &[1.0, 1.0]).point(DVec3::X).is_finite());
    // A single point has no axes, and still a place.
    let motion = RigidMotion::to_principal_axes(&[DVec3::X], &[1.0]);
    assert!(motion.point(DVec3::X).length() < 1e-15);
}

#[test]
fn a_relaxed_surface_lies_upon_the_mesh_unless_pins_hold_it_elsewhere() {
    let (surface, reference) = egg();
    let at = |scene: &Scene| scene.simulation_of(surface.clone()).unwrap().advance(0, &mut Unobserved).unwrap();
    let mut scene = Scene { start: StartFrom::Mesh.into(), ..Scene::default() };
    assert!(distance(&at(&scene).positions, &reference) < 1e-9);
    let elsewhere = DVec3::new(5.0, 6.0, 7.0);
    scene.pins = vec![PinSection {
        vertices: Selection::Vertices(vec![0]),
        positions: vec![elsewhere.to_array()],
        formula: None,
        motion: None,
    }];
    assert!(at(&scene).positions[0].distance(elsewhere) < 1e-9);
    // Lengths that are not those of the positions have no other place than their own axes.
    scene.pins.clear();
    scene.start = StartFrom::Random(0).into();
    scene.metric.lengths = LengthSource::Formula("1.001 * length".into());
    let frame = scene.simulation_of(surface.clone()).unwrap().relax(&mut Unobserved).unwrap();
    let mesh = &surface.mesh;
    let weights = Metric::new(mesh, lengths_of_positions(mesh, &reference)).unwrap().vertex_areas(mesh);
    let again = RigidMotion::to_principal_axes(&frame.positions, &weights);
    assert!(frame.positions.iter().all(|&p| again.point(p).distance(p) < 1e-9));
}
