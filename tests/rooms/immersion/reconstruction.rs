//! A surface whose metric and bending angles are given is found, up to a rigid motion, to rounding.

use crate::support::{Random, diameter, distance_up_to_rigid_motion, scene};
use glam::{DQuat, DVec3};
use immerse::evolve::{Phase, TimeStep, Unobserved};
use immerse::frames::Method;
use immerse::immersion::pinch_points;
use immerse::mesh::{Surface, shapes};

/// Bumps that no symmetry hides.
fn bumpy(mut surface: Surface, height: f64) -> Surface {
    let bump = |p: &mut DVec3| {
        let wave = (3.0 * p.x + 1.0).sin() * (2.0 * p.y).cos() + 0.5 * (4.0 * p.z - p.x).sin();
        *p += height * wave * (*p + DVec3::new(0.1, 0.2, 0.3));
    };
    surface.positions.iter_mut().flatten().for_each(bump);
    assert!(pinch_points(&surface.mesh, surface.positions.as_deref().unwrap_or_default()).is_empty());
    surface
}

fn sphere() -> Surface {
    bumpy(shapes::sphere(1.0, 6).expect("a sphere"), 0.1)
}

fn torus() -> Surface {
    bumpy(shapes::torus(1.0, 0.4, 24, 12).expect("a torus"), 0.05)
}

/// A disk that is no longer flat.
fn bowl() -> Surface {
    let mut surface = shapes::disk(1.0, 8).expect("a disk");
    let lift = |p: &mut DVec3| p.z = 0.4 * p.x * p.x - 0.2 * (2.0 * p.y + p.x).sin() + 0.1 * p.y.powi(3);
    surface.positions.iter_mut().flatten().for_each(lift);
    surface
}

/// Steps of full length with all stiffness equal, to the end.
fn to_the_end(method: Method, dt: f64, max_steps: usize) -> Phase {
    Phase {
        method,
        stiffness: [1.0; 4],
        dt: TimeStep::FaceAreas(dt),
        turn_radians: None,
        feedback: 0.0,
        periods: 0.0,
        crease: 0.0,
        accelerate: false,
        tolerance_radians: 1e-12,
        min_steps: 1,
        max_steps,
        untangle_steps: 0,
        solver_tolerance: 1e-10,
    }
}

struct Found {
    distance: f64,
    steps: usize,
    l2_length_error: f64,
    rims: usize,
}

/// Relaxes from perturbed (by this much) or random frames.
fn find(surface: &Surface, text: &str, perturbation: f64, phases: &[Phase]) -> Found {
    let mut simulation = scene(text).simulation_of(surface.clone()).expect("a simulation");
    simulation.change_phases(|own| *own = phases.to_vec()).expect("phases");
    let mut random = Random::new(1);
    let mut frames = simulation.face_frames();
    for frame in &mut frames {
        let v = perturbation * random.vector();
        *frame = (*frame * DQuat::from_xyzw(v.x, v.y, v.z, 1.0)).normalize();
    }
    simulation.set_face_frames(&frames).expect("unit quaternions");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    assert!(frame.report.converged, "{:?}", frame.report);
    let target = surface.positions.as_deref().expect("positions");
    Found {
        distance: distance_up_to_rigid_motion(target, &frame.positions) / diameter(target),
        steps: frame.report.cursor.steps,
        l2_length_error: frame.report.l2_length_error,
        rims: frame.report.rims,
    }
}

#[track_caller]
fn assert_found(name: &str, found: &Found) {
    assert!(found.distance < 1e-8, "{name}: {} of the diameter away after {} steps", found.distance, found.steps);
    assert!(found.l2_length_error < 1e-8 && found.rims == 0, "{name}: {}", found.l2_length_error);
}

const BENT: &str = "[spin]\nclass = 'immersion'\n[bending]\nfrom = 'mesh'\n[start]\n";

#[test]
fn from_perturbed_frames() {
    for (name, surface) in [("sphere", sphere()), ("torus", torus()), ("bowl", bowl())] {
        let text = format!("{BENT}from = 'mesh'");
        for (method, dt, most) in [(Method::Implicit, 1e4, 100), (Method::Newton, 1e6, 30)] {
            let found = find(&surface, &text, 0.3, &[to_the_end(method, dt, most)]);
            eprintln!("{name} {method:?} {} {}", found.steps, found.distance);
            assert_found(&format!("{name} by {method:?}"), &found);
        }
    }
}

#[test]
fn from_random_frames() {
    for (name, surface) in [("sphere", sphere()), ("torus", torus()), ("bowl", bowl())] {
        for seed in [0, 1] {
            let text = format!("{BENT}random = {seed}");
            let phases = [to_the_end(Method::Implicit, 300.0, 300), to_the_end(Method::Newton, 1e6, 30)];
            let found = find(&surface, &text, 0.0, &phases);
            eprintln!("{name} {seed} {} {}", found.steps, found.distance);
            assert_found(&format!("{name} from seed {seed}"), &found);
        }
    }
}

/// Frames of the mirror image, with the bending angles of the mirror image, make the mirror image.
#[test]
fn mirror_image() {
    let surface = sphere();
    let text = "[bending]\nfrom = 'mirror'\n[start]\nfrom = 'mirror'";
    let mut mirrored = surface.clone();
    mirrored.positions.iter_mut().flatten().for_each(|p| p.x = -p.x);
    let mut simulation = scene(text).simulation_of(surface.clone()).expect("a simulation");
    simulation.change_phases(|phases| *phases = vec![to_the_end(Method::Newton, 1e6, 30)]).expect("phases");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    let target = mirrored.positions.expect("positions");
    assert!(distance_up_to_rigid_motion(&target, &frame.positions) < 1e-8 * diameter(&target));
    let original = surface.positions.expect("positions");
    assert!(distance_up_to_rigid_motion(&original, &frame.positions) > 0.01 * diameter(&original));
}

/// Pinned vertices are where they are pinned, also where the surface would rather not have them.
#[test]
fn pins() {
    let surface = sphere();
    let text = format!("{BENT}from = 'mesh'\n[[pin]]\nvertices = [0, 5, 17]\n");
    let found = find(&surface, &text, 0.3, &[to_the_end(Method::Newton, 1e6, 30)]);
    // Pins hold the surface's place in space, but frames are free to turn as a whole.
    assert!(found.rims == 0);

    let text = "[start]\nfrom = 'mesh'\n[[pin]]\nvertices = [3, 1]\npositions = [[0, 0, 5], [1, 2, -3]]";
    let mut simulation = scene(text).simulation_of(surface).expect("a simulation");
    let frame = simulation.advance(3, &mut Unobserved).expect("a frame");
    assert!(frame.positions[3].distance(DVec3::new(0.0, 0.0, 5.0)) < 1e-12);
    assert!(frame.positions[1].distance(DVec3::new(1.0, 2.0, -3.0)) < 1e-12);
    assert!(frame.positions[0].is_finite());
}
