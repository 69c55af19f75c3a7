//! Polygons of any shape, cut into triangles: area, angles and corners are those of the polygon.

use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use crate::support::Random;
use glam::{DMat3, DVec3};
use immerse::mesh::shapes::PolyhedronSource;
use immerse::mesh::{Surface, read, shapes};
use immerse::metric::{Metric, lengths_of_positions};

fn input(name: &str) -> Surface {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/mesh/inputs/readers").join(name);
    read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// An OBJ file with these points and polygons.
fn obj(points: &[DVec3], polygons: &[Vec<usize>]) -> Result<Surface, String> {
    let mut text = String::new();
    for p in points {
        text += &format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z);
    }
    for polygon in polygons {
        text += &format!("f {}\n", polygon.iter().map(|v| (v + 1).to_string()).collect::<Vec<_>>().join(" "));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    std::fs::write(&path, text).unwrap();
    read(&path).map_err(|error| error.to_string())
}

fn metric(surface: &Surface) -> Metric {
    let positions = surface.positions.as_ref().unwrap();
    Metric::new(&surface.mesh, lengths_of_positions(&surface.mesh, positions)).unwrap()
}

/// The angle inside a polygon at each corner.
fn angles(surface: &Surface) -> Vec<f64> {
    let (mesh, metric) = (&surface.mesh, metric(surface));
    let around = |v| mesh.outgoing(v).map(|h| metric.corner_angle(h.face(), h.corner())).sum::<f64>();
    mesh.vertices().map(around).collect()
}

fn flat(points: &[[f64; 2]]) -> Vec<DVec3> {
    points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
}

/// Counterclockwise simple polygons with reflex and straight corners.
fn shapes_in_the_plane() -> Vec<Vec<DVec3>> {
    let star = |k: u32| {
        let (r, angle) = (if k.is_multiple_of(2) { 3.0 } else { 0.7 }, PI * f64::from(k) / 7.0);
        [r * angle.cos(), r * angle.sin()]
    };
    let spiral = |k: u32| {
        let (turn, inner) = if k < 40 { (k, 0.8) } else { (79 - k, 0.0) };
        let angle = 0.3 * f64::from(turn);
        let r = 1.0 + angle / PI / 2.0 - inner * 0.5;
        [r * angle.cos(), r * angle.sin()]
    };
    let tooth = |k: u32| [f64::from(k), if k.is_multiple_of(2) { 1.0 } else { 3.0 }];
    vec![
        flat(&[[1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 1.0], [1.0, 1.0]]), // an L
        flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]),             // a straight corner
        flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.5, 0.5], [1.0, 1.0], [0.4, 0.4]]), // a triangle with middles
        flat(&[[0.0, 0.0], [0.1, 0.0], [0.3, 0.0], [0.7, 0.0], [1.0, 0.0], [0.9, 1e-3]]), // many on one side, thin
        flat(&[[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]]),                        // an arrow
        flat(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0], [0.0, 1.0]]), // a T
        flat(&(0..14).map(star).collect::<Vec<_>>()),
        flat(&(0..80).rev().map(spiral).collect::<Vec<_>>()),
        // A comb, whose teeth end on one line.
        flat(&(0..9).rev().map(tooth).chain([[0.0, 0.0], [8.0, 0.0]]).collect::<Vec<_>>()),
    ]
}

fn area(polygon: &[DVec3]) -> f64 {
    let sum: DVec3 = (0..polygon.len()).map(|k| polygon[k].cross(polygon[(k + 1) % polygon.len()])).sum();
    0.5 * sum.length()
}

/// The angles inside a counterclockwise polygon in the plane z = 0.
fn interior_angles(polygon: &[DVec3]) -> Vec<f64> {
    let n = polygon.len();
    let angle = |k: usize| {
        let (next, last) = (polygon[(k + 1) % n] - polygon[k], polygon[(k + n - 1) % n] - polygon[k]);
        f64::atan2(next.cross(last).z, next.dot(last)).rem_euclid(TAU)
    };
    (0..n).map(angle).collect()
}

#[test]
fn an_l_shaped_prism_has_its_area_and_its_curvature() {
    for name in ["l_prism.obj", "l_prism.off", "l_prism.ply", "l_prism_binary.ply"] {
        let surface = input(name);
        let metric = metric(&surface);
        assert!((metric.total_area() - 14.0).abs() < 1e-12, "{name}: {}", metric.total_area());
        for v in surface.mesh.vertices() {
            let right = if v.index() % 6 == 5 { -FRAC_PI_2 } else { FRAC_PI_2 };
            let curvature = metric.curvature(&surface.mesh, v);
            assert!((curvature - right).abs() < 1e-12, "{name}, {v:?}: {curvature}");
        }
    }
}

/// Any shape, from any first corner, in either orientation, anywhere in space and of any size.
#[test]
fn area_and_angles_are_exact() {
    let mut random = Random::new(3);
    for (n, polygon) in shapes_in_the_plane().into_iter().enumerate() {
        let wanted = interior_angles(&polygon);
        assert!((wanted.iter().sum::<f64>() - (polygon.len() - 2) as f64 * PI).abs() < 1e-9, "polygon {n} is simple");
        for first in 0..polygon.len() {
            for (scale, offset) in [(1.0, 0.0), (1e-9, 0.0), (1e12, 0.0), (1.0, 1e6), (1e-200, 0.0)] {
                // In its plane as it is, too, where straight corners are exactly straight.
                let turned = DMat3::from_quat(random.frame());
                let turn = if first % 2 == 0 { DMat3::IDENTITY } else { turned };
                let place = |p: DVec3| scale * (turn * p) + DVec3::splat(offset);
                let points: Vec<DVec3> = polygon.iter().map(|&p| place(p)).collect();
                let mut corners: Vec<usize> = (0..polygon.len()).map(|k| (k + first) % polygon.len()).collect();
                if random.bit() {
                    corners.reverse();
                }
                let label = format!("polygon {n} from corner {first}, scale {scale}, offset {offset}");
                let surface = obj(&points, &[corners]).unwrap_or_else(|error| panic!("{label}: {error}"));
                assert_eq!(surface.mesh.vertex_count(), polygon.len(), "{label}");
                assert_eq!(surface.mesh.face_count(), polygon.len() - 2, "{label}");
                if scale == 1e-200 {
                    continue; // areas underflow
                }
                // Of the thin one, areas from lengths are as inexact as it is thin.
                let tolerance = if offset > 0.0 {
                    1e-6
                } else if n == 3 {
                    1e-9
                } else {
                    1e-11
                };
                let (has, right) = (metric(&surface).total_area(), scale * scale * area(&polygon));
                assert!((has / right - 1.0).abs() < tolerance, "{label}: area {has} instead of {right}");
                for (k, (has, right)) in angles(&surface).iter().zip(&wanted).enumerate() {
                    assert!((has - right).abs() < tolerance * 1e3, "{label}: angle {k} is {has}, not {right}");
                }
            }
        }
    }
}

/// No triangle is flatter than it has to be, even if corners are straight but for rounding.
#[test]
fn straight_corners_make_no_flat_triangles() {
    let mut random = Random::new(5);
    for trial in 0..200 {
        // A square with random corners on its sides, a few in the last bits off them.
        let mut polygon = Vec::new();
        for side in 0..4 {
            let [a, b] = [side, side + 1].map(|k| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][k % 4]);
            let mut parts: Vec<f64> = (0..random.below(5)).map(|_| 0.05 + 0.9 * random.unit()).collect();
            parts.sort_by(f64::total_cmp);
            for t in [0.0].into_iter().chain(parts) {
                let noise = if random.bit() { 1e-15 } else { 0.0 };
                let p = [0, 1].map(|k| a[k] + t * (b[k] - a[k]) + noise * (random.unit() - 0.5));
                polygon.push(DVec3::new(p[0], p[1], 0.0));
            }
        }
        let turn = random.frame();
        let points: Vec<DVec3> = polygon.iter().map(|&p| turn * p).collect();
        if (0..points.len()).any(|k| points[k].distance(points[(k + 1) % points.len()]) < 1e-3) {
            continue;
        }
        let surface = obj(&points, &[(0..points.len()).collect()]).unwrap();
        assert_eq!(surface.mesh.face_count(), points.len() - 2);
        let metric = metric(&surface);
        let thinnest = metric.face_areas().iter().copied().fold(f64::INFINITY, f64::min);
        assert!(thinnest > 1e-5, "trial {trial}: a face of area {thinnest:e} of {} corners", points.len());
    }
}

#[test]
fn a_straight_corner_stays_joined_to_its_neighbours() {
    let surface = input("straight_corner.obj");
    assert_eq!((surface.mesh.vertex_count(), surface.mesh.face_count()), (6, 5));
    // The corner on the side is inside the surface; nothing is torn there.
    let v = surface.mesh.vertices().nth(1).unwrap();
    assert!(!surface.mesh.is_boundary_vertex(v));
    assert!((metric(&surface).total_area() - 5.0).abs() < 1e-12);
}

/// A polygon that is bent: the cut is one along which neither side turns over.
#[test]
fn bent_polygons_do_not_turn_over() {
    let mut random = Random::new(11);
    for (n, polygon) in shapes_in_the_plane().into_iter().enumerate() {
        if n == 3 {
            continue; // thinner than it would be bent
        }
        for first in 0..polygon.len() {
            let points: Vec<DVec3> = polygon.iter().map(|&p| p + DVec3::Z * 0.02 * (random.unit() - 0.5)).collect();
            let corners: Vec<usize> = (0..polygon.len()).map(|k| (k + first) % polygon.len()).collect();
            let surface = obj(&points, &[corners]).unwrap();
            for [a, b, c] in surface.mesh.triangles().map_corners() {
                let normal = (points[b] - points[a]).cross(points[c] - points[a]).normalize();
                assert!(normal.z > 0.5, "polygon {n} from corner {first}: normal {normal}");
            }
            let has = metric(&surface).total_area();
            assert!((has / area(&polygon) - 1.0).abs() < 0.02, "polygon {n}: area {has}");
        }
    }
    // The quadrilateral of a saddle, and one that is folded by a right angle along its short diagonal.
    let saddle = [[0.0, 0.0, 0.2], [1.0, 0.0, -0.2], [1.0, 1.0, 0.2], [0.0, 1.0, -0.2]].map(DVec3::from);
    let folded = [[0.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.1, 1.0], [-1.0, -1.0, 0.0]].map(DVec3::from);
    for points in [saddle, folded] {
        for first in 0..4 {
            let surface = obj(&points, &[(0..4).map(|k| (k + first) % 4).collect()]).unwrap();
            let normal = |[a, b, c]: [usize; 3]| (points[b] - points[a]).cross(points[c] - points[a]);
            let faces = surface.mesh.triangles().map_corners();
            assert!(normal(faces[0]).dot(normal(faces[1])) > -1e-12, "from corner {first}: {faces:?}");
        }
    }
}

trait MapCorners {
    fn map_corners(&self) -> Vec<[usize; 3]>;
}

impl MapCorners for Vec<[u32; 3]> {
    fn map_corners(&self) -> Vec<[usize; 3]> {
        self.iter().map(|t| t.map(|v| v as usize)).collect()
    }
}

#[test]
fn convex_polygons_are_fans_around_their_first_corner() {
    let polygon: Vec<DVec3> =
        (0..9).map(|k| TAU * f64::from(k) / 9.0).map(|angle| DVec3::new(angle.cos(), 0.3, angle.sin())).collect();
    let surface = obj(&polygon, &[(0..9).map(|k| (k + 4) % 9).collect()]).unwrap();
    assert!(surface.mesh.triangles().iter().all(|t| t.contains(&4)), "{:?}", surface.mesh.triangles());
}

#[test]
fn outlines_that_cross_or_touch_themselves_are_refused() {
    let cases = [
        ("a bow tie", vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]),
        ("an uneven bow tie", vec![[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]]),
        ("a pentagram", (0..5).map(|k| 2.0 * TAU * f64::from(k) / 5.0).map(|a| [a.cos(), a.sin()]).collect()),
        ("a corner on another side", vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]]),
        ("two corners in one place", vec![[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]]),
    ];
    for (name, points) in cases {
        let n = points.len();
        for first in 0..n {
            let error = obj(&flat(&points), &[(0..n).map(|k| (k + first) % n).collect()]).map(|s| s.mesh.triangles());
            let error = error.expect_err(name);
            let line = format!("a.obj:{}: the outline of face 1 crosses or touches itself", n + 1);
            assert!(error.contains(&line), "{name}: {error}");
            assert!(error.contains("cut the face into simple polygons"), "{error}");
        }
    }
    // Through a vertex that is visited twice: one half is turned over.
    let points = flat(&[[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [-1.0, 1.0]]);
    let error = obj(&points, &[vec![0, 1, 2, 0, 3, 4]]).map(|s| s.mesh.triangles()).unwrap_err();
    assert!(error.contains("crosses or touches itself"), "{error}");
    // Twice around.
    let error = obj(&points, &[vec![0, 1, 2, 0, 1, 2]]).map(|s| s.mesh.triangles()).unwrap_err();
    assert!(error.contains("crosses or touches itself"), "{error}");
}

/// Text of each format that has polygons, with these points and one polygon, and its ending.
fn in_each_format(points: &[[f64; 2]], polygon: &[usize]) -> Vec<(&'static str, String)> {
    let rows = |start: &str| points.iter().map(|[x, y]| format!("{start}{x} {y} 0\n")).collect::<String>();
    let corners = |first: usize| polygon.iter().map(|v| format!(" {}", v + first)).collect::<String>();
    let (n, of) = (points.len(), polygon.len());
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {n}\nproperty double x\nproperty double y\nproperty double z\n\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let list = corners(0).trim().replace(' ', ",");
    let places: Vec<String> = points.iter().map(|[x, y]| format!("[{x},{y}]")).collect();
    vec![
        ("obj", format!("{}f{}\n", rows("v "), corners(1))),
        ("off", format!("OFF\n{n} 1 0\n{}{of}{}\n", rows(""), corners(0))),
        ("ply", format!("{header}{}{of}{}\n", rows(""), corners(0))),
        ("fold", format!("{{\"vertices_coords\": [{}], \"faces_vertices\": [[{list}]]}}", places.join(","))),
    ]
}

/// A side that is walked again, or a way out of the polygon and back, has corners that no triangle would have.
#[test]
fn outlines_that_retrace_themselves_are_refused_in_every_format() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0], [9.0, 9.0]];
    let read_in_each = |polygon: &[usize]| {
        in_each_format(&points, polygon).into_iter().map(|(ending, text)| {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join(format!("a.{ending}"));
            std::fs::write(&path, text).unwrap();
            (ending, read(&path).map_err(|error| error.to_string()))
        })
    };
    for polygon in [
        vec![0, 1, 2, 1, 2, 1, 2],    // a triangle whose side is walked five times
        vec![0, 1, 2, 3, 2, 3],       // of a square, three times
        vec![0, 1, 2, 5, 2, 3],       // out to a point and back
        vec![0, 1, 2, 3, 4, 3, 4, 3], // in to a point and back, twice
        vec![0, 1, 2, 1],             // there and back
        vec![0, 1, 2, 0, 1, 2, 3],    // nearly twice around
    ] {
        for first in 0..polygon.len() {
            let turned: Vec<usize> = (0..polygon.len()).map(|k| polygon[(k + first) % polygon.len()]).collect();
            for (ending, found) in read_in_each(&turned) {
                let error =
                    found.map(|surface| surface.mesh.triangles()).expect_err(&format!("{turned:?} as {ending}"));
                let from = usize::from(ending == "obj");
                let said = format!("the outline of face {from} crosses or touches itself");
                assert!(error.contains(&said) && error.contains("cut the face into simple"), "{turned:?}: {error}");
                assert!(ending == "fold" || error.contains(&format!("a.{ending}:")), "{error}");
            }
        }
    }
    // In to a point and back, once: a slit, whose end is a vertex inside.
    for (ending, found) in read_in_each(&[0, 1, 2, 3, 4, 3]) {
        let surface = found.unwrap_or_else(|error| panic!("{ending}: {error}"));
        assert_eq!((surface.mesh.face_count(), surface.mesh.vertex_count()), (4, 5));
        assert!((metric(&surface).total_area() - 16.0).abs() < 1e-12);
    }
    // Without positions nothing is lost without a word, either.
    for polygon in ["0,1,2,1,2,1,2", "0,1,2,3,2,3", "0,1,2,0,3,4"] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.fold");
        std::fs::write(&path, format!("{{\"faces_vertices\": [[{polygon}]]}}")).unwrap();
        let error = read(&path).map(|surface| surface.mesh.triangles()).unwrap_err().to_string();
        assert!(error.contains("the outline of face 0 crosses or touches itself"), "{polygon}: {error}");
    }
}

#[test]
fn repeated_corners_are_dropped_and_told() {
    let surface = input("repeated_corner.obj");
    assert_eq!(surface.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(surface.repairs, ["dropped a corner that repeats the one before it (face 1, line 5)"]);
    let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0]]);
    let surface = obj(&square, &[vec![1, 4, 2], vec![0, 1, 2, 2, 2, 3, 0]]).unwrap();
    assert_eq!(surface.mesh.face_count(), 3);
    assert!(surface.repairs[0].contains("dropped 3 corners") && surface.repairs[0].contains("face 2, line 7"));
    // Nothing of a face is left: that is no polygon.
    let error = obj(&square, &[vec![0, 1, 2], vec![2, 3, 3]]).unwrap_err();
    assert!(error.contains("two of them equal") && error.contains("a.obj:7: counted from 1, face 2"), "{error}");
}

#[test]
fn a_hole_may_be_joined_to_the_outside_by_a_cut() {
    let surface = input("keyhole.obj");
    assert_eq!((surface.mesh.vertex_count(), surface.mesh.euler_characteristic()), (8, 0));
    assert!((metric(&surface).total_area() - 12.0).abs() < 1e-12);
}

/// Corners with numbers of their own in one place, as along a seam, stay joined.
#[test]
fn corners_in_one_place_keep_their_faces() {
    let points = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 1.0], [0.0, 1.0]]);
    for first in 0..5 {
        let surface = obj(&points, &[(0..5).map(|k| (k + first) % 5).collect()]).unwrap();
        let faces: BTreeSet<[u32; 3]> = surface.mesh.triangles().into_iter().collect();
        assert_eq!((faces.len(), surface.mesh.vertex_count()), (3, 5));
        assert_eq!(faces.iter().filter(|t| t.contains(&2) && t.contains(&3)).count(), 1);
    }
}

#[test]
fn polyhedra_of_a_scene_may_have_concave_faces() {
    let l = [[1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [0.0, 1.0], [1.0, 1.0]];
    let vertices = [0.0, 1.0].iter().flat_map(|&z| l.iter().map(move |&[x, y]| [x, y, z])).collect();
    let sides = (0..6).map(|k| vec![k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6]);
    let polygons = [vec![0, 5, 4, 3, 2, 1], (6..12).collect()].into_iter().chain(sides).collect();
    let surface = shapes::polyhedron(&PolyhedronSource::Explicit { vertices, polygons }, 3).unwrap();
    assert!((metric(&surface).total_area() - 14.0).abs() < 1e-12);
    // An arrow, whose two halves are on either side of its short diagonal only.
    let vertices = vec![[0.0, 0.0, 0.0], [2.0, -1.0, 0.0], [0.5, 0.0, 0.0], [2.0, 1.0, 0.0]];
    for first in 0..4 {
        let polygons = vec![(0..4).map(|k| (k + first) % 4).collect()];
        let source = PolyhedronSource::Explicit { vertices: vertices.clone(), polygons };
        assert!((metric(&shapes::polyhedron(&source, 1).unwrap()).total_area() - 0.5).abs() < 1e-12);
    }
}
