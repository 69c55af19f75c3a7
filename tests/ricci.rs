use immerse::mesh::{Surface, shapes};
use immerse::metric::*;
use immerse::scene::*;
fn lengths(s: &Surface) -> Vec<f64> {
    lengths_of_positions(&s.mesh, s.positions.as_ref().unwrap())
}
fn part(body: Body, blend: f64) -> Solid {
    Solid { body, operation: Operation::Union, blend }
}
fn hare(edge: f64) -> Surface {
    let capsule = |from, to, radii| Body::Capsule { from, to, radii };
    let solid = part(
        Body::Group(vec![
            part(Body::Ellipsoid { center: [0.0, 0.0, 0.0], radii: [1.0, 0.7, 0.8], rotation: [0.0; 3] }, 0.0),
            part(Body::Sphere { center: [1.0, 0.0, 0.8], radius: 0.45 }, 0.3),
            part(capsule([0.9, 0.2, 1.1], [0.5, 0.35, 2.1], [0.16, 0.1]), 0.1),
            part(capsule([0.9, -0.2, 1.1], [0.5, -0.35, 2.1], [0.16, 0.1]), 0.1),
            part(Body::Sphere { center: [-1.0, 0.0, 0.1], radius: 0.2 }, 0.1),
            part(capsule([0.5, 0.4, -0.4], [0.9, 0.45, -0.9], [0.2, 0.15]), 0.1),
            part(capsule([0.5, -0.4, -0.4], [0.9, -0.45, -0.9], [0.2, 0.15]), 0.1),
        ]),
        0.0,
    );
    shapes::implicit(&solid, edge).unwrap()
}
#[test]
fn try_it() {
    let p = |s: &str, n| shapes::polyhedron(&PolyhedronSource::Named(s.into()), n).unwrap();
    for (name, s) in [
        ("torus", shapes::torus(1.0, 0.5, 63, 49 - 1).unwrap()),
        ("thin torus", shapes::torus(1.0, 0.8, 63, 48).unwrap()),
        ("sphere", shapes::sphere(1.0, 8).unwrap()),
        ("uv", shapes::uv_sphere(1.0, 16, 9).unwrap()),
        ("cube", p("cube", 6)),
        ("genus2 coarse", p("genus_two", 2)),
        ("genus2", p("genus_two", 6)),
        ("hare", hare(0.1)),
        ("finehare", hare(0.05)),
    ] {
        println!("{name} {}", s.mesh.face_count());
        match uniformize(&s.mesh, &lengths(&s), &CurvatureTarget::default()) {
            Ok(c) => println!("  {} iterations, {:e}", c.iterations, c.residual),
            Err(e) => println!("  {e}"),
        }
    }
}
mod support;
#[test]
fn random_ones() {
    let mut random = support::Random::new(1);
    for (g, b) in [(0, 0), (1, 0), (2, 0), (0, 2)] {
        for _ in 0..4 {
            let (mesh, _) = support::surface(g, b);
            let m = support::random_metric(&mesh, &mut random);
            println!("genus {g} boundaries {b} {}", mesh.vertex_count());
            match uniformize(&mesh, m.edge_lengths(), &CurvatureTarget::default()) {
                Ok(c) => println!("  {} iterations, {} flips, {:e}", c.iterations, c.flips, c.residual),
                Err(e) => println!("  {e}"),
            }
        }
    }
}
#[test]
fn files() {
    for f in ["bunny", "sphere", "torus"] {
        let s = immerse::mesh::read(std::path::Path::new(&format!("/work/shared/data/{f}.obj"))).unwrap();
        println!("{f} {}", s.mesh.face_count());
        let now = std::time::Instant::now();
        match uniformize(&s.mesh, &lengths(&s), &CurvatureTarget::default()) {
            Ok(c) => {
                println!("  {} iterations, {} flips, {:e}, {:?}", c.iterations, c.flips, c.residual, now.elapsed())
            }
            Err(e) => println!("  {e}"),
        }
    }
}
#[test]
fn flow() {
    let p = |s: &str, n| shapes::polyhedron(&PolyhedronSource::Named(s.into()), n).unwrap();
    for (name, s) in [
        ("torus", shapes::torus(1.0, 0.5, 63, 49 - 1).unwrap()),
        ("cube", p("cube", 6)),
        ("genus2", p("genus_two", 6)),
        ("hare", hare(0.1)),
        ("finehare", hare(0.05)),
    ] {
        let l = lengths(&s);
        let now = std::time::Instant::now();
        let mut flow = RicciFlow::new(&s.mesh, &l, &CurvatureTarget::default()).unwrap();
        let end = uniformize(&s.mesh, &l, &CurvatureTarget::default()).unwrap();
        println!("{name} {:?}", now.elapsed());
        for t in [0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0] {
            match flow.log_scale_at(t) {
                Ok(u) => println!(
                    "  {name} {t} off by {:e} {:?}",
                    u.iter().zip(&end.log_scale).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
                    now.elapsed()
                ),
                Err(e) => {
                    println!("  {e}");
                    break;
                }
            }
        }
    }
}
