//! Of two mirror images, which lengths cannot tell apart, the one that people mean.

use crate::support::scene;
use glam::{DQuat, DVec3};
use immerse::evolve::{Frame, Unobserved};
use immerse::immersion::enclosed_volume;
use immerse::mesh::{Surface, shapes};
use immerse::metric::lengths_of_positions;
use std::sync::Arc;

fn relaxed(surface: &Surface, text: &str) -> Arc<Frame> {
    let mut simulation = scene(text).simulation_of(surface.clone()).expect("a simulation");
    simulation.relax(&mut Unobserved).expect("a frame")
}

/// Knows lengths alone.
fn bare(surface: Surface) -> Surface {
    let lengths = lengths_of_positions(&surface.mesh, surface.positions.as_deref().expect("positions"));
    Surface { edge_lengths: Some(lengths), positions: None, coordinates: None, ..surface }
}

fn spheroid() -> Surface {
    let mut surface = shapes::sphere(1.0, 4).expect("a sphere");
    surface.positions.iter_mut().flatten().for_each(|p| p.z *= 1.7);
    surface
}

fn reversed(surface: Surface) -> Surface {
    let turned: Vec<[u32; 3]> = surface.mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect();
    let mesh = immerse::mesh::Mesh::from_faces(surface.mesh.vertex_count(), &turned).expect("a mesh");
    Surface { mesh, ..surface }
}

#[test]
fn the_enclosed_volume_is_that_of_the_solid() {
    let ball = shapes::sphere(2.0, 24).expect("a sphere");
    let positions = ball.positions.as_deref().expect("positions");
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
    let volume = enclosed_volume(&ball.mesh, positions).expect("a closed surface");
    assert!((volume / exact - 1.0).abs() < 0.01 && volume < exact, "{volume} {exact}");
    let far: Vec<DVec3> = positions.iter().map(|p| *p + DVec3::splat(1e6)).collect();
    assert!((enclosed_volume(&ball.mesh, &far).expect("closed") / volume - 1.0).abs() < 1e-8);
    let inside_out: Vec<DVec3> = positions.iter().map(|p| -*p).collect();
    assert!((enclosed_volume(&ball.mesh, &inside_out).expect("closed") + volume).abs() < 1e-12);
    let disk = shapes::disk(1.0, 4).expect("a disk");
    assert_eq!(enclosed_volume(&disk.mesh, disk.positions.as_deref().expect("positions")), None);
}

/// From ten seeds about five come out inside out, and all are turned.
#[test]
fn bare_lengths_come_out_with_their_front_outside() {
    let surface = bare(spheroid());
    let mut mirrored = 0;
    for seed in 0..10 {
        let report = relaxed(&surface, &format!("[start]\nrandom = {seed}")).report.clone();
        let volume = report.enclosed_volume.expect("a closed surface");
        assert!(volume > 6.0 && report.rims == 0, "seed {seed}: {volume}");
        assert!(report.l2_length_error < 2e-3, "seed {seed}: {}", report.l2_length_error);
        mirrored += usize::from(report.cursor.mirrored);
        let left =
            relaxed(&surface, &format!("[start]\nrandom = {seed}\norientation = \"as it comes\"")).report.clone();
        let sign = if report.cursor.mirrored { -1.0 } else { 1.0 };
        assert!((left.enclosed_volume.expect("closed") * sign / volume - 1.0).abs() < 1e-3);
        assert!(!left.cursor.mirrored);
    }
    assert!((2..=8).contains(&mirrored), "{mirrored} of 10");
    assert!(relaxed(&surface, "[start]\nfrom = \"spectral\"").report.enclosed_volume.expect("closed") > 6.0);
}

/// Where the lengths are those of the mesh's positions, the result is like them, inside out or not.
#[test]
fn the_result_is_like_the_mesh() {
    let lopsided = || {
        let mut surface = spheroid();
        surface.positions.iter_mut().flatten().for_each(|p| {
            *p *= 1.0 + 0.15 * p.x + 0.1 * p.y * p.z;
        });
        surface
    };
    for (surface, sign) in [(lopsided(), 1.0), (reversed(lopsided()), -1.0)] {
        for seed in 0..4 {
            let report = relaxed(&surface, &format!("[start]\nrandom = {seed}")).report.clone();
            assert!(report.mean_distance.expect("positions") < 0.01, "seed {seed}: {:?}", report.mean_distance);
            assert!(sign * report.enclosed_volume.expect("closed") > 6.0);
        }
    }
}

/// The same with a boundary: a bowl has no inside, but the mesh has a side.
#[test]
fn a_bowl_is_like_the_mesh_too() {
    let mut bowl = shapes::disk(1.0, 8).expect("a disk");
    bowl.positions.iter_mut().flatten().for_each(|p| p.z = 0.6 * (p.x * p.x + 1.4 * p.y * p.y) + 0.2 * p.x * p.x * p.x);
    for seed in 0..4 {
        let report = relaxed(&bowl, &format!("[start]\nrandom = {seed}")).report.clone();
        assert!(report.mean_distance.expect("positions") < 0.03, "seed {seed}: {:?}", report.mean_distance);
        assert_eq!(report.enclosed_volume, None);
    }
}

/// One pin, or two, leave the mirror image open.
#[test]
fn pins_stay_where_they_are() {
    let surface = spheroid();
    let mut mirrored = 0;
    for pinned in ["[0]", "[0, 17]"] {
        for seed in 0..4 {
            let text = format!("[start]\nrandom = {seed}\n[[pin]]\nvertices = {pinned}");
            let report = relaxed(&surface, &text).report.clone();
            assert!(report.enclosed_volume.expect("closed") > 6.0, "{pinned} seed {seed}");
            assert!(report.pin_distance.expect("pins") < 1e-9);
            let left = relaxed(&surface, &text.replace("\n[[pin]]", "\norientation = \"as it comes\"\n[[pin]]"))
                .report
                .clone();
            let between = (left.l2_length_error - report.l2_length_error).abs();
            assert!(between < 1e-6 * report.l2_length_error + 1e-12, "{pinned} seed {seed}");
            mirrored += usize::from(report.cursor.mirrored);
        }
    }
    assert!(mirrored >= 2, "{mirrored} of 8");
}

/// A mirror image in the same class has the same energy, and the frames that were turned are its frames.
#[test]
fn turned_frames_are_frames_of_the_mirror_image() {
    let i = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
    let surface = bare(spheroid());
    let run = |text: &str| {
        let mut simulation = scene(text).simulation_of(surface.clone()).expect("a simulation");
        let frame = simulation.relax(&mut Unobserved).expect("a frame");
        (simulation.face_frames(), frame)
    };
    let turned = (0..10).map(|seed| (seed, run(&format!("[start]\nrandom = {seed}"))));
    let (seed, (frames, frame)) = turned.into_iter().find(|(_, (_, frame))| frame.report.cursor.mirrored).expect("one");
    let (left_frames, left) = run(&format!("[start]\nrandom = {seed}\norientation = \"as it comes\""));
    assert!((left.report.energy / frame.report.energy - 1.0).abs() < 1e-9);
    // Up to one rotation on the right.
    let turn = (i * left_frames[0]).conjugate() * frames[0];
    let far = left_frames.iter().zip(&frames).map(|(a, b)| (i * *a * turn - *b).length()).fold(0.0, f64::max);
    assert!(far < 1e-9, "{far}");
}

/// A torus in every class: the knot of lengths has two mirror images, and classes are kept.
#[test]
fn classes_are_kept() {
    let torus = bare(shapes::torus(1.0, 0.4, 24, 14).expect("a torus"));
    for class in ["00", "01", "10"] {
        let report = relaxed(&torus, &format!("[start]\nrandom = 2\n[spin]\nclass = \"{class}\"")).report.clone();
        let left = relaxed(
            &torus,
            &format!("[start]\nrandom = 2\norientation = \"as it comes\"\n[spin]\nclass = \"{class}\""),
        );
        assert_eq!((&report.spin_class, &report.asked_class), (&left.report.spin_class, &left.report.asked_class));
        assert_eq!(report.asked_class, class);
        assert_eq!((report.rims, report.pinch_points), (left.report.rims, left.report.pinch_points));
        assert!(report.enclosed_volume.expect("closed") >= 0.0);
    }
}
