//! Lengths as a function of time: keys, what is between them, and changes, against closed forms.

use crate::support::{is_at, scene};
use glam::DVec3;
use immerse::evolve::EvolveError;
use immerse::mesh::{self, Surface};
use immerse::metric::{
    BoundaryCondition, CurvatureTarget, InteriorCurvature, Metric, MetricError, MetricPart, MetricProgram, NoMetric,
    RicciFlow, lengths_of_positions, uniformize,
};
use immerse::scene::{Scene, SceneError};
use std::f64::consts::{PI, TAU};

const SPHERE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n";
const TORUS: &str = "[mesh]\nshape = 'torus'\nminor_radius = 0.4\ncolumns = 16\nrows = 12\n";
const FLAT: &str = "[mesh]\nshape = 'flat_torus'\ncolumns = 10\nrows = 8\n";

/// A surface and what a scene says of its metric.
struct Case {
    surface: Surface,
    program: MetricProgram,
}

fn try_case(scene: &Scene) -> Result<Case, SceneError> {
    let surface = scene.surface().expect("a surface");
    let program = scene.program(&surface)?.metric;
    Ok(Case { surface, program })
}

fn case(text: &str) -> Case {
    try_case(&scene(text)).expect(text)
}

/// The first time at which there is no metric.
fn no_metric(mut case: Case, times: &[f64]) -> NoMetric {
    times.iter().find_map(|&time| case.program.at(&case.surface.mesh, time).err()).expect("a time without a metric")
}

impl Case {
    fn at(&mut self, time: f64) -> Vec<f64> {
        self.metric_at(time).0.edge_lengths().to_vec()
    }

    /// With how far curvatures are from the target.
    fn metric_at(&mut self, time: f64) -> (Metric, Option<f64>) {
        let at = self.program.at(&self.surface.mesh, time).expect("a metric");
        (at.metric, at.curvature_error)
    }

    fn of_mesh(&self) -> Vec<f64> {
        match (&self.surface.edge_lengths, &self.surface.positions) {
            (Some(lengths), _) => lengths.clone(),
            (_, positions) => lengths_of_positions(&self.surface.mesh, positions.as_ref().expect("positions")),
        }
    }

    /// `length exp((u_i + u_j)/2)`, u at the places of the vertices.
    fn scaled(&self, lengths: &[f64], u: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let places = self.surface.places().expect("places");
        let of_edge = |e: mesh::EdgeId| {
            let [i, j] = self.surface.mesh.edge_vertices(e).map(|v| u(places[v.index()]));
            lengths[e.index()] * ((i + j) / 2.0).exp()
        };
        self.surface.mesh.edges().map(of_edge).collect()
    }
}

/// Largest relative difference.
fn off(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

#[track_caller]
fn assert_same(a: &[f64], b: &[f64]) {
    assert!(off(a, b) < 1e-14, "off by {:e}", off(a, b));
}

#[test]
fn without_keys_lengths_are_those_of_the_mesh_at_all_times() {
    for text in [SPHERE, FLAT] {
        let mut plain = case(text);
        assert!(!plain.program.changes());
        assert_eq!([-1.0, 0.0, 7.0].map(|t| plain.at(t)), [(); 3].map(|()| plain.of_mesh()));
        assert_eq!(plain.metric_at(0.0).1, None, "no flow, no target");
    }
    let mut uniform = case(&format!("{FLAT}[metric]\nlength = 0.25\n"));
    assert!(uniform.at(0.0).iter().all(|length| *length == 0.25));
}

#[test]
fn formulas_of_edges() {
    let text = "[metric]\nformula = 'length * (3 + t + 0.1*x + 0.2*y + 0.3*z) + 0.01 * (dx^2 + 2*dy^2 + 3*dz^2)'\n";
    let mut formula = case(&format!("{SPHERE}{text}"));
    assert!(formula.program.changes());
    let (mesh, positions) = (formula.surface.mesh.clone(), formula.surface.positions.clone().expect("positions"));
    for time in [0.0, 0.5, 4.0] {
        let expected: Vec<f64> = mesh
            .edges()
            .map(|e| {
                let [a, b] = mesh.edge_vertices(e).map(|v| positions[v.index()]);
                let (m, d) = ((a + b) / 2.0, b - a);
                d.length() * (3.0 + time + 0.1 * m.x + 0.2 * m.y + 0.3 * m.z)
                    + 0.01 * (d.x * d.x + 2.0 * d.y * d.y + 3.0 * d.z * d.z)
            })
            .collect();
        assert_same(&formula.at(time), &expected);
    }
    // What needs no coordinates needs no positions.
    let mut flat = case(&format!("{FLAT}[metric]\nformula = '(1 + t) * length'\n"));
    let twice: Vec<f64> = flat.of_mesh().iter().map(|length| 2.0 * length).collect();
    assert_same(&flat.at(1.0), &twice);
}

/// The lengths of a map into space are those of the surface moved by it, to the bit.
#[test]
fn lengths_of_moved_positions() {
    let text = "[metric]\npositions = ['x * (1 + t)', 'y + 0.2 * z^2', 'z - 0.3 * t * x * y']\n";
    let mut moving = case(&format!("{SPHERE}{text}"));
    let (mesh, positions) = (moving.surface.mesh.clone(), moving.surface.positions.clone().expect("positions"));
    assert!(moving.program.changes());
    for t in [0.0, 0.4, 1.0] {
        let map = |p: &DVec3| DVec3::new(p.x * (1.0 + t), p.y + 0.2 * (p.z * p.z), p.z - 0.3 * t * p.x * p.y);
        let moved: Vec<DVec3> = positions.iter().map(map).collect();
        assert_same(&moving.at(t), &lengths_of_positions(&mesh, &moved));
    }
    let mut identity = case(&format!("{SPHERE}[metric]\npositions = ['x', 'y', 'z']\n"));
    assert_eq!(identity.at(0.3), identity.of_mesh());
    assert!(!identity.program.changes());
    // Charts can be rolled up: a plane into a cylinder of circumference 1, whose chords are known.
    let roll = "[metric]\npositions = ['cos(2*PI*x) / (2*PI)', 'sin(2*PI*x) / (2*PI)', 'y']\n";
    let mut tube = case(&format!("{FLAT}{roll}"));
    let places = tube.surface.places().expect("coordinates").to_vec();
    for (e, length) in tube.surface.mesh.clone().edges().zip(tube.at(0.0)) {
        let [a, b] = tube.surface.mesh.edge_vertices(e).map(|v| places[v.index()]);
        let chord = (PI * (b.x - a.x)).sin() / PI;
        assert!((length - chord.hypot(b.y - a.y)).abs() < 1e-15);
    }
}

#[test]
fn between_and_beyond_keys() {
    let keys = "[[metric.key]]\ntime = 1\n[[metric.key]]\ntime = 3\nformula = 'length * (2 + 0.3*z)'\n\
                [[metric.key]]\ntime = 4\nlength = 0.5\n";
    let (a, b) = {
        let mut base = case(SPHERE);
        let mut other = case(&format!("{SPHERE}[metric]\nformula = 'length * (2 + 0.3*z)'\n"));
        (base.at(0.0), other.at(0.0))
    };
    let c = vec![0.5; a.len()];
    let mix = |from: &[f64], to: &[f64], between: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        from.iter().zip(to).map(|(a, b)| between(*a, *b)).collect()
    };
    type Between = fn(f64, f64, f64) -> f64;
    let ways: [(&str, Between); 4] = [
        ("interpolation = 'lengths'", |a, b, s| (1.0 - s) * a + s * b),
        ("interpolation = 'squared'", |a, b, s| ((1.0 - s) * a * a + s * b * b).sqrt()),
        ("", |a, b, s| ((1.0 - s) * a * a + s * b * b).sqrt()),
        ("interpolation = 'logarithms'", |a, b, s| a.powf(1.0 - s) * b.powf(s)),
    ];
    for (way, between) in ways {
        for (ease, half) in [("linear", 0.5), ("in", 0.25), ("out", 0.75), ("smooth", 0.5)] {
            let mut keyed = case(&format!("{SPHERE}[metric]\n{way}\nease = '{ease}'\n{keys}"));
            assert!(keyed.program.changes());
            assert_eq!([1.0, 3.0, 4.0].map(|t| keyed.at(t)), [a.clone(), b.clone(), c.clone()], "keys to the bit");
            assert_same(&keyed.at(2.0), &mix(&a, &b, &|a, b| between(a, b, half)));
            assert_same(&keyed.at(3.5), &mix(&b, &c, &|a, b| between(a, b, half)));
            assert_eq!([-1.0, 0.9, 4.1, 99.0].map(|t| keyed.at(t)), [a.clone(), a.clone(), c.clone(), c.clone()]);

            let mut on = case(&format!("{SPHERE}[metric]\n{way}\nease = '{ease}'\nextrapolation = 'linear'\n{keys}"));
            assert_same(&on.at(0.875), &mix(&a, &b, &|a, b| between(a, b, -0.0625)));
            assert_same(&on.at(4.125), &mix(&b, &c, &|a, b| between(a, b, 1.125)));
            let mut again =
                case(&format!("{SPHERE}[metric]\n{way}\nease = '{ease}'\nextrapolation = 'repeat'\n{keys}"));
            assert_eq!(again.at(5.0), again.at(2.0));
            assert_eq!(again.at(-2.0), a, "3 before the first key");
        }
    }
}

#[test]
fn keys_may_move_themselves() {
    let text = "[metric]\ninterpolation = 'lengths'\n[[metric.key]]\ntime = 0\nformula = 'length * (1 + t)'\n\
                [[metric.key]]\ntime = 1\npositions = ['x', 'y', 'z * (3 + t)']\n";
    let mut keyed = case(&format!("{SPHERE}{text}"));
    let (mesh, positions) = (keyed.surface.mesh.clone(), keyed.surface.positions.clone().expect("positions"));
    let stretched: Vec<DVec3> = positions.iter().map(|p| DVec3::new(p.x, p.y, p.z * 3.5)).collect();
    let halves = keyed.of_mesh().into_iter().zip(lengths_of_positions(&mesh, &stretched));
    let expected: Vec<f64> = halves.map(|(a, b)| 0.5 * 1.5 * a + 0.5 * b).collect();
    assert_same(&keyed.at(0.5), &expected);
    // One key alone changes only if it does so itself.
    assert!(!case(&format!("{SPHERE}[[metric.key]]\ntime = 0\n")).program.changes());
    assert!(case(&format!("{SPHERE}[[metric.key]]\ntime = 0\nformula = 'length * (1 + t)'\n")).program.changes());
}

#[test]
fn conformal_factors() {
    for (shape, text, u) in [
        (SPHERE, "0.3*t*z + x*y", (|p, t| 0.3 * t * p.z + p.x * p.y) as fn(DVec3, f64) -> f64),
        (FLAT, "(1 - t) * sin(2*PI*x)", |p, t| (1.0 - t) * (TAU * p.x).sin()),
    ] {
        for (amount, factor) in [("", 1.0), ("amount = 0.5\n", 0.5), ("amount = -1\n", -1.0), ("amount = 0\n", 0.0)] {
            let change = format!("[[metric.change]]\nkind = 'conformal'\nlog_scale = '{text}'\n{amount}");
            let mut conformal = case(&format!("{shape}{change}"));
            for time in [0.0, 0.25, 1.0] {
                let expected = conformal.scaled(&conformal.of_mesh(), |p| factor * u(p, time));
                assert_same(&conformal.at(time), &expected);
            }
            assert!(conformal.program.changes());
        }
    }
    // A factor without coordinates scales the whole, also where there is nothing to locate vertices by.
    let blind = "[[metric.change]]\nkind = 'conformal'\nlog_scale = 'ln(1 + t)'\n";
    let mut grown = case(&format!("{FLAT}{blind}"));
    let thrice: Vec<f64> = grown.of_mesh().iter().map(|length| 3.0 * length).collect();
    assert_same(&grown.at(2.0), &thrice);
    let fixed = "[[metric.change]]\nkind = 'conformal'\nlog_scale = 'x'\n";
    assert!(!case(&format!("{SPHERE}{fixed}")).program.changes());
    assert!(case(&format!("{SPHERE}{fixed}amount = 't'\n")).program.changes());
}

#[test]
fn amounts_of_ricci_flow_are_its_times() {
    let mut ricci = case(&format!("{TORUS}[[metric.change]]\nkind = 'ricci'\n"));
    let (mesh, start) = (ricci.surface.mesh.clone(), ricci.of_mesh());
    let metric = Metric::new(&mesh, start.clone()).expect("a metric");
    let mut flow = RicciFlow::new(&mesh, &start, &CurvatureTarget::default()).expect("a flow");
    assert!(ricci.program.changes());

    // Left out, the amount is time, from 0 to 1.
    assert_eq!([-0.5, 0.0].map(|t| ricci.at(t)), [start.clone(), start.clone()]);
    assert_eq!([1.0, 1.5].map(|t| ricci.at(t)), [(); 2].map(|()| flow.limit().edge_lengths.clone()));
    for amount in [0.01, 0.3, 0.5, 0.9, 0.999] {
        assert_eq!(ricci.at(amount), flow.advance_to(-libm::log1p(-amount)).expect("lengths"), "amount {amount}");
    }
    // In any order.
    let (early, late) = (ricci.at(0.2), ricci.at(0.8));
    assert_eq!([ricci.at(0.8), ricci.at(0.2)], [late, early]);

    // The target is flat: at first all curvature is wrong, in the end none.
    let largest = mesh.vertices().map(|v| metric.curvature(&mesh, v).abs()).fold(0.0, f64::max);
    let errors = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| ricci.metric_at(t).1.expect("an error"));
    assert!((errors[0] - largest).abs() < 1e-12, "{errors:?} {largest}");
    assert!(errors.is_sorted_by(|a, b| a > b) && errors[4] < 1e-10, "{errors:?}");
    let flat = ricci.metric_at(1.0).0;
    assert!(mesh.vertices().all(|v| flat.curvature(&mesh, v).abs() < 1e-10));
    assert!((flat.total_area() / metric.total_area() - 1.0).abs() < 1e-12, "the area stays");

    let mut half = case(&format!("{TORUS}[[metric.change]]\nkind = 'ricci'\namount = 0.5\n"));
    assert!(!half.program.changes());
    assert_eq!(half.at(9.0), ricci.at(0.5));
}

#[test]
fn targets_of_ricci_flow() {
    // Curvature −1 decides the area of a surface of genus 2.
    let genus_two = "[mesh]\nshape = 'polyhedron'\nname = 'genus_two'\nsubdivisions = 3\n";
    let mut hyperbolic = case(&format!("{genus_two}[[metric.change]]\nkind = 'ricci'\ncurvature = -1\n"));
    let (metric, error) = hyperbolic.metric_at(1.0);
    assert!((metric.total_area() - 2.0 * TAU).abs() < 1e-9 && error < Some(1e-10));
    let mesh = &hyperbolic.surface.mesh;
    let areas = metric.vertex_areas(mesh);
    assert!(mesh.vertices().all(|v| (metric.curvature(mesh, v) + areas[v.index()]).abs() < 1e-10));

    // A disk turns by 360° in all, and is flat inside: a circle, near enough.
    let mut disk = case(
        "[mesh]\nshape = 'disk'\nrings = 6\n[metric]\nformula = 'length * (1 + 0.3*x)'\n\
                         [[metric.change]]\nkind = 'ricci'\nturning = 360\n",
    );
    let (metric, error) = disk.metric_at(1.0);
    let (mesh, base) = (disk.surface.mesh.clone(), disk.at(0.0));
    assert!(error < Some(1e-10));
    let rim = &mesh.boundary_loops()[0];
    let around: f64 = rim.iter().map(|&h| base[mesh.edge(h).index()]).sum();
    for (k, &h) in rim.iter().enumerate() {
        let before = rim[(k + rim.len() - 1) % rim.len()];
        let share = 0.5 * (base[mesh.edge(before).index()] + base[mesh.edge(h).index()]) / around;
        assert!((metric.curvature(&mesh, mesh.tail(h)) - TAU * share).abs() < 1e-10, "in proportion to length");
    }
    let inside = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v));
    assert!(inside.into_iter().all(|v| metric.curvature(&mesh, v).abs() < 1e-10));
    // As the flow itself says it.
    let turning = mesh.vertices().map(|v| metric.curvature(&mesh, v)).collect();
    let target = CurvatureTarget {
        interior: InteriorCurvature::Constant,
        boundary: BoundaryCondition::TurningAngles(turning),
        keep_area: true,
    };
    assert!(off(&uniformize(&mesh, &base, &target).expect("a disk").edge_lengths, metric.edge_lengths()) < 1e-9);

    // Free area: the mean of the log scale factors is 0, so that the product of the factors at vertices is 1.
    let mut free = case(&format!("{TORUS}[[metric.change]]\nkind = 'ricci'\nfree_area = true\n"));
    let mut kept = case(&format!("{TORUS}[[metric.change]]\nkind = 'ricci'\n"));
    let (free, kept) = (free.at(1.0), kept.at(1.0));
    let factor = free[0] / kept[0];
    assert!((factor - 1.0).abs() > 1e-3, "the area is another: {factor}");
    assert_same(&free, &kept.iter().map(|length| factor * length).collect::<Vec<_>>());
}

#[test]
fn regions_of_curvature() {
    let cap = |low: f64, high: f64, total: f64| {
        format!("[[metric.change.region]]\nbox = [[-1, -1, {low}], [1, 1, {high}]]\ntotal = {total}\n")
    };
    let text = format!("{SPHERE}[[metric.change]]\nkind = 'ricci'\n{}{}", cap(0.6, 1.0, 360.0), cap(-1.0, -0.7, 300.0));
    let mut caps = case(&text);
    let (metric, error) = caps.metric_at(1.0);
    assert!(error < Some(1e-10), "{error:?}");
    let (mesh, areas) = (&caps.surface.mesh, metric.vertex_areas(&caps.surface.mesh));
    let positions = caps.surface.positions.as_ref().expect("positions");
    let groups: [(&dyn Fn(f64) -> bool, f64); 3] =
        [(&|z| z >= 0.6, 360.0), (&|z| z <= -0.7, 300.0), (&|z| z < 0.6 && z > -0.7, 60.0)];
    for (among, degrees) in groups {
        let vertices: Vec<_> = mesh.vertices().filter(|v| among(positions[v.index()].z)).collect();
        let area: f64 = vertices.iter().map(|v| areas[v.index()]).sum();
        for &v in &vertices {
            let wanted = degrees.to_radians() * areas[v.index()] / area;
            assert!((metric.curvature(mesh, v) - wanted).abs() < 1e-10, "{degrees}: {v:?}");
        }
    }
}

/// Changes are made one after another, each to what the one before left.
#[test]
fn changes_in_order() {
    let conformal = |u: &str| format!("[[metric.change]]\nkind = 'conformal'\nlog_scale = '{u}'\n");
    let ricci = "[[metric.change]]\nkind = 'ricci'\namount = 1\n";
    let mut both = case(&format!("{TORUS}{}{}", conformal("0.2*x"), conformal("0.1*t*y*z")));
    let expected = both.scaled(&both.of_mesh(), |p| 0.2 * p.x + 0.1 * 0.5 * p.y * p.z);
    assert_same(&both.at(0.5), &expected);

    let limit = case(&format!("{TORUS}{ricci}")).at(0.0);
    let mut after = case(&format!("{TORUS}{ricci}{}", conformal("0.2*x")));
    let expected = after.scaled(&limit, |p| 0.2 * p.x);
    assert_same(&after.at(0.0), &expected);
    // The flat metric of a conformal class is one, up to its scale: the flow forgets what was done before it.
    let mut before = case(&format!("{TORUS}{}{ricci}", conformal("0.2*x*(1 + t)")));
    for time in [0.0, 1.0] {
        let found = before.at(time);
        let factor = found[0] / limit[0];
        assert!(off(&found, &limit.iter().map(|length| factor * length).collect::<Vec<_>>()) < 1e-9);
        assert!(before.metric_at(time).1 < Some(1e-10));
    }
    // A flow that starts from another metric at each time starts anew.
    let half = "[[metric.change]]\nkind = 'ricci'\namount = 0.5\n";
    let mut moving = case(&format!("{TORUS}[metric]\nformula = 'length * (1 + 0.2*t*x)'\n{half}"));
    for time in [0.0, 0.7, 0.2] {
        let start = case(&format!("{TORUS}[metric]\nformula = 'length * (1 + 0.2*t*x)'\n")).at(time);
        let mut flow = RicciFlow::new(&moving.surface.mesh, &start, &CurvatureTarget::default()).expect("a flow");
        assert_eq!(moving.at(time), flow.advance_to(-libm::log1p(-0.5)).expect("lengths"));
    }
}

/// The program of scenes/hyperbolic_disk.toml: disks of geodesic radius 5 and curvature −k².
#[test]
fn a_disk_whose_curvature_grows() {
    let text = |k: f64| {
        format!(
            "[mesh]\nshape = 'hyperbolic_disk'\nradius = 5\nfaces = 4000\n[parameters]\nk = {k:?}\n\
             s = 'tanh(2.5 * k) / tanh(2.5)'\n[[metric.change]]\nkind = 'conformal'\n\
             log_scale = 'ln(s / k * (1 - x^2 - y^2) / (1 - s^2 * (x^2 + y^2)))'\n"
        )
    };
    let mut whole = case(&text(1.0));
    assert!(off(&whole.at(0.0), &whole.of_mesh()) < 1e-12, "at k = 1 the lengths are those of the mesh");
    for k in [1.0, 0.7, 0.3, 0.08] {
        let mut disk = case(&text(k));
        let metric = disk.metric_at(0.0).0;
        let mesh = &disk.surface.mesh;
        let areas = metric.vertex_areas(mesh);
        let inside: Vec<_> = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)).collect();
        let curvature: f64 = inside.iter().map(|&v| metric.curvature(mesh, v)).sum();
        let area: f64 = inside.iter().map(|v| areas[v.index()]).sum();
        assert!((curvature / area + k * k).abs() < 0.04 * k * k + 0.005, "{k}: {}", curvature / area);
        // Area 4π sinh²(r k/2)/k² of the smooth disk, circumference 2π sinh(r k)/k.
        let smooth = 4.0 * PI * ((2.5 * k).sinh() / k).powi(2);
        let around: f64 = mesh.boundary_loops()[0].iter().map(|&h| metric.length(mesh.edge(h))).sum();
        assert!((metric.total_area() / smooth - 1.0).abs() < 0.025, "{k}: area {}", metric.total_area());
        assert!((around * k / (TAU * (5.0 * k).sinh()) - 1.0).abs() < 0.015, "{k}: {around} around");
    }
}

const CONFORMAL: &str = "[[metric.change]]\nkind = 'conformal'\n";
const RICCI: &str = "[[metric.change]]\nkind = 'ricci'\n";

/// A metric that is none at a time names time, part, edge and face, and the scene the key.
#[test]
fn errors_name_time_part_key_edge_and_face() {
    let conformal = |rest: &str| format!("{SPHERE}{CONFORMAL}{rest}");
    let ricci = |shape: &str, rest: &str| format!("{shape}{RICCI}{rest}");
    let (lengths, change) = (MetricPart::Lengths, MetricPart::Change(0));
    type Right = fn(&MetricError) -> bool;
    let cases: Vec<(String, MetricPart, &str, f64, Right)> = vec![
        (
            format!("{SPHERE}[metric]\nformula = 'length * (0.5 - t)'\n"),
            lengths,
            "metric",
            0.5,
            |e| matches!(e, MetricError::NotPositive { edge: 0, length, .. } if *length == 0.0),
        ),
        (
            format!("{SPHERE}[metric]\nformula = 'length * sqrt(0.4 - t)'\n"),
            lengths,
            "metric",
            0.5,
            |e| matches!(e, MetricError::NotPositive { edge: 0, length, .. } if length.is_nan()),
        ),
        (format!("{SPHERE}[metric]\npositions = ['x', 'y', 'z / (0.5 - t)']\n"), lengths, "metric", 0.5, |e| {
            matches!(e, MetricError::NotPositive { .. })
        }),
        (format!("{SPHERE}[metric]\npositions = ['x', 'y', 'z * (0.5 - t)']\n{RICCI}"), lengths, "metric", 0.5, |e| {
            matches!(e, MetricError::NotPositive { .. } | MetricError::TriangleInequality { .. })
        }),
        (
            format!(
                "{SPHERE}[metric]\nextrapolation = 'linear'\n[[metric.key]]\ntime = 0\nformula = '2*length'\n[[metric.key]]\ntime = 0.5\n"
            ),
            lengths,
            "metric.key",
            1.0,
            |e| matches!(e, MetricError::NotPositive { length, .. } if length.is_nan()),
        ),
        (
            conformal("log_scale = '9*t*x'\n"),
            change,
            "metric.change[0]",
            1.0,
            |e| matches!(e, MetricError::TriangleInequality { count, .. } if *count > 0),
        ),
        (conformal("log_scale = '1/(0.5 - t)'\n"), change, "metric.change[0]", 0.5, |e| {
            matches!(e, MetricError::LogScale { vertex: 0, .. })
        }),
        (
            conformal("log_scale = 'x'\namount = 'ln(0.4 - t)'\n"),
            change,
            "metric.change[0]",
            0.5,
            |e| matches!(e, MetricError::LogScale { value, .. } if value.is_nan()),
        ),
        (
            format!("{SPHERE}{CONFORMAL}log_scale = 'x'\n{CONFORMAL}log_scale = '1/(0.5 - t)'\n"),
            MetricPart::Change(1),
            "metric.change[1]",
            0.5,
            |e| matches!(e, MetricError::LogScale { vertex: 0, .. }),
        ),
        (ricci(TORUS, "amount = 'ln(0.4 - t)'\n"), change, "metric.change[0]", 0.5, |e| {
            matches!(e, MetricError::FlowTime { .. })
        }),
        (ricci(TORUS, "curvature = 1\n"), change, "metric.change[0]", 0.0, |e| {
            matches!(e, MetricError::GaussBonnet { .. })
        }),
        (ricci(SPHERE, "curvature = -1\n"), change, "metric.change[0]", 0.0, |e| {
            matches!(e, MetricError::GaussBonnet { .. })
        }),
        (
            ricci(SPHERE, "[[metric.change.region]]\nball = [0, 0, 0, 2]\ntotal = 90\n"),
            change,
            "metric.change[0]",
            0.0,
            |e| matches!(e, MetricError::GaussBonnet { .. }),
        ),
        (
            ricci(
                SPHERE,
                "[[metric.change.region]]\nball = [0, 0, 1, 0.5]\ntotal = 90\n[[metric.change.region]]\nball = [0, 0, 1, 0.2]\ntotal = 90\n",
            ),
            change,
            "metric.change[0].region[1]",
            0.0,
            |e| matches!(e, MetricError::TargetRegion { region: 1, .. }),
        ),
        (
            ricci(SPHERE, "[[metric.change.region]]\nvertices = [0]\ntotal = 360\n"),
            change,
            "metric.change[0].region[0]",
            0.0,
            |e| matches!(e, MetricError::TargetRegion { region: 0, .. }),
        ),
    ];
    for (text, part, key, time, right) in cases {
        let scene = scene(&text);
        let found = no_metric(try_case(&scene).expect(&text), &[0.0, 0.5, 1.0]);
        assert!(found.part == part && found.time == time && right(&found.error), "{text}: {found:?}");
        assert!(found.error.to_string().contains("; "), "no remedy: {found}");
        let shown = scene.fault(&EvolveError::Metric(found)).expect("a key is at fault");
        assert!(is_at(&scene, key, &shown), "{text}: {shown}");
    }
}

/// What is none at any time is refused before.
#[test]
fn what_is_no_program_is_refused_at_its_key() {
    let cases: Vec<(String, &str, &str)> = vec![
        (format!("{SPHERE}{CONFORMAL}log_scale = 'x + q'\n"), "metric.change[0].log_scale", "there is no `q`"),
        (
            format!("{SPHERE}{CONFORMAL}log_scale = 'x'\namount = 'x'\n"),
            "metric.change[0].amount",
            "formula `x`: there is no `x`",
        ),
        (
            format!(
                "{SPHERE}{RICCI}[[metric.change.region]]\nball = [0, 0, 1, 0.5]\ntotal = 90\n[[metric.change.region]]\nball = [0, 0, 9, 1]\ntotal = 90\n"
            ),
            "metric.change[0].region[1]",
            "nothing is selected; choose a larger region",
        ),
        (
            format!("{FLAT}[metric]\nformula = 'length * dx'\n"),
            "metric.formula",
            "the formula uses coordinates, but the mesh has no positions; use a mesh that has them",
        ),
        (
            format!("{SPHERE}[[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\nfile = 'none.obj'\n"),
            "metric.key[1].file",
            "none.obj",
        ),
        (format!("{SPHERE}[metric]\npositions = ['x', 'w', 'z']\n"), "metric.positions", "there is no `w`"),
        (
            format!("{SPHERE}[[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\ncsv = 'none.csv'\n"),
            "metric.key[1].csv",
            "none.csv",
        ),
    ];
    for (text, key, part) in cases {
        let scene = scene(&text);
        let Err(error) = try_case(&scene) else { panic!("{text}") };
        assert!(is_at(&scene, key, &error) && error.to_string().contains(part), "{text}: {error}");
        assert!(!error.reason.is_empty() && !error.remedy.is_empty(), "no remedy: {error}");
    }
}
