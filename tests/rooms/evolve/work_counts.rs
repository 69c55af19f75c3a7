//! How much work small relaxations take: steps, iterations of the linear solves, and the error they end at. Counts do not
//! depend on the machine, so that they tell what timings would only suggest. The system of every step is factorized once.

use immerse::evolve::{Observer, Progress};
use immerse::scene::Scene;
use std::ops::ControlFlow;

/// What a relaxation took when it was last recorded.
struct Recorded {
    scene: &'static str,
    /// Steps in all phases.
    steps: usize,
    /// Iterations of all linear solves.
    inner_iterations: usize,
    l2_length_error: f64,
}

/// How much more is let pass.
const MARGIN: f64 = 1.1;

#[derive(Default)]
struct Tally {
    steps: Vec<usize>,
    inner_iterations: Vec<usize>,
}

impl Observer for Tally {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        let phases = progress.phases;
        self.steps.resize(phases, 0);
        self.inner_iterations.resize(phases, 0);
        self.steps[progress.phase] += 1;
        self.inner_iterations[progress.phase] += progress.inner_iterations;
        ControlFlow::Continue(())
    }
}

/// Fails if a relaxation takes more than what is recorded, and says what it takes now.
fn assert_no_more_than(recorded: &Recorded) {
    let scene = Scene::parse(recorded.scene, "counted", "".as_ref()).unwrap();
    let mut simulation = scene.simulation().unwrap();
    let mut tally = Tally::default();
    let report = &simulation.relax(&mut tally).unwrap().report;
    let steps: usize = tally.steps.iter().sum();
    let inner_iterations: usize = tally.inner_iterations.iter().sum();
    let now = format!(
        "steps: {steps}, inner_iterations: {inner_iterations}, l2_length_error: {:.4e}, with {:?} steps and {:?} inner \
         iterations by phase, {} faces, {} restarts",
        report.l2_length_error,
        tally.steps,
        tally.inner_iterations,
        simulation.mesh().face_count(),
        report.cursor.restarts,
    );
    eprintln!("{now}");
    assert_eq!((report.rims, report.pinch_points), (0, 0), "{now}");
    for (what, was, is) in [
        ("steps", recorded.steps as f64, steps as f64),
        ("inner iterations", recorded.inner_iterations as f64, inner_iterations as f64),
        ("length error", recorded.l2_length_error, report.l2_length_error),
    ] {
        assert!(
            is <= MARGIN * was,
            "{what} grew from {was} to {is}. If that is the price of something better, write down in \
             tests/rooms/evolve/work_counts.rs what it takes now:\n{now}"
        );
    }
}

#[test]
fn a_sphere_takes_no_more_work() {
    assert_no_more_than(&Recorded {
        scene: "[mesh]\nshape = 'sphere'\nsubdivisions = 8",
        steps: 32,
        inner_iterations: 128,
        l2_length_error: 3.547e-5,
    });
}

#[test]
fn a_flat_torus_takes_no_more_work() {
    assert_no_more_than(&Recorded {
        scene: "[mesh]\nshape = 'flat_torus'\na = [2.2, 0]\nb = [0, 4.330127]\ncolumns = 22\nrows = 50\n[spin]\nclass = '10'",
        steps: 99,
        inner_iterations: 596,
        l2_length_error: 9.23e-4,
    });
}

#[test]
fn a_hyperbolic_disk_takes_no_more_work() {
    assert_no_more_than(&Recorded {
        scene: "[mesh]\nshape = 'hyperbolic_disk'\nradius = 2\nfaces = 1500",
        steps: 131,
        inner_iterations: 753,
        l2_length_error: 3.943e-4,
    });
}
