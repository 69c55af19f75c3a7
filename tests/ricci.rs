use immerse::mesh::{shapes, Surface};
use immerse::metric::*;
use immerse::scene::*;
fn lengths(s: &Surface) -> Vec<f64> { lengths_of_positions(&s.mesh, s.positions.as_ref().unwrap()) }
fn part(body: Body, blend: f64) -> Solid { Solid { body, operation: Operation::Union, blend } }
fn hare(edge: f64) -> Surface {
    let capsule = |from, to, radii| Body::Capsule { from, to, radii };
    let solid = part(Body::Group(vec![
        part(Body::Ellipsoid { center: [0.0, 0.0, 0.0], radii: [1.0, 0.7, 0.8], rotation: [0.0; 3] }, 0.0),
        part(Body::Sphere { center: [1.0, 0.0, 0.8], radius: 0.45 }, 0.3),
        part(capsule([0.9, 0.2, 1.1], [0.5, 0.35, 2.1], [0.16, 0.1]), 0.1),
        part(capsule([0.9, -0.2, 1.1], [0.5, -0.35, 2.1], [0.16, 0.1]), 0.1),
        part(Body::Sphere { center: [-1.0, 0.0, 0.1], radius: 0.2 }, 0.1),
        part(capsule([0.5, 0.4, -0.4], [0.9, 0.45, -0.9], [0.2, 0.15]), 0.1),
        part(capsule([0.5, -0.4, -0.4], [0.9, -0.45, -0.9], [0.2, 0.15]), 0.1),
    ]), 0.0);
    shapes::implicit(&solid, edge).unwrap()
}
#[test]
fn try_it() {
    let p = |s: &str, n| shapes::polyhedron(&PolyhedronSource::Named(s.into()), n).unwrap();
    for (name, s) in [("torus", shapes::torus(1.0, 0.5, 63, 49-1).unwrap()), ("thin torus", shapes::torus(1.0, 0.8, 63, 48).unwrap()), ("sphere", shapes::sphere(1.0, 8).unwrap()), ("uv", shapes::uv_sphere(1.0, 16, 9).unwrap()),("cube", p("cube", 6)),
      ("genus2 coarse", p("genus_two", 2)),("genus2", p("genus_two", 6)), ("hare", hare(0.1)), ("finehare", hare(0.05))] {
        println!("{name} {}", s.mesh.face_count());
        match uniformize(&s.mesh, &lengths(&s), &CurvatureTarget::default()) {
            Ok(c) => println!("  {} iterations, {:e}", c.iterations, c.residual),
            Err(e) => println!("  {e}"),
        }
    }
}
