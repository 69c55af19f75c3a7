//! Topology, orientation, sizes and triangle quality of every generated shape.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use immerse::mesh::shapes::{Body, Grid, Operation, PolyhedronSource, Shape, Solid};
use immerse::mesh::{Mesh, Surface};
use immerse::scene::Scene;

fn make(shape: Shape) -> Surface {
    shape.surface().unwrap()
}

#[track_caller]
fn refused(shape: Shape, words: &[&str]) {
    let message = shape.surface().map(|_| ()).unwrap_err().to_string();
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

#[track_caller]
fn assert_topology(mesh: &Mesh, euler: i64, genus: usize, boundaries: usize) {
    let found = (mesh.euler_characteristic(), mesh.genus(), mesh.boundary_loops().len(), mesh.components().len());
    assert_eq!(found, (euler, genus, boundaries, 1));
}

fn lengths(surface: &Surface) -> Vec<f64> {
    if let Some(lengths) = &surface.edge_lengths {
        return lengths.clone();
    }
    let positions = surface.positions.as_ref().unwrap();
    let mesh = &surface.mesh;
    mesh.edges().map(|e| mesh.edge_vertices(e).map(|v| positions[v.index()])).map(|[p, q]| p.distance(q)).collect()
}

/// Corner angles in degrees: all of a face in a row.
fn angles(surface: &Surface) -> Vec<[f64; 3]> {
    let lengths = lengths(surface);
    let length = |h| lengths[surface.mesh.edge(h).index()];
    let of = |f: immerse::mesh::FaceId| {
        [0, 1, 2].map(|k| {
            let h = f.halfedge(k);
            let (a, b, c) = (length(h.next()), length(h), length(h.previous()));
            ((b * b + c * c - a * a) / (2.0 * b * c)).acos().to_degrees()
        })
    };
    surface.mesh.faces().map(of).collect()
}

fn smallest_angle(surface: &Surface) -> f64 {
    angles(surface).into_iter().flatten().fold(180.0, f64::min)
}

fn corners(surface: &Surface) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    let positions = surface.positions.as_ref().unwrap();
    surface.mesh.faces().map(|f| surface.mesh.corners(f).map(|v| positions[v.index()]))
}

fn volume(surface: &Surface) -> f64 {
    corners(surface).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn area(surface: &Surface) -> f64 {
    corners(surface).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
}

#[test]
fn icospheres() {
    for n in [1, 2, 7] {
        let surface = make(Shape::Sphere { radius: 2.0, subdivisions: n });
        assert_topology(&surface.mesh, 2, 0, 0);
        assert_eq!((surface.mesh.vertex_count(), surface.mesh.face_count()), (10 * n * n + 2, 20 * n * n));
        assert!(surface.positions.as_ref().unwrap().iter().all(|p| (p.length() - 2.0).abs() < 1e-14));
        assert!(smallest_angle(&surface) > 45.0);
    }
    let ball = volume(&make(Shape::Sphere { radius: 2.0, subdivisions: 16 })) / (4.0 / 3.0 * PI * 8.0);
    assert!((0.99..1.0).contains(&ball), "{ball}");
}

#[test]
fn octaspheres() {
    for (n, sides) in [(1, 4), (7, 4), (5, 6), (4, 3)] {
        let surface = make(Shape::Octasphere { radius: 2.0, subdivisions: n, sides });
        assert_topology(&surface.mesh, 2, 0, 0);
        assert_eq!((surface.mesh.vertex_count(), surface.mesh.face_count()), (sides * n * n + 2, 2 * sides * n * n));
        assert!(surface.positions.as_ref().unwrap().iter().all(|p| (p.length() - 2.0).abs() < 1e-14));
        assert!(volume(&surface) > 0.0);
    }
    assert!(smallest_angle(&make(Shape::Octasphere { radius: 1.0, subdivisions: 12, sides: 4 })) > 36.0);
}

#[test]
fn halfway_models() {
    for (lobes, n) in [(2, 9), (3, 5), (4, 4)] {
        let surface = make(Shape::Halfway { lobes, subdivisions: n });
        assert_topology(&surface.mesh, 2, 0, 0);
        assert_eq!(surface.mesh.face_count(), 4 * lobes * n * n);
        // Half of what it encloses counts against the other half.
        assert!(volume(&surface).abs() < 1e-12);
        assert!(surface.positions.as_ref().unwrap().iter().all(|p| p.is_finite() && p.length() < 10.0));
    }
}

#[test]
fn uv_spheres() {
    for (meridians, parallels) in [(3, 1), (12, 2), (48, 24)] {
        let surface = make(Shape::UvSphere { radius: 0.5, meridians, parallels });
        assert_topology(&surface.mesh, 2, 0, 0);
        assert_eq!(surface.mesh.face_count(), 2 * meridians * parallels);
        assert!(surface.positions.as_ref().unwrap().iter().all(|p| (p.length() - 0.5).abs() < 1e-15));
        assert!(volume(&surface) > 0.0);
    }
}

#[test]
fn equilateral_flat_torus_has_equal_edges() {
    let b = [0.0, 50.0 * 0.05 * 3f64.sqrt() / 2.0];
    let surface = make(Shape::FlatTorus { a: [3.0, 0.0], b, columns: 60, rows: 50, grid: Grid::Equilateral });
    assert_topology(&surface.mesh, 0, 1, 0);
    assert_eq!((surface.mesh.vertex_count(), surface.mesh.edge_count(), surface.mesh.face_count()), (3000, 9000, 6000));
    assert!(surface.positions.is_none());
    assert!(surface.edge_lengths.unwrap().iter().all(|l| (l - 0.05).abs() < 1e-15));
}

#[test]
fn flat_tori_are_flat_on_any_lattice() {
    for (grid, columns, rows) in [
        (Grid::Equilateral, 3, 4),
        (Grid::Equilateral, 8, 6),
        (Grid::Square, 3, 3),
        (Grid::Square, 4, 5),
        (Grid::Square, 9, 7),
    ] {
        for b in [[0.0, 2.5], [0.7, 2.0], [-0.4, -1.5]] {
            let surface = make(Shape::FlatTorus { a: [2.0, 0.5], b, columns, rows, grid });
            assert_topology(&surface.mesh, 0, 1, 0);
            assert_eq!(surface.mesh.vertex_count(), columns * rows);
            let angles = angles(&surface);
            for v in surface.mesh.vertices() {
                let sum: f64 = surface.mesh.outgoing(v).map(|h| angles[h.face().index()][h.corner()]).sum();
                assert!((sum - 360.0).abs() < 1e-10, "{sum}");
            }
        }
    }
}

#[test]
fn tori_of_revolution() {
    let surface = make(Shape::Torus { major_radius: 1.0, minor_radius: 0.4, columns: 96, rows: 40 });
    assert_topology(&surface.mesh, 0, 1, 0);
    let share = volume(&surface) / (TAU * PI * 0.16);
    assert!((0.99..1.0).contains(&share), "{share}");
    assert!(smallest_angle(&surface) > 30.0);
}

#[test]
fn cylinders_and_annuli() {
    for rows in [1, 2, 25] {
        let surface = make(Shape::Cylinder { radius: 1.5, height: 2.0, columns: 64, rows });
        assert_topology(&surface.mesh, 0, 0, 2);
        assert_eq!(surface.mesh.face_count(), 128 * rows);
        for [a, b, c] in corners(&surface) {
            let middle = (a + b + c) / 3.0;
            assert!((b - a).cross(c - a).dot(DVec3::new(middle.x, middle.y, 0.0)) > 0.0);
        }
        let share = area(&surface) / (TAU * 1.5 * 2.0);
        assert!((0.99..1.01).contains(&share), "{share}");

        let surface = make(Shape::Annulus { inner_radius: 0.5, outer_radius: 1.0, columns: 64, rows });
        assert_topology(&surface.mesh, 0, 0, 2);
        assert!(corners(&surface).all(|[a, b, c]| (b - a).cross(c - a).z > 0.0));
    }
    let default = make(Shape::Cylinder { radius: 1.0, height: 2.0, columns: 64, rows: 24 });
    assert!(smallest_angle(&default) > 45.0);
}

#[test]
fn disks() {
    for rings in [1, 2, 24] {
        let surface = make(Shape::Disk { radius: 1.0, rings });
        assert_topology(&surface.mesh, 1, 0, 1);
        assert_eq!(surface.mesh.face_count(), 6 * rings * rings);
        assert_eq!(surface.mesh.boundary_loops()[0].len(), 6 * rings);
        assert!(corners(&surface).all(|[a, b, c]| (b - a).cross(c - a).z > 0.0));
        assert!(smallest_angle(&surface) > 35.0, "{}", smallest_angle(&surface));
    }
}

/// Area and total curvature of a hyperbolic disk, and the angles of its triangles.
#[test]
fn hyperbolic_disks() {
    for (curvature, radius, faces) in [(-1.0, 3.0, 19000), (-1.0, 5.0, 19000), (-4.0, 1.0, 2000), (-0.01, 3.0, 500)] {
        let surface = make(Shape::HyperbolicDisk { curvature, radius, faces });
        assert_topology(&surface.mesh, 1, 0, 1);
        assert!(surface.positions.is_none());
        let share = surface.mesh.face_count() as f64 / faces as f64;
        assert!((0.9..1.1).contains(&share), "{share}");
        let angle = smallest_angle(&surface);
        println!("K = {curvature}, R = {radius}, {} faces: smallest angle {angle:.1}", surface.mesh.face_count());
        assert!(angle > 30.0, "{angle}");
        let smallest: f64 = angles(&surface).iter().map(|t| t.iter().copied().fold(180.0, f64::min)).sum();
        let mean = smallest / surface.mesh.face_count() as f64;
        assert!(mean > 52.0, "the mean of the smallest angles is {mean}");

        // The area of the disk is 4π/|K| sinh²(√|K| R / 2), and by Gauss–Bonnet the vertices inside carry
        // the share of it that lies nearer to them than to the boundary.
        let k = curvature.abs();
        let exact = 4.0 * PI / k * (0.5 * radius * k.sqrt()).sinh().powi(2);
        let lengths = lengths(&surface);
        let area: f64 = surface
            .mesh
            .faces()
            .map(|f| {
                let [a, b, c] = f.halfedges().map(|h| lengths[surface.mesh.edge(h).index()]);
                let s = 0.5 * (a + b + c);
                (s * (s - a) * (s - b) * (s - c)).sqrt()
            })
            .sum();
        assert!((area / exact - 1.0).abs() < 0.03, "{area} {exact}");
        let angles = angles(&surface);
        let (mut defect, mut inside) = (0.0, 0.0);
        for v in surface.mesh.vertices().filter(|&v| !surface.mesh.is_boundary_vertex(v)) {
            let star: Vec<_> = surface.mesh.outgoing(v).collect();
            defect += TAU - star.iter().map(|h| angles[h.face().index()][h.corner()].to_radians()).sum::<f64>();
            inside += star.len() as f64 / 3.0 * area / surface.mesh.face_count() as f64;
        }
        assert!((defect / (curvature * inside) - 1.0).abs() < 0.03, "{defect} {inside}");
    }
}

#[test]
fn hyperbolic_boundary_lies_on_the_circle() {
    let surface = make(Shape::HyperbolicDisk { curvature: -1.0, radius: 2.0, faces: 1500 });
    let lengths = lengths(&surface);
    let boundary: Vec<f64> =
        surface.mesh.boundary_loops()[0].iter().map(|&h| lengths[surface.mesh.edge(h).index()]).collect();
    // A chord over the angle 2π/n: sinh(d/2) = sinh R sin(π/n).
    let chord = 2.0 * (2f64.sinh() * (PI / boundary.len() as f64).sin()).asinh();
    assert!(boundary.iter().all(|l| (l - chord).abs() < 1e-13));
}

#[test]
fn named_polyhedra() {
    for (name, faces, corner_count) in [
        ("tetrahedron", 4, 4),
        ("cube", 12, 8),
        ("octahedron", 8, 6),
        ("icosahedron", 20, 12),
        ("dodecahedron", 60, 20),
    ] {
        for n in [1, 2, 3, 8] {
            let source = PolyhedronSource::Named(name.into());
            let surface = make(Shape::Polyhedron { source, subdivisions: n });
            assert_topology(&surface.mesh, 2, 0, 0);
            assert_eq!(surface.mesh.face_count(), faces * n * n);
            assert!(volume(&surface) > 0.5, "{name}");
            // Curvature only at the corners, the same at each: 4π in all.
            let angles = angles(&surface);
            let curved: Vec<f64> = surface
                .mesh
                .vertices()
                .map(|v| 360.0 - surface.mesh.outgoing(v).map(|h| angles[h.face().index()][h.corner()]).sum::<f64>())
                .filter(|defect| defect.abs() > 1e-6)
                .collect();
            assert_eq!(curved.len(), corner_count, "{name}");
            assert!(curved.iter().all(|d| (d - 720.0 / corner_count as f64).abs() < 1e-6), "{name}");
        }
    }
}

#[test]
fn genus_two_polyhedron() {
    for n in [1, 4] {
        let source = PolyhedronSource::Named("genus_two".into());
        let surface = make(Shape::Polyhedron { source, subdivisions: n });
        assert_topology(&surface.mesh, -2, 2, 0);
        assert!((volume(&surface) - 13.0).abs() < 1e-10);
        assert!((area(&surface) - 50.0).abs() < 1e-10);
    }
}

#[test]
fn each_duck_has_the_tail_of_the_other() {
    let scene = Scene::read("scenes/double_duck.toml".as_ref()).expect("a scene");
    let surface = scene.surface().expect("ducks");
    assert_topology(&surface.mesh, -2, 2, 0);
    let faces = surface.mesh.face_count() as f64;
    assert!((faces / 11608.0 - 1.0).abs() < 0.03, "{faces} faces, not about as many as Fig. 18");
}

#[test]
fn explicit_polyhedra_are_oriented_and_checked() {
    let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 1.0]];
    let make_with = |polygons: Vec<Vec<usize>>| Shape::Polyhedron {
        source: PolyhedronSource::Explicit { vertices: vertices.clone(), polygons },
        subdivisions: 3,
    };
    let pyramid = vec![vec![0, 3, 2, 1], vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]];
    let surface = make(make_with(pyramid.clone()));
    assert_topology(&surface.mesh, 2, 0, 0);
    assert!((volume(&surface) - 1.0 / 3.0).abs() < 1e-14);
    let mut reversed = pyramid.clone();
    reversed[2].reverse();
    let surface = make(make_with(reversed));
    assert!(surface.repairs[0].contains("reversed 1 of 6") && volume(&surface) > 0.0);
    refused(make_with(vec![vec![0, 1, 9]]), &["polygon 0 names vertex 9", "only 5"]);
    refused(make_with(vec![vec![0, 1]]), &["polygon 0 has 2 corners"]);
    refused(make_with(vec![]), &["no faces"]);
    let unknown = Shape::Polyhedron { source: PolyhedronSource::Named("klein".into()), subdivisions: 1 };
    refused(unknown, &["`klein` is not known", "genus_two"]);
}

fn join(bodies: impl IntoIterator<Item = (Body, Operation, f64)>) -> Solid {
    let parts = bodies.into_iter().map(|(body, operation, blend)| Solid { body, operation, blend }).collect();
    Solid { body: Body::Group(parts), operation: Operation::Union, blend: 0.0 }
}

fn ball(center: [f64; 3], radius: f64) -> Body {
    Body::Sphere { center, radius }
}

fn ring(x: f64) -> Body {
    Body::Torus { center: [x, 0.0, 0.0], axis: [0.0, 0.0, 1.0], major_radius: 0.7, minor_radius: 0.25 }
}

/// Angles above 25 degrees, edges around the target, outward, closed.
#[track_caller]
fn assert_remeshed(surface: &Surface, target: f64, genus: usize) {
    assert_topology(&surface.mesh, 2 - 2 * genus as i64, genus, 0);
    assert!(volume(surface) > 0.0);
    let angle = smallest_angle(surface);
    let lengths = lengths(surface);
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    eprintln!(
        "{} faces, smallest angle {angle:.1}, mean edge {:.3} of the target",
        surface.mesh.face_count(),
        mean / target
    );
    assert!(angle > 25.0, "{angle}");
    assert!((0.85..1.15).contains(&(mean / target)), "{mean}");
    assert!(lengths.iter().all(|l| (0.45..1.7).contains(&(l / target))));
}

#[test]
fn implicit_primitives_lie_on_their_surfaces() {
    let single =
        |body| Shape::Implicit { solid: Solid { body, operation: Operation::Union, blend: 0.0 }, edge_length: 0.1 };
    let surface = make(single(ball([1.0, 2.0, 3.0], 0.8)));
    assert_remeshed(&surface, 0.1, 0);
    let center = DVec3::new(1.0, 2.0, 3.0);
    assert!(surface.positions.as_ref().unwrap().iter().all(|p| (p.distance(center) - 0.8).abs() < 1e-9));

    let surface = make(single(ring(0.3)));
    assert_remeshed(&surface, 0.1, 1);
    for p in surface.positions.as_ref().unwrap() {
        assert!((((p.x - 0.3).hypot(p.y) - 0.7).hypot(p.z) - 0.25).abs() < 1e-9);
    }

    // A round cone: lateral area π (r + s) · slant between the touching circles, plus two caps.
    let (r, s, length) = (0.6, 0.3, 1.0);
    let surface = make(single(Body::Capsule { from: [0.0; 3], to: [0.0, length, 0.0], radii: [r, s] }));
    assert_remeshed(&surface, 0.1, 0);
    let sine: f64 = (r - s) / length;
    let cosine = (1.0 - sine * sine).sqrt();
    let exact = PI * (r + s) * cosine * length * cosine + TAU * r * r * (1.0 + sine) + TAU * s * s * (1.0 - sine);
    assert!((area(&surface) / exact - 1.0).abs() < 0.01, "{} {exact}", area(&surface));

    // Turned by 90 degrees about z, the long axis x becomes y.
    let radii = [0.9, 0.5, 0.4];
    let surface = make(single(Body::Ellipsoid { center: [0.0; 3], radii, rotation: [0.0, 0.0, 90.0] }));
    assert_remeshed(&surface, 0.1, 0);
    for p in surface.positions.as_ref().unwrap() {
        let scaled = DVec3::new(p.x / 0.5, p.y / 0.9, p.z / 0.4);
        assert!((scaled.length() - 1.0).abs() < 1e-8);
    }
}

#[test]
fn ellipsoids_turn_about_x_then_y_then_z() {
    // Where the long axis x goes: about x it stays, about y it becomes −z, about z it becomes y.
    for (rotation, long) in [([90.0, 0.0, 90.0], 1), ([0.0, 90.0, 90.0], 2), ([90.0, 90.0, 0.0], 2)] {
        let body = Body::Ellipsoid { center: [0.0; 3], radii: [0.9, 0.5, 0.5], rotation };
        let solid = Solid { body, operation: Operation::Union, blend: 0.0 };
        let surface = make(Shape::Implicit { solid, edge_length: 0.1 });
        let reach = surface.positions.unwrap().into_iter().fold(DVec3::ZERO, |reach, p| reach.max(p.abs()));
        for axis in 0..3 {
            assert!(if axis == long { reach[axis] > 0.85 } else { reach[axis] < 0.51 }, "{rotation:?}: {reach}");
        }
    }
}

#[test]
fn solids_are_joined_cut_and_intersected() {
    let (a, b) = (ball([0.0, 0.0, 0.0], 1.0), ball([1.0, 0.0, 0.0], 1.0));
    // Two unit balls at distance 1 share two caps of height 1/2.
    let lens = 2.0 * PI * 0.25 * (3.0 - 0.5) / 3.0;
    let whole = 4.0 / 3.0 * PI;
    for (operation, exact) in
        [(Operation::Union, 2.0 * whole - lens), (Operation::Difference, whole - lens), (Operation::Intersection, lens)]
    {
        let solid = join([(a.clone(), Operation::Union, 0.0), (b.clone(), operation, 0.0)]);
        let surface = make(Shape::Implicit { solid, edge_length: 0.06 });
        assert_topology(&surface.mesh, 2, 0, 0);
        assert!((volume(&surface) / exact - 1.0).abs() < 0.02, "{operation:?}: {} {exact}", volume(&surface));
    }
}

#[test]
fn implicit_double_torus() {
    let solid = join([(ring(-0.8), Operation::Union, 0.0), (ring(0.8), Operation::Union, 0.2)]);
    let surface = make(Shape::Implicit { solid, edge_length: 0.07 });
    assert_remeshed(&surface, 0.07, 2);
}

fn capsule(from: [f64; 3], to: [f64; 3], radii: [f64; 2]) -> Body {
    Body::Capsule { from, to, radii }
}

fn egg(center: [f64; 3], radii: [f64; 3], rotation: [f64; 3]) -> Body {
    Body::Ellipsoid { center, radii, rotation }
}

/// A sitting hare that looks along +x, with z up.
fn hare() -> Solid {
    let mut parts = vec![
        (egg([-0.10, 0.0, 0.42], [0.52, 0.36, 0.40], [0.0, 20.0, 0.0]), 0.0),
        (egg([0.22, 0.0, 0.66], [0.26, 0.24, 0.36], [0.0, 15.0, 0.0]), 0.25),
        (ball([-0.62, 0.0, 0.36], 0.14), 0.06),
        (egg([0.44, 0.0, 1.10], [0.27, 0.19, 0.20], [0.0, 20.0, 0.0]), 0.14),
        (egg([0.64, 0.0, 1.03], [0.11, 0.11, 0.09], [0.0, 0.0, 0.0]), 0.10),
    ];
    for side in [-1.0, 1.0] {
        parts.extend([
            (egg([-0.22, side * 0.30, 0.30], [0.30, 0.14, 0.27], [0.0, 0.0, 0.0]), 0.10),
            (capsule([-0.20, side * 0.34, 0.08], [0.22, side * 0.35, 0.08], [0.10, 0.085]), 0.14),
            (capsule([0.34, side * 0.16, 0.60], [0.42, side * 0.15, 0.08], [0.12, 0.08]), 0.10),
            (capsule([0.42, side * 0.15, 0.08], [0.52, side * 0.15, 0.07], [0.08, 0.07]), 0.04),
            (capsule([0.30, side * 0.09, 1.20], [0.06, side * 0.21, 1.82], [0.075, 0.055]), 0.08),
            (egg([0.17, side * 0.155, 1.54], [0.115, 0.065, 0.30], [side * -11.0, -21.0, 0.0]), 0.06),
        ]);
    }
    join(parts.into_iter().map(|(body, blend)| (body, Operation::Union, blend)))
}

/// A swimming duck that looks along +x, with z up.
fn duck() -> Solid {
    join(
        [
            (egg([0.0, 0.0, 0.0], [0.70, 0.46, 0.38], [0.0, -8.0, 0.0]), 0.0),
            (capsule([-0.55, 0.0, 0.12], [-0.85, 0.0, 0.34], [0.20, 0.06]), 0.2),
            (capsule([0.42, 0.0, 0.20], [0.48, 0.0, 0.62], [0.22, 0.17]), 0.2),
            (ball([0.52, 0.0, 0.76], 0.27), 0.1),
            (egg([0.84, 0.0, 0.70], [0.20, 0.13, 0.075], [0.0, 8.0, 0.0]), 0.06),
            (egg([-0.10, 0.42, 0.06], [0.42, 0.10, 0.22], [0.0, -12.0, 0.0]), 0.08),
            (egg([-0.10, -0.42, 0.06], [0.42, 0.10, 0.22], [0.0, -12.0, 0.0]), 0.08),
        ]
        .map(|(body, blend)| (body, Operation::Union, blend)),
    )
}

#[test]
fn hare_and_duck_are_spheres_with_good_triangles() {
    for (name, solid, edge_length) in [("hare", hare(), 0.035), ("duck", duck(), 0.04)] {
        let surface = make(Shape::Implicit { solid, edge_length });
        print!("{name}: ");
        assert_remeshed(&surface, edge_length, 0);
    }
}

#[test]
fn the_same_solid_gives_the_same_bits() {
    let bits = || {
        let surface = make(Shape::Implicit { solid: join([(ring(0.0), Operation::Union, 0.0)]), edge_length: 0.15 });
        let positions = surface.positions.unwrap();
        (surface.mesh.triangles(), positions.iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect::<Vec<_>>())
    };
    assert_eq!(bits(), bits());
}

#[test]
fn impossible_parameters_are_refused_with_a_remedy() {
    let a = [1.0, 0.0];
    let b = [0.0, 1.0];
    let torus = |a, b, columns, rows, grid| Shape::FlatTorus { a, b, columns, rows, grid };
    refused(Shape::Sphere { radius: 1.0, subdivisions: 0 }, &["sphere", "`subdivisions` is 0", "at least 1"]);
    refused(Shape::Sphere { radius: f64::NAN, subdivisions: 1 }, &["`radius` is NaN", "above 0"]);
    refused(Shape::Sphere { radius: 1.0, subdivisions: usize::MAX }, &["faces", "lower `subdivisions`"]);
    refused(Shape::UvSphere { radius: -1.0, meridians: 8, parallels: 4 }, &["uv_sphere", "`radius` is -1"]);
    refused(Shape::UvSphere { radius: 1.0, meridians: 2, parallels: 4 }, &["`meridians` is 2", "at least 3"]);
    refused(
        Shape::Octasphere { radius: 1.0, subdivisions: 3, sides: 2 },
        &["octasphere", "`sides` is 2", "at least 3"],
    );
    refused(Shape::Halfway { lobes: 1, subdivisions: 3 }, &["halfway", "`lobes` is 1", "at least 2"]);
    refused(torus(a, b, 2, 4, Grid::Square), &["flat_torus", "`columns` is 2"]);
    refused(torus(a, b, 5, 5, Grid::Equilateral), &["`rows` is 5", "even", "square"]);
    refused(torus(a, [2.0, 0.0], 5, 5, Grid::Square), &["parallel"]);
    refused(torus(a, [0.0, f64::INFINITY], 5, 5, Grid::Square), &["`b` contains inf"]);
    refused(torus(a, b, 1 << 40, 1 << 40, Grid::Square), &["are the limit"]);
    refused(Shape::Torus { major_radius: 1.0, minor_radius: 1.0, columns: 9, rows: 8 }, &["meet itself"]);
    refused(Shape::Torus { major_radius: 1.0, minor_radius: 0.1, columns: 9, rows: 7 }, &["`rows` is 7", "even"]);
    refused(Shape::Cylinder { radius: 1.0, height: 0.0, columns: 9, rows: 7 }, &["cylinder", "`height` is 0"]);
    refused(Shape::Annulus { inner_radius: 2.0, outer_radius: 1.0, columns: 9, rows: 7 }, &["annulus", "hole smaller"]);
    refused(Shape::Disk { radius: 1.0, rings: 0 }, &["disk", "`rings` is 0"]);
    let hyperbolic = |curvature, radius, faces| Shape::HyperbolicDisk { curvature, radius, faces };
    refused(hyperbolic(1.0, 1.0, 100), &["hyperbolic_disk", "`curvature` is 1", "below 0"]);
    refused(hyperbolic(-1.0, 50.0, 100), &["`radius` is 50"]);
    refused(hyperbolic(-1.0, 8.0, 100), &["100 faces", "give at least"]);
    refused(hyperbolic(-1.0, 1.0, usize::MAX), &["are the limit"]);
    let implicit = |body, edge_length| Shape::Implicit {
        solid: Solid { body, operation: Operation::Union, blend: 0.0 },
        edge_length,
    };
    refused(implicit(ball([0.0; 3], 1.0), 0.0), &["implicit", "`edge_length` is 0"]);
    refused(implicit(ball([0.0; 3], 1.0), 1e-6), &["cells", "raise `edge_length`"]);
    refused(implicit(ball([0.0; 3], f64::NAN), 0.1), &["`radius` is NaN"]);
    refused(implicit(Body::Group(vec![]), 0.1), &["no parts"]);
    let nothing =
        join([(ball([0.0; 3], 1.0), Operation::Union, 0.0), (ball([0.0; 3], 2.0), Operation::Difference, 0.0)]);
    refused(implicit(nothing.body, 0.1), &["no surface was found", "something is left"]);
    let blend = join([(ball([0.0; 3], 1.0), Operation::Union, -1.0)]);
    refused(implicit(blend.body, 0.1), &["`blend` is -1"]);
    let axis = Body::Torus { center: [0.0; 3], axis: [0.0; 3], major_radius: 1.0, minor_radius: 0.1 };
    refused(implicit(axis, 0.1), &["`axis` is zero"]);
}

#[test]
fn files_are_found_next_to_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("one.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let scene = Scene::parse("[mesh]\nfile = 'one.obj'", "film", folder.path()).unwrap();
    let surface = scene.surface().unwrap();
    assert_topology(&surface.mesh, 1, 0, 1);
}
