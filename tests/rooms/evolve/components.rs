//! Several components in one mesh: each ends as it does alone, whatever the others are.

use crate::support::{embedded, scene};
use glam::DVec3;
use immerse::evolve::{Frame, Simulation, Unobserved};
use immerse::mesh::{Mesh, Surface, shapes};
use immerse::metric::lengths_of_positions;
use std::sync::Arc;

/// Surfaces side by side in one mesh, each scaled and moved.
fn together(parts: &[(&Surface, f64, DVec3)]) -> Surface {
    let (mut faces, mut positions, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
    for (surface, scale, shift) in parts {
        let before = positions.len() as u32;
        // Those of the moved positions would differ by rounding.
        let own = lengths_of_positions(&surface.mesh, surface.positions.as_deref().expect("positions"));
        lengths.extend(own.into_iter().map(|length| length * scale));
        faces.extend(surface.mesh.triangles().into_iter().map(|corners| corners.map(|v| v + before)));
        positions.extend(surface.positions.iter().flatten().map(|p| *p * *scale + *shift));
    }
    let surface = embedded(Mesh::from_faces(positions.len(), &faces).expect("a mesh"), positions);
    Surface { edge_lengths: Some(lengths), ..surface }
}

fn relaxed(surface: &Surface, text: &str) -> (Simulation, Arc<Frame>) {
    let mut simulation = scene(text).simulation_of(surface.clone()).expect("a simulation");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    (simulation, frame)
}

fn torus() -> Surface {
    shapes::torus(1.0, 0.4, 30, 16).expect("a torus")
}

const SMALL: f64 = 1.0 / 128.0;
const ASIDE: DVec3 = DVec3::new(3.0, 0.0, 0.0);

/// A scale by a power of two changes no rounding, so frames must agree to the last bit up to where the surface lies.
#[test]
fn a_small_torus_beside_a_large_one_ends_as_it_does_alone() {
    // In other units numbers are rounded otherwise, and of a torus so coarse polish makes more of that than is asked here.
    let text = "[start]\nrandom = 1\n[polish]\nenabled = false";
    let (torus, both) = (torus(), together(&[(&torus(), 1.0, DVec3::ZERO), (&torus(), SMALL, ASIDE)]));
    let (alone, frame_alone) = relaxed(&torus, text);
    let (_, frame) = relaxed(&both, text);
    let n = torus.mesh.vertex_count();
    for (part, scale, shift) in [(&frame.positions[..n], 1.0, DVec3::ZERO), (&frame.positions[n..], SMALL, ASIDE)] {
        let far = frame_alone.positions.iter().zip(part).map(|(p, q)| ((*q - shift) / scale - *p).length());
        let far = far.fold(0.0, f64::max);
        assert!(far < 1e-9, "scale {scale}: {far}");
    }
    let report = &frame.report;
    assert_eq!(report.components.len(), 2);
    assert!(frame_alone.report.components.is_empty(), "one component needs no list");
    for component in &report.components {
        assert_eq!(component.faces, alone.mesh().face_count());
        assert_eq!(component.cursor, frame_alone.report.cursor);
        assert!((component.l2_length_error / frame_alone.report.l2_length_error - 1.0).abs() < 1e-6);
    }
    assert_eq!((report.rims, report.pinch_points, report.converged), (0, 0, frame_alone.report.converged));
    assert_eq!(report.cursor.steps, 2 * frame_alone.report.cursor.steps);
}

/// The same with lengths alone, from a sphere of few faces, a torus and a disk: phases depend on the number of faces.
#[test]
fn unlike_components_end_as_they_do_alone() {
    let ball = shapes::sphere(0.1, 2).expect("a sphere");
    let torus = torus();
    let disk = shapes::disk(7.0, 6).expect("a disk");
    let both = together(&[
        (&disk, 1.0, DVec3::new(0.0, 20.0, 0.0)),
        (&ball, 1.0, DVec3::ZERO),
        (&torus, 1.0, DVec3::new(4.0, 0.0, 0.0)),
    ]);
    let text = "[start]\nrandom = 5\n[spin]\nclass = \"01\"";
    let (simulation, frame) = relaxed(&both, text);
    let frames = simulation.face_frames();
    let mut first = 0;
    for (surface, text) in [(&disk, "[start]\nrandom = 5"), (&ball, "[start]\nrandom = 5"), (&torus, text)] {
        let (alone, frame_alone) = relaxed(surface, text);
        let own = &frames[first..first + surface.mesh.face_count()];
        first += own.len();
        // Placed otherwise they agree up to one rotation on the right.
        let turn = alone.face_frames()[0].conjugate() * own[0];
        let far = alone.face_frames().iter().zip(own).map(|(a, b)| (*a * turn - *b).length()).fold(0.0, f64::max);
        assert!(far < 1e-6, "{} faces: {far}", own.len());
        assert_eq!(frame_alone.report.rims, 0);
    }
    assert_eq!(first, frames.len());
    assert_eq!(frame.report.spin_class, "01");
}

/// Of two components only the one whose rims do not resolve is drawn anew.
#[test]
fn only_the_tangled_component_is_drawn_anew() {
    // So coarse a torus keeps rims in this class, and the sphere none.
    let text = "[start]\nrandom = 0\n[spin]\nclass = \"11\"";
    let coarse = shapes::torus(1.0, 0.4, 8, 6).expect("a torus");
    let ball = shapes::sphere(1.0, 3).expect("a sphere");
    let both = together(&[(&coarse, 1.0, DVec3::ZERO), (&ball, 1.0, ASIDE)]);
    let (_, frame) = relaxed(&both, text);
    let restarts: Vec<usize> = frame.report.components.iter().map(|component| component.cursor.restarts).collect();
    let rims: Vec<usize> = frame.report.components.iter().map(|component| component.rims).collect();
    assert!(rims[0] > 0 && restarts[0] == 8, "{rims:?} {restarts:?}");
    assert_eq!((restarts[1], rims[1]), (0, 0));
    assert_eq!(frame.report.rims, rims.iter().sum::<usize>());
    assert_eq!(frame.report.cursor.restarts, restarts.iter().sum::<usize>());
}

/// One component that does not converge makes the whole unconverged, and the report says which one it is.
#[test]
fn convergence_is_judged_by_component() {
    let text = "[start]\nrandom = 1\n[clock]\naccuracy = 0.02";
    let both = together(&[(&torus(), 1.0, DVec3::ZERO), (&torus(), SMALL, ASIDE)]);
    let (_, frame) = relaxed(&both, text);
    let errors: Vec<f64> = frame.report.components.iter().map(|component| component.l2_length_error).collect();
    assert!(errors.iter().all(|error| *error <= 0.02), "each is done for itself: {errors:?}");
    assert!(frame.report.converged);
}

/// A film that is resumed after a frame gives the same bits, with a component that changes beside one that does not.
#[test]
fn a_film_of_several_components_resumes() {
    let text = "[clock]\nframes = 4\n[start]\nrandom = 3\n[[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\n\
                positions = [\"x + 0.2 * min(x, 1) \", \"y\", \"z\"]";
    let both = together(&[(&torus(), 1.0, DVec3::ZERO), (&torus(), SMALL, ASIDE)]);
    let start = || scene(text).simulation_of(both.clone()).expect("a simulation");
    let mut whole = start();
    let mut frames: Vec<Arc<Frame>> = Vec::new();
    for number in 1..=4 {
        let frame = whole.next_frame(&mut Unobserved).expect("a frame");
        assert_eq!(frame.report.frame, number);
        frames.push(frame);
    }
    let mut resumed = start();
    resumed.resume(frames[1].clone()).expect("a frame of this film");
    for frame in &frames[2..] {
        let again = resumed.next_frame(&mut Unobserved).expect("a frame");
        assert_eq!(again.positions, frame.positions);
        assert_eq!(again.report.components, frame.report.components);
    }
    let n = torus().mesh.vertex_count();
    let move_of = |range: std::ops::Range<usize>, scale: f64| {
        let pairs = frames[3].positions[range.clone()].iter().zip(&frames[0].positions[range]);
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / scale
    };
    assert!(move_of(0..n, 1.0) > 0.1, "the first one changes");
    assert!(move_of(n..2 * n, SMALL) < 0.05, "the second one stands still");
}

/// Components that nothing says the place of do not lie in each other.
#[test]
fn components_without_places_stand_in_a_row() {
    let ball = shapes::sphere(1.0, 3).expect("a sphere");
    let mut pair = together(&[(&ball, 1.0, DVec3::ZERO), (&ball, 2.0, DVec3::ZERO)]);
    pair.edge_lengths =
        Some(immerse::metric::lengths_of_positions(&pair.mesh, pair.positions.as_ref().expect("positions")));
    pair.positions = None;
    let (_, frame) = relaxed(&pair, "[start]\nrandom = 0");
    let n = ball.mesh.vertex_count();
    let extent = |part: &[DVec3]| part.iter().fold((f64::MAX, f64::MIN), |(a, b), p| (a.min(p.x), b.max(p.x)));
    let ((_, end), (begin, _)) = (extent(&frame.positions[..n]), extent(&frame.positions[n..]));
    assert!(end < begin, "{end} {begin}");
}
