//! The relaxation: what default phases reach, what the paper's own steps reach, and how it ends.

use crate::support::{distance_up_to_rigid_motion, embedded, scene};
use glam::DVec3;
use immerse::evolve::{Cursor, EvolveError, Frame, Observer, Phase, Progress, Simulation, TimeStep, Unobserved};
use immerse::frames::{Method, Shell, StepOptions, Stepper, energy, random_frames};
use immerse::immersion::{is_figure_8, pinch_points};
use immerse::mesh::{Mesh, Surface, shapes};
use immerse::spin::class_digits;
use std::ops::ControlFlow;
use std::sync::Arc;

/// All phases of the scene, to the end.
fn relaxed(text: &str) -> (Simulation, Arc<Frame>) {
    let mut simulation = scene(text).simulation().expect("a simulation");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    (simulation, frame)
}

/// An almost immersion in the class asked for, with a length error below the limit.
#[track_caller]
fn assert_good(text: &str, (simulation, frame): &(Simulation, Arc<Frame>), limit: f64) {
    let report = &frame.report;
    eprintln!(
        "{:.3} % in {} steps, {} rims: {text:?}",
        100.0 * report.l2_length_error,
        report.cursor.steps,
        report.rims
    );
    assert!(report.l2_length_error <= limit, "{text}: {}", report.l2_length_error);
    assert_eq!((report.rims, report.pinch_points), (0, 0), "{text}");
    assert!(pinch_points(simulation.mesh(), &frame.positions).is_empty());
    let measure = |positions: &[DVec3]| {
        let generators = simulation.homology().generators().iter();
        class_digits(&generators.map(|g| is_figure_8(simulation.mesh(), positions, &g.strip)).collect::<Vec<_>>())
    };
    let asked = simulation.spin().class(simulation.mesh(), simulation.metric(), simulation.homology());
    assert_eq!(measure(&frame.positions), class_digits(&asked), "{text}");
    assert_eq!(report.spin_class, class_digits(&asked));
}

#[test]
fn spheres() {
    for seed in 0..3 {
        for shape in ["sphere'\nsubdivisions = 8", "uv_sphere'\nmeridians = 32\nparallels = 16"] {
            let text = format!("[mesh]\nshape = '{shape}\n[start]\nrandom = {seed}");
            let result = relaxed(&text);
            assert_good(&text, &result, 1e-3);
            assert!(result.1.report.converged, "{text}: {:?}", result.1.report);
        }
    }
}

#[test]
fn flat_tori_of_every_class() {
    for class in ["00", "01", "10", "11"] {
        let shape = "[mesh]\nshape = 'flat_torus'\ncolumns = 36\nrows = 30\na = [3, 0]\nb = [0, 2.5]";
        let text = format!("{shape}\n[spin]\nclass = '{class}'\n[start]\nrandom = 0");
        let result = relaxed(&text);
        assert_good(&text, &result, 0.02);
        assert_eq!(result.1.report.spin_class, class);
    }
}

/// The class of the embedding, and one that turns a handle inside out.
#[test]
fn a_double_torus() {
    for class in ["0000", "0001"] {
        let text = format!(
            "[mesh]\nshape = 'polyhedron'\nname = 'genus_two'\nsubdivisions = 7\n[spin]\nclass = '{class}'\n[start]\nrandom = 0"
        );
        let result = relaxed(&text);
        assert_good(&text, &result, 0.02);
        assert_eq!(result.1.report.spin_class, class);
    }
}

#[test]
fn a_hyperbolic_disk() {
    let text = "[mesh]\nshape = 'hyperbolic_disk'\nradius = 2\nfaces = 1500";
    assert_good(text, &relaxed(text), 0.005);
}

/// Each component finds its own shape, wherever the other is in its own.
#[test]
fn components_are_independent() {
    let ball = shapes::sphere(1.0, 6).expect("a sphere");
    let small = shapes::sphere(0.5, 6).expect("a sphere");
    let (n, positions) = (ball.mesh.vertex_count(), ball.positions.clone().unwrap_or_default());
    let mut faces = ball.mesh.triangles();
    faces.extend(small.mesh.triangles().into_iter().map(|f| f.map(|v| v + n as u32)));
    // Side by side, where they are found again.
    let beside = small.positions.clone().unwrap_or_default().into_iter().map(|p| p + DVec3::new(3.0, 0.0, 0.0));
    let all: Vec<DVec3> = positions.iter().copied().chain(beside).collect();
    let pair = embedded(Mesh::from_faces(all.len(), &faces).expect("two spheres"), all);
    let mut simulation = scene("").simulation_of(pair).expect("a simulation");
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    assert_eq!((frame.report.rims, frame.report.pinch_points), (0, 0));
    assert!(frame.report.l2_length_error < 1e-3, "{}", frame.report.l2_length_error);
    for (part, radius, x) in [(&frame.positions[..n], 1.0, 0.0), (&frame.positions[n..], 0.5, 3.0)] {
        // From random frames a sphere may as well come out inside out.
        let distance = |radius: f64| {
            let expected: Vec<DVec3> = positions.iter().map(|p| radius * *p).collect();
            distance_up_to_rigid_motion(&expected, part)
        };
        assert!(distance(radius).min(distance(-radius)) < 0.03 * radius);
        let middle = part.iter().sum::<DVec3>() / part.len() as f64;
        assert!((middle - DVec3::new(x, 0.0, 0.0)).length() < 1e-6, "each lies on its own: {middle}");
    }
}

/// The round sphere is the two lowest modes of the connection Laplacian: there is next to nothing left to relax.
#[test]
fn spectral_start_is_the_round_sphere() {
    let text = "[mesh]\nshape = 'sphere'\nsubdivisions = 8\n[start]\nfrom = 'spectral'";
    let mut simulation = scene(text).simulation().expect("a simulation");
    let start = simulation.advance(0, &mut Unobserved).expect("a frame");
    eprintln!("spectral start: {}", start.report.l2_length_error);
    assert!(start.report.l2_length_error < 1e-3, "{}", start.report.l2_length_error);
    assert_eq!((start.report.rims, start.report.cursor.steps), (0, 0));
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    assert!(frame.report.converged && frame.report.l2_length_error < 1e-3, "{:?}", frame.report);
    assert!(frame.report.cursor.steps < 25, "{} steps", frame.report.cursor.steps);
}

/// The steps of Alg. 5 and 8 as printed and of Alg. 6 find the sphere too, at time steps that suit them.
#[test]
fn printed_methods_find_the_sphere() {
    let surface = shapes::sphere(1.0, 6).expect("a sphere");
    for (method, dt) in [(Method::Gradient, 1.0), (Method::Newton, 10.0)] {
        let mut simulation = scene("[start]\nrandom = 0").simulation_of(surface.clone()).expect("a simulation");
        let phase = |stiffness, feedback, max_steps| Phase {
            method,
            stiffness,
            dt: TimeStep::FaceAreas(dt),
            turn_radians: None,
            feedback,
            periods: 0.0,
            crease: 0.0,
            accelerate: false,
            tolerance_radians: 1e-3,
            min_steps: 3,
            max_steps,
            untangle_steps: 0,
            solver_tolerance: 1e-3,
        };
        let two = [phase([1.0; 4], 0.0, 600), phase([1.0, 0.01, 1.0, 0.1], 0.5, 600)];
        simulation.change_phases(|phases| *phases = two.to_vec()).expect("phases");
        let frame = simulation.relax(&mut Unobserved).expect("a frame");
        let report = &frame.report;
        eprintln!("{method:?}: {} steps, {}", report.cursor.steps, report.l2_length_error);
        assert!(report.converged && report.l2_length_error < 0.01, "{method:?}: {report:?}");
        assert_eq!((report.rims, report.pinch_points), (0, 0), "{method:?}");
    }
}

/// Every step without feedback lowers the energy, from wherever it starts, while time steps are moderate.
#[test]
fn energy_never_rises() {
    let surface = crate::support::surface(1, 1);
    let metric = crate::support::random_metric(&surface.0, &mut crate::support::Random::new(1));
    let homology = immerse::spin::Homology::new(&surface.0, &metric);
    let spin = immerse::spin::SpinStructure::new(&surface.0, &metric, &homology);
    let shell = Shell::new(&surface.0, &metric, &spin, None).expect("a shell");
    for (method, dt) in [(Method::Implicit, 1.0), (Method::Gradient, 0.05), (Method::Newton, 0.2)] {
        let stiffness = [1.0, 0.5, 1.0, 0.5];
        let options = StepOptions { method, stiffness, crease: 0.0, dt, solver_tolerance: 1e-8 };
        let mut frames = random_frames(shell.face_count(), 4);
        let mut stepper = Stepper::new(&shell);
        let start = energy(&shell, stiffness, &frames);
        let mut before = start;
        for step in 0..40 {
            stepper.advance(&shell, &options, &mut frames);
            let after = energy(&shell, stiffness, &frames);
            assert!(after <= before * (1.0 + 1e-6), "{method:?} at dt {dt}, step {step}: {before} to {after}");
            before = after;
        }
        assert!(before < 0.7 * start, "{method:?} at dt {dt}: {start} to {before}");
    }
}

/// Stops after so many steps.
struct Stop {
    after: usize,
    seen: Vec<Progress>,
}

impl Observer for Stop {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.seen.push(*progress);
        if self.seen.len() == self.after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

fn ball() -> Surface {
    shapes::sphere(1.0, 4).expect("a sphere")
}

#[test]
fn an_observer_can_stop() {
    let mut simulation = scene("").simulation_of(ball()).expect("a simulation");
    let mut observer = Stop { after: 5, seen: Vec::new() };
    let error = simulation.relax(&mut observer).expect_err("stopped");
    assert_eq!(error, EvolveError::Stopped { steps: 5 });
    assert_eq!(observer.seen.iter().map(|p| p.step).collect::<Vec<_>>(), [1, 2, 3, 4, 5]);
    // And what was stopped can go on.
    let frame = simulation.relax(&mut Unobserved).expect("a frame");
    assert!(frame.report.l2_length_error < 0.01 && frame.report.converged);
}

#[test]
fn steps_are_counted_and_phases_end_when_frames_stand_still() {
    let mut simulation = scene("").simulation_of(ball()).expect("a simulation");
    let mut observer = Stop { after: usize::MAX, seen: Vec::new() };
    let frame = simulation.relax(&mut observer).expect("a frame");
    assert_eq!(frame.report.cursor.steps, observer.seen.len());
    assert_eq!(frame.report.cursor.phase, simulation.phases().len());
    for now in &observer.seen {
        assert!(now.step <= now.max_steps && now.phases == simulation.phases().len());
        assert_eq!(now.settled, now.turn < now.tolerance && now.step >= simulation.phases()[now.phase].min_steps);
    }
    let settled = observer.seen.iter().filter(|now| now.settled).count();
    assert_eq!(settled, simulation.phases().len(), "every phase settles on so small a mesh");
    // Nothing more happens after the end.
    let again = simulation.advance(7, &mut Unobserved).expect("a frame");
    assert_eq!(again.report.cursor, frame.report.cursor);
    assert!((again.report.l2_length_error - frame.report.l2_length_error).abs() < 1e-12);
    assert!(distance_up_to_rigid_motion(&again.positions, &frame.positions) < 1e-12);
}

#[test]
fn too_few_steps_are_reported() {
    let mut simulation = scene("").simulation_of(ball()).expect("a simulation");
    let hurry = |phase: &mut Phase| (phase.min_steps, phase.max_steps, phase.tolerance_radians) = (2, 2, 1e-9);
    simulation.change_phases(|phases| phases.iter_mut().for_each(hurry)).expect("phases");
    let mut observer = Stop { after: usize::MAX, seen: Vec::new() };
    let frame = simulation.relax(&mut observer).expect("a frame");
    assert!(!frame.report.converged);
    assert_eq!(observer.seen.len(), 2 * simulation.phases().len());
    assert!(observer.seen.iter().all(|now| !now.settled));
}

/// A run in pieces, as a film makes it, is the run in one piece as long as steps are not accelerated.
#[test]
fn steps_can_be_taken_in_pieces() {
    let start = || {
        let mut simulation = scene("").simulation_of(ball()).expect("a simulation");
        let change = |phases: &mut Vec<Phase>| phases.iter_mut().for_each(|phase| phase.accelerate = false);
        simulation.change_phases(change).expect("phases");
        simulation
    };
    let whole = start().advance(12, &mut Unobserved).expect("a frame");
    let mut pieces = start();
    for steps in [1, 0, 4] {
        pieces.advance(steps, &mut Unobserved).expect("a frame");
    }
    let now = pieces.advance(0, &mut Unobserved).expect("a frame");
    let mut resumed = start();
    // No film yet: it becomes the state of the first frame.
    let mut first = Frame::clone(&now);
    first.report.frame = 1;
    resumed.resume(Arc::new(first)).expect("a metric");
    let last = resumed.advance(7, &mut Unobserved).expect("a frame");
    // Every piece is laid upon the reference, which rounds, and steps are solved for in single precision.
    let turn = 0.0;
    assert_eq!(Cursor { turn, ..last.report.cursor }, Cursor { turn, ..whole.report.cursor });
    let difference = (last.report.l2_length_error - whole.report.l2_length_error).abs();
    assert!(difference < 1e-6, "{difference}");
    let distance = distance_up_to_rigid_motion(&last.positions, &whole.positions);
    assert!(distance < 1e-5, "{distance}");
}

/// A time step that is no number ends in an error that names the phase, not in a frame.
#[test]
fn divergence_is_an_error() {
    let mut simulation = scene("").simulation_of(ball()).expect("a simulation");
    let leap =
        |phases: &mut Vec<Phase>| (phases[0].method, phases[0].dt) = (Method::Gradient, TimeStep::FaceAreas(1e200));
    simulation.change_phases(leap).expect("phases");
    let outcome = simulation.advance(20, &mut Unobserved);
    if let Err(error) = &outcome {
        assert!(matches!(error, EvolveError::Diverged { phase: 0, .. }));
        assert!(error.to_string().contains("lower `dt` of that phase"));
    }
    assert!(outcome.is_err() || simulation.face_frames().iter().all(|q| q.is_finite()));
}

/// The rims that an observer sees, of every step: restarts, phase, step, rims.
#[derive(Default)]
struct RimsSeen(Vec<[usize; 4]>);

impl Observer for RimsSeen {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.0.push([progress.restarts, progress.phase, progress.step, progress.rims]);
        ControlFlow::Continue(())
    }
}

/// Rims that are left after all phases go by patches around them, from the same random frames, to the same bits on any number
/// of threads. Without patches these frames were drawn nine times, and a rim was left each time.
#[test]
fn rims_go_by_patches_before_frames_are_drawn_anew() {
    let text = "[mesh]\nshape = 'implicit'\nedge_length = 0.14\nparts = [\n\
         { torus = { center = [-0.8, 0, 0], axis = [0, 0, 1], major_radius = 0.7, minor_radius = 0.25 } },\n\
         { torus = { center = [0.8, 0, 0], axis = [0, 0, 1], major_radius = 0.7, minor_radius = 0.25 }, blend = 0.2 },\n]\n\
         [start]\nrandom = 1\n[spin]\nclass = '0001'\n";
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let mut simulation = scene(text).simulation().expect("a simulation");
            let mut seen = RimsSeen::default();
            let frame = simulation.relax(&mut seen).expect("a frame");
            ((simulation, frame), seen.0)
        })
    };
    let (found, seen) = on_threads(1);
    assert_good(text, &found, 0.01);
    assert_eq!(found.1.report.cursor.restarts, 0);
    // The last phase begins again where it has ended with rims.
    let last = seen.iter().map(|[_, phase, ..]| *phase).max();
    let again = seen.windows(2).filter(|pair| Some(pair[0][1]) == last && pair[1][2] == 1).collect::<Vec<_>>();
    assert!(!again.is_empty() && again.iter().all(|pair| pair[0][3] > 0), "{again:?}");
    let (other, _) = on_threads(3);
    assert_eq!(found.1.positions, other.1.positions);
    assert_eq!(found.1.face_frames, other.1.face_frames);
}
