//! Films of surfaces whose metric, pins or bending change with time: what every frame must satisfy, closed forms, and
//! the same bits however the film was made.

use crate::support::{is_at, program, scene};
use glam::{DMat3, DVec3};
use immerse::evolve::FrameReport;
use immerse::evolve::{EvolveError, Frame, Observer, Progress, Simulation, Unobserved};
use immerse::film::FilmFolder;
use immerse::mesh::EdgeId;
use immerse::metric::{MetricPart, NoMetric};
use immerse::spin::class_digits;
use std::fs;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

const TORUS: &str = "[mesh]\nshape = 'torus'\nminor_radius = 0.4\ncolumns = 16\nrows = 12\n[start]\nfrom = 'mesh'\n";
const SPHERE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 5\n[start]\nfrom = 'mesh'\n";
const RICCI: &str = "[[metric.change]]\nkind = 'ricci'\n";
/// A conformal wave that goes once around.
const WAVE: &str = "[[metric.change]]\nkind = 'conformal'\nlog_scale = '0.2 * (x*cos(2*PI*t) + y*sin(2*PI*t))'\n";

fn simulation(text: &str) -> Simulation {
    scene(text).simulation().expect(text)
}

/// All frames of a film, every one compared with the one before.
fn film(text: &str) -> (Simulation, Vec<Arc<Frame>>) {
    let mut simulation = simulation(text);
    let count = scene(text).clock.frames;
    let (mut frames, mut lengths): (Vec<Arc<Frame>>, Vec<f64>) = (Vec::new(), Vec::new());
    let class = simulation.spin().class(simulation.mesh(), simulation.metric(), simulation.homology());
    for number in 1..=count {
        let frame = simulation.next_frame(&mut Unobserved).expect("a frame");
        assert_eq!(frame.report.frame, number);
        let now = simulation.spin().class(simulation.mesh(), simulation.metric(), simulation.homology());
        assert_eq!(now, class, "frame {number} is of another class");
        assert_eq!(simulation.spin().figure_8_vertices(simulation.mesh(), simulation.metric()), [] as [usize; 0]);
        assert_eq!(frame.report.rims, frame.rims.len());
        assert_report(&simulation, frames.last().map(|frame| &**frame), &frame, &lengths);
        lengths = simulation.metric().edge_lengths().to_vec();
        frames.push(frame);
    }
    (simulation, frames)
}

/// Moves, strain and changes of rims, all over again from what the two frames are.
fn assert_report(simulation: &Simulation, before: Option<&Frame>, after: &Frame, lengths_before: &[f64]) {
    let report = &after.report;
    let Some(before) = before else {
        assert_eq!((report.max_move, report.median_move, report.strain), (0.0, 0.0, 0.0));
        assert_eq!((report.rims_born, report.rims_died, report.rims_moved), (0, 0, 0));
        return;
    };
    let mut moves = moves(before, after);
    moves.sort_by(f64::total_cmp);
    assert_eq!((report.max_move, report.median_move), (moves[moves.len() - 1], moves[moves.len() / 2]));
    let stretch = lengths_before.iter().zip(simulation.metric().edge_lengths()).map(|(a, b)| (b.ln() - a.ln()).abs());
    assert!((stretch.fold(0.0, f64::max) - report.strain).abs() < 1e-12);

    let gone: Vec<&EdgeId> = before.rims.iter().filter(|e| !after.rims.contains(e)).collect();
    let new: Vec<&EdgeId> = after.rims.iter().filter(|e| !before.rims.contains(e)).collect();
    assert_eq!((new.len(), gone.len()), (report.rims_born + report.rims_moved, report.rims_died + report.rims_moved));
    let touch = |a: &EdgeId, b: &EdgeId| {
        let ends = simulation.mesh().edge_vertices(*a);
        simulation.mesh().edge_vertices(*b).iter().any(|v| ends.contains(v))
    };
    let could_have_moved = new.iter().filter(|e| gone.iter().any(|g| touch(e, g))).count();
    assert!(report.rims_moved <= could_have_moved && (report.rims_moved > 0) == (could_have_moved > 0));
}

fn moves(before: &Frame, after: &Frame) -> Vec<f64> {
    before.positions.iter().zip(&after.positions).map(|(a, b)| a.distance(*b)).collect()
}

fn largest(values: Vec<f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

#[test]
fn a_torus_flows_to_a_flat_metric() {
    // With fewer columns it buckles so sharply that one rounding or another leaves a rim.
    let torus = TORUS.replace("columns = 16", "columns = 20");
    let (simulation, frames) = film(&format!("{torus}{RICCI}[clock]\nframes = 6\n"));
    let reports: Vec<&FrameReport> = frames.iter().map(|frame| &frame.report).collect();
    assert_eq!(reports.iter().map(|r| r.time).collect::<Vec<_>>(), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
    let errors: Vec<f64> = reports.iter().filter_map(|r| r.curvature_error).collect();
    assert!(errors.len() == 6 && errors.is_sorted_by(|a, b| a > b) && errors[5] < 1e-10, "{errors:?}");
    for report in &reports {
        assert!(report.l2_length_error < 0.05, "{report:?}");
        assert_eq!((report.rims, report.pinch_points), (0, 0));
        assert_eq!(report.spin_class, reports[0].spin_class);
        assert_eq!(report.pin_distance, None);
    }
    assert!(reports[0].mean_distance.is_some_and(|d| d < 0.01), "{:?}", reports[0].mean_distance);
    assert!(reports[1..].iter().all(|r| r.strain > 1e-3 && r.max_move > r.median_move && r.median_move > 0.0));
    assert_eq!(simulation.metric().edge_lengths().len(), simulation.mesh().edge_count());
}

/// A metric that only grows moves no frame: the surface grows about its centre, and nothing turns.
#[test]
fn a_growing_sphere_stays_the_sphere() {
    let (_, frames) = film(&format!("{SPHERE}[metric]\nformula = 'length * (1 + t)'\n[clock]\nframes = 6\n"));
    let first = &frames[0].positions;
    for (k, frame) in frames.iter().enumerate() {
        let size = 1.0 + 0.2 * k as f64;
        let off = largest(frame.positions.iter().zip(first).map(|(p, q)| p.distance(size * *q)).collect());
        assert!(off < 1e-3 * size, "frame {k}: {off}");
        assert!(frame.positions.iter().all(|p| (p.length() / size - 1.0).abs() < 0.01), "frame {k} is no sphere");
        if k > 0 {
            let report = &frame.report;
            assert!((report.max_move - 0.2).abs() < 0.003 && (report.median_move - 0.2).abs() < 0.003, "{report:?}");
            assert!((report.strain - (size / (size - 0.2)).ln()).abs() < 1e-12);
        }
    }
}

/// Rotations about x, then y, then z.
fn rotation([x, y, z]: [f64; 3]) -> DMat3 {
    DMat3::from_rotation_z(z.to_radians())
        * DMat3::from_rotation_y(y.to_radians())
        * DMat3::from_rotation_x(x.to_radians())
}

#[test]
fn pins_are_where_the_scene_leads_them() {
    let pins = "[[pin]]\nbox = [[-1, -1, 0.6], [1, 1, 1]]\nformula = ['x * (1 + 0.2*t)', 'y', 'z - 0.1*t*x']\n\
                [pin.motion]\ntimes = [0, 0.5, 1]\ntranslations = [[0, 0, 0], [0.1, 0, 0], [0.1, 0.2, 0.3]]\n\
                rotations = [[0, 0, 0], [20, 10, 0], [20, 10, 40]]\nease = 'smooth'\n\
                [[pin]]\nbox = [[-1, -1, -1], [1, 1, -0.8]]\n";
    let (simulation, frames) = film(&format!("{SPHERE}{pins}[clock]\nframes = 5\n"));
    let rest = immerse::mesh::shapes::sphere(1.0, 5).expect("a sphere").positions.expect("positions");
    for frame in &frames {
        let t = frame.report.time;
        let part = |t: f64| t * t * (3.0 - 2.0 * t);
        let (shift, angles) = if t <= 0.5 {
            let s = part(2.0 * t);
            (DVec3::new(0.1 * s, 0.0, 0.0), [20.0 * s, 10.0 * s, 0.0])
        } else {
            let s = part(2.0 * t - 1.0);
            (DVec3::new(0.1, 0.2 * s, 0.3 * s), [20.0, 10.0, 40.0 * s])
        };
        let led: Vec<usize> = (0..rest.len()).filter(|&v| rest[v].z >= 0.6).collect();
        let formula = |p: DVec3| DVec3::new(p.x * (1.0 + 0.2 * t), p.y, p.z - 0.1 * t * p.x);
        let center = led.iter().map(|&v| formula(rest[v])).sum::<DVec3>() / led.len() as f64;
        for &v in &led {
            let place = center + shift + rotation(angles) * (formula(rest[v]) - center);
            assert!(frame.positions[v].distance(place) < 1e-12, "time {t}: vertex {v}");
        }
        for v in (0..rest.len()).filter(|&v| rest[v].z <= -0.8) {
            assert!(frame.positions[v].distance(rest[v]) < 1e-12, "time {t}: vertex {v} is held");
        }
        assert!(frame.report.pin_distance.is_some_and(|d| d < 1e-12), "{:?}", frame.report.pin_distance);
        assert!(frame.positions.iter().all(|p| p.is_finite()));
    }
    assert!(frames[0].report.l2_length_error < 1e-3);
    assert_eq!(simulation.mesh().vertex_count(), rest.len());
}

/// With every vertex pinned the surface moves as one body.
#[test]
fn a_rigid_motion_of_all_vertices() {
    let pins = "[[pin]]\nball = [0, 0, 0, 2]\n[pin.motion]\ntimes = [0, 1]\n\
                translations = [[0, 0, 0], [0, 0, 2]]\nrotations = [[0, 0, 0], [0, 0, 90]]\n";
    let (_, frames) = film(&format!("{SPHERE}{pins}[clock]\nframes = 3\n"));
    for frame in &frames {
        assert!(frame.report.l2_length_error < 1e-12 && frame.report.rims == 0, "{:?}", frame.report);
    }
    for (v, p) in frames[0].positions.iter().enumerate() {
        let turned = DVec3::new(-p.y, p.x, p.z + 2.0);
        assert!(frames[2].positions[v].distance(turned) < 1e-12);
    }
}

#[test]
fn bending_that_turns_around() {
    let bending = "[bending]\nfrom = 'mesh'\namount = { times = [0, 1], values = [1, -1] }\n";
    let phase = "[[phase]]\nepsilon = [1, 0.05, 1, 0.1]\nmax_steps = 60\n";
    let (_, frames) = film(&format!("{SPHERE}{bending}{phase}[clock]\nframes = 5\nmax_steps = 30\n"));
    assert!(frames[0].report.l2_length_error < 1e-3, "its own angles hold the sphere: {:?}", frames[0].report);
    assert!(frames.iter().all(|frame| frame.positions.iter().all(|p| p.is_finite())));
    assert!(frames[1..].iter().all(|frame| frame.report.strain == 0.0 && frame.report.max_move > 1e-6));
    // The lengths pull one way, the angles the other: what is left of both grows.
    let energies: Vec<f64> = frames.iter().map(|frame| frame.report.energy).collect();
    assert!(energies.is_sorted(), "{energies:?}");
}

/// A film of the relaxation from random frames has rims that come, move and go.
#[test]
fn rims_are_counted() {
    let text = "[mesh]\nshape = 'sphere'\nsubdivisions = 6\n[start]\nrandom = 0\n[clock]\nframes = 16\n\
                [[phase]]\nepsilon = [1, 0.1, 1, 0.1]\nfeedback = 0.5\ncrease = 0\naccelerate = false\n";
    let (_, frames) = film(text);
    let sum = |count: fn(&FrameReport) -> usize| frames.iter().map(|frame| count(&frame.report)).sum::<usize>();
    assert!(sum(|r| r.rims_died) > 0 && sum(|r| r.rims_moved) > 0, "there is nothing to see");
    let balance = frames[0].rims.len() + sum(|r| r.rims_born) - sum(|r| r.rims_died);
    assert_eq!(balance, frames[frames.len() - 1].rims.len());
}

#[test]
fn a_loop_has_no_seam() {
    let text = format!("{TORUS}{WAVE}[clock]\nframes = 8\nloop = true\n");
    let (_, frames) = film(&text);
    let inner: Vec<f64> = frames[1..].iter().map(|frame| frame.report.max_move).collect();
    let seam = largest(moves(&frames[7], &frames[0]));
    let (least, most) = (inner.iter().copied().fold(f64::MAX, f64::min), inner.iter().copied().fold(0.0, f64::max));
    assert!(seam > 0.7 * least && seam < 1.3 * most, "{seam} between the ends, {inner:?} inside");
    // The torus has a symmetry by which every frame is the first one, turned.
    assert!(most < 1.3 * least, "{inner:?}");
    assert!(frames.iter().all(|frame| frame.report.l2_length_error < 0.05 && frame.report.rims == 0));
}

/// From its last frame a loop goes on to its end. There is no metric at some times that it would pass through on a way
/// back.
#[test]
fn a_loop_closes_forward() {
    let text =
        "[metric]\nformula = 'length * (1 + 0.2 * min(min(4*t, 4 - 4*t), 1)) + 0 * sqrt(abs(t - 0.375) - 0.05)'\n";
    let (_, frames) = film(&format!("{SPHERE}{text}[clock]\nframes = 4\nloop = true\n"));
    let sizes: Vec<f64> = frames.iter().map(|frame| frame.positions[0].length()).collect();
    for (size, expected) in sizes.iter().zip([1.0, 1.2, 1.2, 1.2]) {
        assert!((size / expected - 1.0).abs() < 0.01, "{sizes:?}");
    }
}

#[test]
fn all_classes_in_binary_order() {
    let text = "[mesh]\nshape = 'flat_torus'\ncolumns = 12\nrows = 10\n[spin]\nclass = 'all'\n[start]\nfrom = 'spectral'\n\
                [[phase]]\nmax_steps = 6\n[clock]\nframes = 4\n";
    let mut all = simulation(text);
    let mut all_times = all.clock().times().collect::<Vec<_>>().into_iter();
    for expected in ["00", "01", "10", "11"] {
        let frame = all.next_frame(&mut Unobserved).expect("a frame");
        assert_eq!(class_digits(&all.spin().class(all.mesh(), all.metric(), all.homology())), expected);
        assert_eq!(all.spin().figure_8_vertices(all.mesh(), all.metric()), [] as [usize; 0]);
        assert_eq!((frame.report.cursor.steps, frame.report.max_move), (6, 0.0), "every one starts over");
        // As the scene of that class alone.
        assert_eq!(frame.report.time, all_times.next().expect("a time"));
        let mut alone = simulation(&text.replace("all", expected).replace("frames = 4", "frames = 1"));
        let same = alone.next_frame(&mut Unobserved).expect("a frame");
        assert!(same.positions == frame.positions && alone.face_frames() == all.face_frames(), "{expected}");
    }
    let one_too_many = scene(&text.replace("frames = 4", "frames = 5"));
    let error = one_too_many.simulation().expect_err("five of four classes");
    assert!(is_at(&one_too_many, "clock.frames", &error) && error.to_string().contains("5 frames"), "{error}");
}

/// What every step was.
#[derive(Default)]
struct Steps(Vec<Progress>);

impl Observer for Steps {
    fn after_step(&mut self, progress: &Progress) -> ControlFlow<()> {
        self.0.push(*progress);
        ControlFlow::Continue(())
    }
}

#[test]
fn steps_adapt_to_the_turn() {
    let mut lengths = Vec::new();
    for target in [2.0, 3.0] {
        let text = format!(
            "[mesh]\nshape = 'sphere'\nsubdivisions = 6\n[start]\nrandom = 4\n[[phase]]\nepsilon = [1, 0.1, 1, 0.1]\n\
             dt = 1\nfeedback = 0.5\naccelerate = false\nturn = {target}\ntolerance = 0.01\nmax_steps = 61\n"
        );
        let mut steps = Steps::default();
        let frame = simulation(&text).advance(60, &mut steps).expect("a frame");
        // Random frames turn a lot whatever the step; after that the target is met.
        let turns: Vec<f64> = steps.0.iter().map(|step| step.turn).collect();
        assert!(turns[0] > 30.0 && turns[25..].iter().all(|turn| (turn / target - 1.0).abs() < 0.15), "{turns:?}");
        let mean = turns[25..].iter().sum::<f64>() / 35.0;
        assert!((mean / target - 1.0).abs() < 0.05, "{mean} instead of {target}");
        lengths.push(frame.report.cursor.dt);
        let fixed = simulation(&text.replace("turn =", "# turn =")).advance(60, &mut Unobserved).expect("a frame");
        assert_eq!(fixed.report.cursor.dt, 0.0, "steps of the length that the phase says");
    }
    assert!(lengths[0] > 0.0 && lengths[1] > lengths[0], "who turns more takes longer steps: {lengths:?}");
}

/// The film up to a frame, then another simulation that goes on from there.
fn assert_resumes(text: &str) {
    let bits = |frame: &Frame, simulation: &Simulation| {
        let positions: Vec<_> = frame.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
        let frames: Vec<_> = simulation.face_frames().iter().map(|q| q.to_array().map(f64::to_bits)).collect();
        (positions, frames, format!("{:?}", FrameReport { seconds: 0.0, ..frame.report.clone() }))
    };
    let count = scene(text).clock.frames;
    let mut whole = simulation(text);
    let mut frames = Vec::new();
    let mut states = Vec::new();
    for number in 1..=count {
        let frame = whole.next_frame(&mut Unobserved).expect("a frame");
        states.push(bits(&frame, &whole));
        assert_eq!(frame.report.frame, number);
        frames.push(frame);
    }
    for frame in frames.into_iter().take(count - 1) {
        let after = frame.report.frame;
        let mut resumed = simulation(text);
        resumed.resume(frame).expect("a state");
        for expected in &states[after..] {
            let frame = resumed.next_frame(&mut Unobserved).expect("a frame");
            assert!(bits(&frame, &resumed) == *expected, "other bits after frame {after}: {text}");
        }
    }
}

/// Films of each kind, with the name of each.
fn films() -> [(&'static str, String); 4] {
    let turn = "[[phase]]\nepsilon = [1, 0.1, 1, 0.1]\ndt = 1\nfeedback = 0.5\nturn = 1.5\ntolerance = 0.001\n";
    let pin =
        "[[pin]]\nvertices = [0, 40]\nformula = ['x', 'y', 'z - 0.1*t']\n[bending]\nfrom = 'mesh'\namount = '1 - t'\n";
    [
        ("ricci", format!("{TORUS}{RICCI}[clock]\nframes = 4\nmax_steps = 20\n")),
        (
            "turn",
            format!("[mesh]\nshape = 'sphere'\nsubdivisions = 5\n{turn}[clock]\nframes = 5\nsteps_per_frame = 3\n"),
        ),
        ("loop", format!("{TORUS}{WAVE}[clock]\nframes = 4\nloop = true\nmax_steps = 10\n")),
        ("pins", format!("{SPHERE}{pin}[clock]\nframes = 4\nmax_steps = 10\n")),
    ]
}

#[test]
fn films_resume_to_the_same_bits() {
    for (_, text) in films() {
        assert_resumes(&text);
    }
    let classes = "[mesh]\nshape = 'flat_torus'\ncolumns = 8\nrows = 6\n[spin]\nclass = 'all'\n[[phase]]\nmax_steps = 4\n\
                   [clock]\nframes = 4\n";
    assert_resumes(classes);
}

#[test]
fn films_on_disk_have_the_same_bytes_in_pieces_and_on_any_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    for (name, text) in films() {
        let (file, count) = (format!("{name}.toml"), scene(&text).clock.frames);
        fs::write(at.join(&file), &text).expect("a scene");
        let simulate = |out: &str, threads: &str| {
            let (code, said, err) = program(at, &["simulate", &file, "--out", out, "--threads", threads]);
            assert_eq!(code, 0, "{err}");
            said
        };
        let states = |out: &str| -> Vec<Vec<u8>> {
            let path = |k: usize| at.join(out).join(format!("frames/{k:06}.npz"));
            (1..=count).map(|k| fs::read(path(k)).expect("a frame")).collect()
        };
        let (one, two) = (format!("{name}1"), format!("{name}2"));
        simulate(&one, "1");
        simulate(&two, "2");
        let whole = states(&one);
        assert!(states(&two) == whole, "{name}: other bytes on two threads");
        assert!(whole.windows(2).all(|pair| pair[0] != pair[1]), "{name} stands still");
        let reports = reports(&at.join(&one), count);
        for first in [2, count] {
            for frame in first..=count {
                fs::remove_file(at.join(&one).join(format!("frames/{frame:06}.npz"))).expect("a frame");
            }
            let said = simulate(&one, "2");
            assert!(said.contains(&format!("{} were there", first - 1)), "{said}");
            assert!(states(&one) == whole, "{name}: other bytes after frame {first} and later were removed");
            assert_eq!(self::reports(&at.join(&one), count), reports, "{name}");
        }
    }
}

/// What is known of every frame, but for the time it took.
fn reports(folder: &Path, count: usize) -> Vec<FrameReport> {
    let cache = FilmFolder::open(folder).expect("a film");
    let report = |frame| FrameReport { seconds: 0.0, ..cache.read_report(frame).expect("a report") };
    (1..=count).map(report).collect()
}

/// Where the scene gives no metric, or no places, the film ends with the time and the key.
#[test]
fn films_end_where_the_scene_does() {
    let last = |text: &str| {
        let mut simulation = simulation(text);
        loop {
            if let Err(error) = simulation.next_frame(&mut Unobserved) {
                let shown = scene(text).fault(&error).expect("a key is at fault");
                break (error, shown);
            }
        }
    };
    let clock = "[clock]\nframes = 3\nmax_steps = 2\n";
    let metric = format!("{SPHERE}[metric]\nformula = 'length * sqrt(0.4 - t)'\n{clock}");
    let (error, _) = last(&metric);
    assert!(matches!(error, EvolveError::Metric(NoMetric { time: 0.5, part: MetricPart::Lengths, .. })), "{error}");
    let pin = format!("{SPHERE}[[pin]]\nvertices = [0]\nformula = ['x', 'y', 'z/(0.5 - t)']\n{clock}");
    let bending = format!("{SPHERE}[bending]\nfrom = 'mesh'\namount = 'ln(0.4 - t)'\n{clock}");
    for (text, key) in [(metric, "metric"), (pin, "pin[0]"), (bending, "bending.amount")] {
        let (error, shown) = last(&text);
        assert!(is_at(&scene(&text), key, &shown), "{key}: {shown}");
        for said in [error.to_string(), shown.to_string()] {
            assert!(said.contains("at time 0.5") && said.contains("; "), "{said}");
        }
    }
}
