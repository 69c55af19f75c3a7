//! A surface from Rust without any scene.

use crate::support::scene;
use glam::DVec3;
use immerse::evolve::{Cursor, EvolveError, ImmersionError, Polishing, Program, Schedule, SetupError, Simulation};
use immerse::mesh::{Surface, SurfaceError, shapes};
use immerse::metric::{Lengths, MetricProgram, lengths_of_positions};
use immerse::spin::SpinError;
use immerse::{Immersion, Metric};
use std::ops::ControlFlow;

/// A torus of revolution and its metric.
fn torus() -> (immerse::Mesh, Vec<DVec3>, Metric) {
    let surface = shapes::torus(1.0, 0.4, 24, 12).expect("a torus");
    let positions = surface.positions.expect("positions");
    let metric = Metric::new(&surface.mesh, lengths_of_positions(&surface.mesh, &positions)).expect("a metric");
    (surface.mesh, positions, metric)
}

#[test]
fn it_is_the_simulation_that_a_scene_asks_for() {
    let (mesh, _, metric) = torus();
    let shape = Immersion::of(&mesh, &metric).class("01".parse().expect("a class")).seed(3).polish(Polishing::Off);
    let shape = shape.relax().expect("a shape");
    let text = "[mesh]\nshape = 'torus'\nminor_radius = 0.4\ncolumns = 24\nrows = 12\n[spin]\nclass = '01'\n\
                [start]\nrandom = 3\norientation = 'as it comes'\n[polish]\nenabled = false\n";
    let mut of_scene = scene(text).simulation().expect("a simulation");
    let frame = of_scene.next_frame(&mut immerse::evolve::Unobserved).expect("a frame");
    // The scene knows positions, and the immersion does not, so that they lie in other places.
    let [here, there] = [shape.report(), &frame.report].map(|report| report.l2_length_error);
    assert!((here - there).abs() < 1e-12, "{here} {there}");
    assert_eq!((&*shape.report().spin_class, shape.report().rims), ("01", frame.report.rims));
}

#[test]
fn lengths_come_from_numbers_of_vertices() {
    let (mesh, positions, metric) = torus();
    let again = Metric::from_fn(&mesh, |a, b| positions[a].distance(positions[b])).expect("a metric");
    assert!(again.edge_lengths().iter().zip(metric.edge_lengths()).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(Metric::from_fn(&mesh, |_, _| -1.0).is_err());
}

#[test]
fn it_starts_at_a_shape_and_stays_upon_it() {
    let (mesh, positions, metric) = torus();
    let shape = Immersion::of(&mesh, &metric).start_at(&positions).relax().expect("a shape");
    assert!(shape.report().l2_length_error < 1e-3);
    let farthest = shape.positions().iter().zip(&positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(farthest < 0.02, "{farthest}");
    let Cursor { phase, .. } = shape.report().cursor;
    assert_eq!(phase, Schedule::of_last_phase().phases().len());
}

#[test]
fn what_does_not_fit_is_said() {
    let (mesh, positions, metric) = torus();
    let error = Immersion::of(&mesh, &metric).class("0".parse().expect("a class")).relax().expect_err("one digit");
    assert!(matches!(
        error,
        ImmersionError::Setup(SetupError::Spin(SpinError::ClassLength { given: 1, generators: 2 }))
    ));
    assert!("02".parse::<immerse::Class>().is_err());
    let error = Immersion::of(&mesh, &metric).start_at(&positions[1..]).relax().expect_err("too few");
    assert!(matches!(error, ImmersionError::Setup(SetupError::Surface(SurfaceError::Count { .. }))), "{error}");
    let program = Program::of(MetricProgram::of(Lengths::fixed(metric.edge_lengths().to_vec())));
    let wrong = Surface {
        edge_lengths: Some(vec![1.0; 3]),
        ..Surface::from_positions(positions.clone(), &mesh.triangles()).expect("a torus")
    };
    let error = Simulation::new(wrong, program).expect_err("three lengths");
    assert!(matches!(error, SetupError::Surface(SurfaceError::Count { found: 3, .. })), "{error}");
    let mut steps = 0;
    let mut impatient = |_: &immerse::evolve::Progress| {
        steps += 1;
        if steps < 5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let error = Immersion::of(&mesh, &metric).relax_observed(&mut impatient).expect_err("stopped");
    assert_eq!(error, ImmersionError::Evolve(EvolveError::Stopped { steps: 5 }));
}

#[test]
fn an_obj_file_is_the_surface() {
    let (mesh, positions, metric) = torus();
    let shape = Immersion::of(&mesh, &metric).start_at(&positions).relax().expect("a shape");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("shape.obj");
    shape.write_obj(&path).expect("a file");
    let read = immerse::mesh::read(&path).expect("a surface");
    assert_eq!(read.positions.as_deref(), Some(shape.positions()));
    assert_eq!(read.mesh.triangles(), mesh.triangles());
    assert!(shape.write_obj(folder.path().join("nowhere/shape.obj")).is_err());
}
