//! Faces as thin as double precision bears, and what is said of thinner ones.

use std::f64::consts::PI;

use crate::support::{Random, program};
use glam::DVec3;
use immerse::evolve::Unobserved;
use immerse::mesh::{FaceId, Mesh};
use immerse::metric::{Metric, MetricError, TRIANGLE_MARGIN};
use immerse::scene::Scene;

fn triangle(lengths: [f64; 3]) -> Result<Metric, MetricError> {
    // Edges of a single face come in its own order.
    Metric::new(&Mesh::from_faces(3, &[[0, 1, 2]]).unwrap(), lengths.to_vec())
}

/// Angle at corner `k`, opposite the side from corner `k + 1` to `k + 2`, and area, of sides that are whole numbers
/// below 2^53: from differences without any rounding.
fn exact(sides: [i128; 3]) -> ([f64; 3], f64) {
    let whole: i128 = sides.iter().sum();
    let without = |k: usize| (whole - 2 * sides[k % 3]) as f64;
    let angle = |k: usize| {
        // The sides at the corner are those of k and k + 2.
        2.0 * f64::atan2((without(k) * without(k + 2)).sqrt(), (whole as f64 * without(k + 1)).sqrt())
    };
    ([0, 1, 2].map(angle), 0.25 * (whole as f64 * without(0) * without(1) * without(2)).sqrt())
}

#[test]
fn angles_and_areas_of_thin_triangles_are_exact() {
    let mut random = Random::new(7);
    let largest = (1i128 << 53) - 1;
    for slack in [1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-6, 1e-3] {
        for _ in 0..200 {
            // One long side and two that are hardly longer together; one of these may be tiny.
            let gap = (slack * 2.0 * largest as f64 * 1.01) as i128 + 1;
            let part = if random.bit() { random.unit() } else { random.unit() * slack };
            let short = gap + (part * (largest - 2 * gap) as f64) as i128;
            let mut sides = [largest, short, largest - short + gap];
            let turn = random.below(3);
            sides.rotate_left(turn);
            if sides.iter().any(|&side| side > largest) {
                continue;
            }
            let scale = f64::powi(2.0, -53 - random.below(40) as i32);
            let metric = triangle(sides.map(|side| side as f64 * scale)).unwrap();
            let (angles, area) = exact(sides);
            let face = FaceId::new(0);
            for (k, right) in angles.into_iter().enumerate() {
                let has = metric.corner_angle(face, k);
                // Relatively, where the angle is small; else what is missing to a straight one.
                let off = (has - right).abs() / right.min(1.0);
                let bound = if slack < 1e-9 { 4e-15 } else { 1e-7 };
                assert!(off < bound, "slack {slack:e}, sides {sides:?}: angle {k} is {has:e} instead of {right:e}");
            }
            assert!((metric.area(face) / (area * scale * scale) - 1.0).abs() < 1e-14, "slack {slack:e}: area");
        }
    }
}

const OF_THE_WILD: [f64; 3] = [0.2759044842552674, 0.13795249682100474, 0.13795198744758766];

#[test]
fn a_thin_face_is_used() {
    let metric = triangle(OF_THE_WILD).unwrap();
    let face = FaceId::new(0);
    let angles = [0, 1, 2].map(|k| metric.corner_angle(face, k));
    assert!((angles.iter().sum::<f64>() - PI).abs() < 1e-15);
    // Its longest side is opposite corner 2; its height is twice the area over that side.
    const RIGHT: f64 = 1.3558063536087907e-6; // with 60 digits
    let height = 2.0 * metric.area(face) / OF_THE_WILD[0];
    assert!((height / RIGHT - 1.0).abs() < 1e-13, "{height:e}");
    for (k, side) in [(0, OF_THE_WILD[2]), (1, OF_THE_WILD[1])] {
        assert!((side * f64::sin(angles[k]) / height - 1.0).abs() < 1e-12, "corner {k}");
    }
}

#[test]
fn what_is_said_of_thinner_faces_is_true() {
    let thin = triangle([2.0, 1.0, 1.0 + 1e-14]).unwrap_err();
    let said = thin.to_string();
    assert!(matches!(thin, MetricError::TooThin { count: 1, face: 0, .. }), "{said}");
    for words in ["1 face is too thin", "shorter than the sum of the others by 2.5e-15", "flip the longest side"] {
        assert!(said.contains(words), "`{words}` is missing in {said}");
    }
    assert!(!said.contains("triangle inequality"), "{said}");
    for none in [[2.0, 1.0, 1.0], [2.5, 1.0, 1.0], [2.0, 1.0, 1.0 - 1e-14]] {
        let error = triangle(none).unwrap_err();
        assert!(matches!(error, MetricError::TriangleInequality { count: 1, .. }), "{error}");
    }
    assert!(triangle([2.0, 1.0, 1.0 + 5.0 * TRIANGLE_MARGIN]).is_ok());
    // Of the two kinds, the one that is no triangle at all comes first.
    let two = Mesh::from_faces(4, &[[0, 1, 2], [1, 0, 3]]).unwrap();
    let lengths = two.edges().map(|e| match two.edge_vertices(e).map(|v| v.0) {
        [0, 1] | [1, 0] => 2.0,
        [_, 3] | [3, _] => 0.9,
        [1, 2] | [2, 1] => 1.0 + 1e-14,
        _ => 1.0,
    });
    let error = Metric::new(&two, lengths.collect()).unwrap_err();
    assert!(matches!(error, MetricError::TriangleInequality { count: 1, face: 1, .. }), "{error}");
}

/// A sphere of which one edge is cut near its middle, `height` times its length inside a face, which leaves a sliver.
fn sphere_with_sliver(height: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let surface = immerse::mesh::shapes::sphere(1.0, 6).unwrap();
    let (mut points, mut faces) = (surface.positions.unwrap(), surface.mesh.triangles());
    let [a, b, c] = faces[100];
    let [p, q, r] = [a, b, c].map(|v| points[v as usize]);
    let middle = 0.5 * (p + q);
    let across = (r - middle).reject_from(q - p).normalize();
    let m = points.len() as u32;
    points.push(middle + height * (q - p).length() * across);
    faces[100] = [a, b, m];
    faces.extend([[a, m, c], [m, b, c]]);
    (points, faces)
}

fn obj(points: &[DVec3], faces: &[[u32; 3]]) -> String {
    let vertices: String = points.iter().map(|p| format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z)).collect();
    vertices + &faces.iter().map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1)).collect::<String>()
}

#[test]
fn a_surface_with_a_sliver_is_found_from_random_frames() {
    for height in [1e-5, 1e-6, 2e-7] {
        let (points, faces) = sphere_with_sliver(height);
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("mesh.obj"), obj(&points, &faces)).unwrap();
        let text = "[mesh]\nfile = 'mesh.obj'\n[start]\nrandom = 1\n";
        let scene = Scene::parse(text, "sliver", folder.path()).unwrap();
        let mut simulation = scene.simulation().unwrap_or_else(|error| panic!("{height:e}: {error}"));
        let report = &simulation.relax(&mut Unobserved).unwrap().report;
        assert!(report.l2_length_error < 0.01 && report.pinch_points == 0, "{height:e}: {report:?}");
    }
}

#[test]
fn the_program_says_what_is_too_thin() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("film.toml"), "[mesh]\nfile = 'mesh.obj'\n").unwrap();
    let check = |height: f64| {
        let (points, faces) = sphere_with_sliver(height);
        std::fs::write(folder.path().join("mesh.obj"), obj(&points, &faces)).unwrap();
        program(folder.path(), &["check", "film.toml"])
    };
    assert_eq!(check(1e-6).0, 0);
    let (code, _, err) = check(3e-8);
    assert_eq!(code, 2);
    assert!(err.contains("1 face is too thin") && err.contains("help: flip the longest side"), "{err}");
}

/// Ricci flow takes thin faces, too: its own triangulation may flip them away.
#[test]
fn a_flow_may_start_from_a_sliver() {
    let (points, faces) = sphere_with_sliver(1e-6);
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mesh.obj"), obj(&points, &faces)).unwrap();
    let text = "[mesh]\nfile = 'mesh.obj'\n[[metric.change]]\nkind = 'ricci'\ncurvature = 1\n[start]\nrandom = 1\n";
    let scene = Scene::parse(text, "flow", folder.path()).unwrap();
    let simulation = scene.simulation().unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(simulation.mesh().face_count(), faces.len());
}
