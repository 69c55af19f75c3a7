//! Halfway models, and spheres and tori that turn inside out over them.

use glam::DVec3;
use immerse::Metric;
use immerse::evolve::Unobserved;
use immerse::homotopy::Homotopy;
use immerse::immersion::{enclosed_volume, l2_length_error, pinch_points};
use immerse::mesh::Mesh;
use immerse::mesh::shapes::{self, Halfway};
use immerse::metric::lengths_of_positions;
use immerse::polish::Exchange;
use std::f64::consts::PI;

use crate::support::scene;

fn octasphere(subdivisions: usize, sides: usize) -> (Mesh, Vec<DVec3>) {
    let surface = shapes::octasphere(1.0, subdivisions, sides).expect("a sphere");
    (surface.mesh, surface.positions.expect("positions"))
}

#[test]
fn halfway_models_are_taken_to_themselves_with_their_sides_exchanged() {
    for lobes in [2, 3, 4] {
        let (mesh, sphere) = octasphere(9, 2 * lobes);
        let exchange = Exchange::of_sphere(&sphere, lobes).expect("a symmetric mesh");
        let model = Halfway { lobes, time: 0.0 }.of_sphere(&sphere);
        let off = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(off(&exchange.exchanged(&model), &model) < 1e-12, "{lobes} lobes");
        assert!(pinch_points(&mesh, &model).is_empty(), "{lobes} lobes");
        assert!(enclosed_volume(&mesh, &model).expect("closed").abs() < 1e-9);
        // On one side of it is what lies on the other side, with sides exchanged.
        let [behind, ahead] = [-0.3, 0.3].map(|time| Halfway { lobes, time }.of_sphere(&sphere));
        assert!(off(&exchange.exchanged(&behind), &ahead) < 1e-12, "{lobes} lobes");
        assert!(off(&behind, &ahead) > 0.1);
    }
}

#[test]
fn a_mesh_without_the_symmetry_is_refused() {
    let (_, sphere) = octasphere(5, 6);
    let error = Exchange::of_sphere(&sphere, 2).expect_err("six sides have no quarter turn");
    assert!(error.to_string().contains("90°"), "{error}");
    let icosphere = shapes::sphere(1.0, 4).expect("a sphere").positions.expect("positions");
    assert!(Exchange::of_sphere(&icosphere, 2).is_err());
}

/// Small enough for a test, and so stretched more than the film that ships.
const FILM: &str = "[mesh]\nshape = 'octasphere'\nsubdivisions = 12\n[start]\nhalfway = 2\n[bending]\nbending_stiffness = 0.05\n\
                    [clock]\nboth_ways = true\nframes = 81\n";

#[test]
fn a_sphere_turns_inside_out() {
    let mut simulation = scene(FILM).simulation().expect("a simulation");
    let frames: Vec<_> = (0..81).map(|_| simulation.next_frame(&mut Unobserved).expect("a frame")).collect();
    let (mesh, sphere) = octasphere(12, 4);
    let metric = Metric::new(&mesh, lengths_of_positions(&mesh, &sphere)).expect("a metric");
    let volume = |k: usize| frames[k].report.enclosed_volume.expect("closed") / (4.0 / 3.0 * PI);
    assert!(volume(80) > 0.9 && (volume(0) + volume(80)).abs() < 1e-9, "{} to {}", volume(0), volume(80));
    assert!(volume(40).abs() < 1e-9);
    assert!(frames[80].report.mean_distance.expect("the sphere") < 1e-3);
    for k in [0, 80] {
        assert!(frames[k].report.l2_length_error < 1e-9, "{}", frames[k].report.l2_length_error);
    }
    for frame in &frames {
        assert_eq!((frame.report.rims, frame.report.pinch_points), (0, 0), "frame {}", frame.report.frame);
        assert!(l2_length_error(&mesh, &metric, &frame.positions) < 0.08);
    }
    // One half is the other one, turned. Which of them was computed decides how a turn back is rounded.
    let exchange = Exchange::of_sphere(&sphere, 2).expect("a symmetric mesh");
    for k in 0..40 {
        let other = exchange.exchanged(&frames[80 - k].positions);
        let off = other.iter().zip(&frames[k].positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(off < 1e-12, "frame {k}: {off}");
    }
}

/// The fewest faces that get over.
const SMALL: &str = "[mesh]\nshape = 'octasphere'\nsubdivisions = 8\n[start]\nhalfway = 2\n[bending]\nbending_stiffness = 0.03\n\
                     [clock]\nboth_ways = true\nframes = 5\n";

#[test]
fn the_same_bits_on_one_thread_and_after_a_resume() {
    let mut whole = scene(SMALL).simulation().expect("a simulation");
    let frames: Vec<_> = (0..5).map(|_| whole.next_frame(&mut Unobserved).expect("a frame")).collect();
    let mut resumed = scene(SMALL).simulation().expect("a simulation");
    resumed.resume(frames[1].clone()).expect("its own film");
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    for frame in &frames[2..] {
        let again = one.install(|| resumed.next_frame(&mut Unobserved)).expect("a frame");
        assert!(again.positions == frame.positions && again.face_frames == frame.face_frames);
        assert_eq!(again.report.enclosed_volume, frame.report.enclosed_volume);
    }
}

#[test]
fn what_goes_with_frames_alone_is_refused() {
    for (from, to, reason) in [
        ("halfway = 2", "from = 'mesh'", "halfway model"),
        ("frames = 5", "frames = 5\nloop = true", "neither loop"),
        ("frames = 5", "frames = 5\n[[pin]]\nvertices = [0]", "pins"),
    ] {
        let text = SMALL.replace(from, to);
        let scene = immerse::Scene::parse(&text, "film", "".as_ref());
        let told = match scene {
            Err(mistakes) => mistakes.to_string(),
            Ok(scene) => scene.simulation().expect_err(reason).to_string(),
        };
        assert!(told.contains(reason), "{told}");
    }
    let icosphere = SMALL.replace("'octasphere'", "'sphere'");
    let error = scene(&icosphere).simulation().expect_err("no symmetry");
    assert!(error.to_string().contains("octasphere"), "{error}");
}

/// A ring of figure eights with the lengths of a flat torus.
const RING: &str = "[mesh]\nshape = 'flat_torus'\na = [4.8, 0]\nb = [0, 1.0392304845]\ncolumns = 48\nrows = 12\n[spin]\nclass = '10'\n\
                    [start]\nfrom = 'figure eight'\n[bending]\nbending_stiffness = 0.003\n[clock]\nboth_ways = true\nframes = 61\n";

#[test]
fn a_flat_torus_turns_inside_out() {
    let mut simulation = scene(RING).simulation().expect("a simulation");
    let frames: Vec<_> = (0..61).map(|_| simulation.next_frame(&mut Unobserved).expect("a frame")).collect();
    let mut homotopy = Homotopy::new(simulation.mesh());
    for frame in &frames {
        assert_eq!((frame.report.rims, frame.report.pinch_points), (0, 0), "frame {}", frame.report.frame);
        assert!(frame.report.l2_length_error < 0.06, "frame {}", frame.report.frame);
        homotopy.append(frame.positions.clone()).expect("a surface of the mesh");
    }
    assert!(homotopy.events().is_empty());
    for k in [0, 60] {
        assert!(frames[k].report.l2_length_error < 1.5e-3, "{}", frames[k].report.l2_length_error);
    }
    // The eight turns by half a turn: what was above the crossing is below it in the end, all along the ring.
    let above = |k: usize, j: usize| {
        let height = |j: usize| (0..48).map(|i| frames[k].positions[48 * j + i].z).sum::<f64>() / 48.0;
        height(j) - height(3)
    };
    assert!(above(0, 0) * above(60, 0) < 0.0 && above(0, 6) * above(60, 6) < 0.0);
    assert!(above(0, 0) * above(0, 6) < 0.0);
}

#[test]
fn a_ring_of_eights_takes_a_rectangle() {
    for (from, to) in [("b = [0,", "b = [1,"), ("shape = 'flat_torus'", "shape = 'flat_torus'\ngrid = 'square'")] {
        let error = scene(&RING.replace(from, to)).simulation().expect_err("no rectangle");
        assert!(error.to_string().contains("perpendicular"), "{error}");
    }
    let error = scene(&SMALL.replace("halfway = 2", "from = 'figure eight'")).simulation().expect_err("a sphere");
    assert!(error.to_string().contains("ring of a figure eight"), "{error}");
}
