//! What cannot be computed ends with the time, the place and a remedy, and the last good frame stays.

use crate::support::scene;
use glam::DVec3;
use immerse::advice::Advice;
use immerse::evolve::{EvolveError, FarMove, Program, SetupError, Simulation, Start, Unobserved};
use immerse::mesh::{SurfaceError, shapes};
use immerse::metric::{Lengths, Metric, MetricError, MetricProgram, NoMetric};

const FILM: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 3\n[start]\nfrom = 'mesh'\n\
                    [metric]\nformula = 'length * (1 + 0.4 * t * z)'\n[clock]\nframes = 3\n";

fn simulation(text: &str) -> Simulation {
    scene(text).simulation().expect("a simulation")
}

#[test]
fn what_goes_too_far_between_two_frames_is_found_before() {
    let pin = "[[pin]]\nvertices = [5]\nformula = ['x', 'y', 'z + 1e6*t']\n";
    let mut film = simulation(&format!("{FILM}{pin}"));
    let error = film.frame_keys().expect_err("it flies off");
    let EvolveError::TooFar { time, what: FarMove::Pin { vertex, distance, .. }, .. } = error.clone() else {
        panic!("{error}");
    };
    assert_eq!((time, vertex, distance), (0.5, 5, 5e5));
    // And where nobody has looked.
    film.next_frame(&mut Unobserved).expect("the first frame");
    assert_eq!(film.next_frame(&mut Unobserved).map(|_| ()), Err(error));

    let mut film = simulation(&format!("{FILM}max_strain = 1e-9\n"));
    let error = film.frame_keys().expect_err("too many parts");
    assert!(matches!(error, EvolveError::TooFar { what: FarMove::Edge { .. }, .. }), "{error}");
    assert!(error.remedy().contains("max_strain"), "{error}");
    // A film of the relaxation goes there at once.
    simulation(&format!("{FILM}steps_per_frame = 2\n{pin}")).frame_keys().expect("it does not follow");
}

#[test]
fn long_films_are_looked_ahead_at_to_their_end() {
    let text = FILM.replace("frames = 3", "frames = 20000").replace("length *", "length * sqrt(0.9999 - t) *");
    let error = simulation(&text).frame_keys().expect_err("no lengths in the end");
    let EvolveError::Metric(NoMetric { time, .. }) = error else { panic!("{error}") };
    assert!((0.9999..=1.0).contains(&time), "{time}");
}

#[test]
fn lengths_and_places_have_a_range() {
    let surface = shapes::torus(1.0, 0.4, 12, 6).expect("a torus");
    let lengths = Lengths::of_surface(&surface).expect("lengths").at(0.0);
    let scaled = |scale: f64| Metric::new(&surface.mesh, lengths.iter().map(|l| scale * l).collect());
    for scale in [1e-13, 1e-3, 1e3, 1e14] {
        let metric = scaled(scale).expect("in range");
        let plain = scaled(1.0).expect("in range");
        assert!((metric.mean_face_area() / plain.mean_face_area() / (scale * scale) - 1.0).abs() < 1e-12);
    }
    for scale in [1e-300, 1e-154, 1e-20, 1e20, 1e80, 1e154, 1e300] {
        let error = scaled(scale).expect_err("out of range");
        assert!(matches!(error, MetricError::OutOfRange { edge: 0, .. }), "{error}");
        assert!(error.to_string().contains("from 1e-15 to 1e15") && error.remedy().contains("another unit"), "{error}");
    }

    let mut far = surface.clone();
    far.positions.as_mut().expect("positions")[7].y = 1e16;
    let error = far.check().expect_err("too far");
    assert!(matches!(error, SurfaceError::OutOfReach { vertex: 7, .. }), "{error}");

    let mut program = Program::of(MetricProgram::of(Lengths::fixed(lengths)));
    program.start = Start::at(vec![DVec3::new(0.0, -1e200, 0.0); surface.mesh.vertex_count()]);
    let error = Simulation::new(surface, program).expect_err("no place to start from");
    assert!(matches!(error, SetupError::StartPlace { vertex: 0, .. }), "{error}");
}

/// The same surface in other units, near both ends of the range.
#[test]
fn units_do_not_matter() {
    let error_at = |scale: f64| {
        let text = format!(
            "[mesh]\nshape = 'torus'\nmajor_radius = {scale:e}\nminor_radius = {:e}\ncolumns = 24\nrows = 10\n",
            0.4 * scale
        );
        simulation(&text).next_frame(&mut Unobserved).expect("a frame").report.l2_length_error
    };
    let plain = error_at(1.0);
    for scale in [1e-13, 1e14] {
        assert!((error_at(scale) / plain - 1.0).abs() < 0.5 && error_at(scale) < 0.01, "{scale:e}");
    }
}
