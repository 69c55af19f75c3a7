//! What holds of every surface that is polished.

use super::{polished, polished_by};
use crate::support::{Random, scene};
use glam::DVec3;
use immerse::evolve::{Frame, Unobserved};
use immerse::immersion::pinch_points;
use immerse::mesh::{VertexId, shapes};
use immerse::metric::{Metric, lengths_of_positions};
use immerse::polish::{Ending, Polish};
use std::sync::Arc;

#[test]
fn pinned_vertices_stay_to_the_last_bit() {
    let surface = shapes::torus(1.0, 0.4, 18, 10).expect("a torus");
    let (mesh, original) = (&surface.mesh, surface.positions.as_deref().expect("positions"));
    let metric = Metric::new(mesh, lengths_of_positions(mesh, original)).expect("a metric");
    let mut random = Random::new(5);
    let noisy: Vec<DVec3> = original.iter().map(|p| *p + random.vector() * 0.01).collect();
    let pinned = [3, 17, 90].map(VertexId::new);
    let out = polished(mesh, &metric, &noisy, &pinned);
    assert!(pinned.iter().all(|v| out.positions[v.index()] == noisy[v.index()]));
    assert!(out.report.l2_length_error < 0.5 * out.report.l2_length_error_before, "{:?}", out.report);
}

/// Whatever random frames a torus starts from, and whatever class it is asked for, polish leaves it in that class, without a
/// pinch point or a rim, and with no larger error;
/// of so coarse a torus it is much smaller in most cases.
#[test]
fn the_class_never_changes() {
    let mut better = 0;
    for seed in 0..3 {
        for class in ["00", "01", "10", "11"] {
            let text = format!(
                "mesh = {{ shape = 'flat_torus', a = [1, 0], b = [0, 1.7], columns = 12, rows = 20 }}\n\
                 spin.class = '{class}'\nstart.random = {seed}"
            );
            let report = scene(&text).simulation().expect("a simulation").next_frame(&mut Unobserved);
            let report = report.expect("a frame").report.clone();
            let polish = report.polish.expect("a static scene is polished");
            assert_eq!(
                (report.spin_class.as_str(), report.pinch_points, report.rims),
                (class, 0, 0),
                "{seed} {report:?}"
            );
            assert!(report.l2_length_error <= polish.l2_length_error_before, "{class} {seed} {polish:?}");
            better += usize::from(report.l2_length_error < 0.5 * polish.l2_length_error_before);
            assert!(polish.mean_bending <= 1.2 * polish.mean_bending_before + 1e-9, "{class} {seed} {polish:?}");
        }
    }
    assert!(better >= 8, "{better} of 12");
}

/// Patches that hold the error find better fits and none that are worse, short of 180° and with pinned vertices in place.
#[test]
fn rounds_of_local_search_make_tori_better() {
    let pinned = [5, 400].map(VertexId::new);
    let mut better = 0;
    for seed in 0..3 {
        let scene = scene(&format!(
            "mesh = {{ shape = 'flat_torus', a = [1, 0], b = [0, 1.7], columns = 24, rows = 40 }}\n\
             spin.class = '00'\nstart.random = {seed}\npolish.enabled = false"
        ));
        let mut simulation = scene.simulation().expect("a simulation");
        let frame = simulation.next_frame(&mut Unobserved).expect("a frame").clone();
        let polish = Polish { stiffness: 0.3, least_barrier: 1e-6, max_bending_growth: 1.0, ..Polish::default() };
        let once = polished_by(&polish, simulation.mesh(), simulation.metric(), &frame.positions, &pinned);
        let [without, with] = [0, 8].map(|rounds| {
            let polish = Polish { stiffness: 1e-9, rounds, ..polish };
            polished_by(&polish, simulation.mesh(), simulation.metric(), &once.positions, &pinned)
        });
        let [before, after] = [&without, &with].map(|out| out.report.l2_length_error);
        assert!(after <= before, "{seed}: {before} {after}");
        better += usize::from(after < 0.9 * before);
        assert!(pinned.iter().all(|v| with.positions[v.index()] == frame.positions[v.index()]));
        assert!(pinch_points(simulation.mesh(), &with.positions).is_empty());
    }
    assert!(better >= 1);
}

fn film(text: &str, after: Option<Arc<Frame>>) -> Vec<Arc<Frame>> {
    let scene = scene(text);
    let mut simulation = scene.simulation().expect("a simulation");
    let from = after.as_ref().map_or(0, |frame| frame.report.frame);
    after.into_iter().for_each(|frame| simulation.resume(frame).expect("a frame of this film"));
    (from..scene.clock.frames).map(|_| simulation.next_frame(&mut Unobserved).expect("a frame")).collect()
}

const BREATHING: &str = "mesh = { shape = 'torus', major_radius = 1, minor_radius = 0.4, columns = 24, rows = 12 }\n\
    start.from = 'mesh'\nclock.frames = 3\npolish.enabled = true\n\
    [metric]\nformula = 'length * (1 + 0.1 * t * z)'";

#[test]
fn a_polished_film_resumes_to_the_same_bits() {
    let whole = film(BREATHING, None);
    let resumed = film(BREATHING, Some(whole[0].clone()));
    for (frame, again) in whole[1..].iter().zip(&resumed) {
        assert_eq!(frame.positions, again.positions);
        assert_eq!(frame.face_frames, again.face_frames);
        assert_eq!(frame.report.polish, again.report.polish);
        let polish = frame.report.polish.expect("every frame is polished");
        assert!(polish.l2_length_error < polish.l2_length_error_before, "{polish:?}");
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let text = "mesh = { shape = 'flat_torus', a = [1, 0], b = [0, 1.7], columns = 24, rows = 40 }\n\
        spin.class = '01'\npolish.max_bending_growth = 0.1";
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| film(text, None))[0].positions.clone()
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(4));
}

/// What polish leaves alone has the rims that its own frames have, not those that other signs would give it.
#[test]
fn a_pinched_surface_is_left_alone_with_its_rims() {
    let text = "mesh = { shape = 'flat_torus', columns = 16, rows = 14 }\nstart.random = 0\n\
                clock = { frames = 2, steps_per_frame = 1 }\n[[phase]]\nmin_steps = 1\nmax_steps = 1\n[polish]\nenabled = ";
    let [plain, polished] = ["false", "true"].map(|enabled| film(&format!("{text}{enabled}"), None)[1].clone());
    assert!(plain.report.pinch_points > 0, "{:?}", plain.report);
    assert_eq!(polished.report.polish.expect("asked for").ending, Ending::Unchanged);
    assert_eq!((&plain.positions, &plain.rims), (&polished.positions, &polished.rims));
}
