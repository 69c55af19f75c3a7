//! Curvatures that cannot be, told before, in degrees and by what is needed; and cones on a sphere that is even otherwise.

use std::f64::consts::PI;
use std::fs;

use crate::support::program;
use immerse::mesh::{VertexId, shapes};
use immerse::metric::{BoundaryCondition, CurvatureTarget, MetricError, Region, lengths_of_positions, uniformize};
use immerse::scene::Scene;

fn said(files: &[(&str, &str)], text: &str) -> (i32, String) {
    let folder = tempfile::tempdir().expect("a folder");
    files.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).expect("a file"));
    fs::write(folder.path().join("film.toml"), text).expect("a scene");
    let (code, out, err) = program(folder.path(), &["check", "film.toml"]);
    (code, format!("{out}{err}").split_whitespace().collect::<Vec<_>>().join(" ").replace("| ", ""))
}

const RICCI: &str = "[[metric.change]]\nkind = 'ricci'\n";
const EVEN: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n";

#[test]
fn constant_curvature_has_the_sign_of_the_surface() {
    let two = "shape = 'polyhedron'\nname = 'genus_two'\nsubdivisions = 2";
    let torus = "shape = 'torus'\ncolumns = 12\nrows = 8";
    let sphere = "shape = 'sphere'\nsubdivisions = 3";
    for (shape, curvature, parts) in [
        (
            torus,
            "-1",
            ["a torus has a total curvature of 0 degrees", "must be 0, and -1 is asked for", "write curvature = 0"],
        ),
        (
            torus,
            "2.5",
            ["a torus has a total curvature of 0 degrees", "must be 0, and 2.5 is asked for", "leave it out"],
        ),
        (
            sphere,
            "-1",
            ["a sphere has a total curvature of 720 degrees", "must be positive", "write a positive `curvature`"],
        ),
        (sphere, "0", ["a sphere has a total curvature of 720 degrees", "must be positive", "0 is asked for"]),
        (
            two,
            "1",
            ["a closed surface of genus 2 has a total curvature of -720 degrees", "must be negative", "leave it out"],
        ),
        (two, "0", ["genus 2", "must be negative", "write a negative `curvature`"]),
        (
            "shape = 'disk'\nrings = 3",
            "1\nturning = 400",
            [
                "a disk has a total curvature of 360 degrees",
                "its boundary takes 400 and leaves -40",
                "must be negative",
            ],
        ),
        (
            "shape = 'cylinder'\ncolumns = 8\nrows = 3",
            "1\nturning = 0",
            ["an annulus has a total curvature of 0 degrees", "must be 0", "1 is asked for"],
        ),
    ] {
        let (code, text) = said(&[], &format!("[mesh]\n{shape}\n{RICCI}curvature = {curvature}\n"));
        assert_eq!(code, 2, "{shape}: {text}");
        for part in parts.iter().chain(&["break Gauss-Bonnet"]) {
            assert!(text.contains(part), "no `{part}` in {text}");
        }
        assert!(!text.contains("e0") && !text.contains("radians"), "{text}");
    }
}

#[test]
fn sums_are_told_in_degrees() {
    let region = |total: f64| format!("{EVEN}{RICCI}[[metric.change.region]]\nball = [0, 0, 0, 2]\ntotal = {total}\n");
    for (total, part) in [(700.0, "which is 20 degrees too few"), (720.5, "which is 0.5 degrees too many")] {
        let (code, text) = said(&[], &region(total));
        assert!(code == 2 && text.contains(part) && text.contains("the 720 degrees of a sphere"), "{text}");
        assert!(text.contains(&format!("they add up to {total} degrees")), "{text}");
    }
}

/// 360 − 180 d is what a vertex of d faces stays above; the number of the vertex is that of the file.
#[test]
fn a_vertex_of_few_faces_has_a_lowest_curvature() {
    let scene = |vertex: usize| format!("{EVEN}{RICCI}[[metric.change.region]]\nvertices = [{vertex}]\ntotal = ");
    for (vertex, faces, lowest) in [(0, 5, -540), (76, 6, -720)] {
        let (code, text) = said(&[], &format!("{}{}\n", scene(vertex), lowest));
        let part =
            format!("vertex {vertex} is {lowest} degrees, but its {faces} angles are less than 180 degrees each");
        assert!(code == 2 && text.contains(&part) && text.contains(&format!("stays above {lowest} degrees")), "{text}");
        let (code, text) =
            said(&[("c.csv", &format!("{vertex},{}\n", lowest - 100))], &format!("{EVEN}{RICCI}csv = 'c.csv'\n"));
        assert!(code == 2 && text.contains(&format!("stays above {lowest} degrees")), "{text}");
    }
    let several = format!("{EVEN}{RICCI}[[metric.change.region]]\nvertices = [0, 76]\ntotal = -1260\n");
    let (code, text) = said(&[], &several);
    assert!(code == 2 && text.contains("add up to -1260 degrees"), "{text}");
    let (code, text) = said(&[], &format!("[mesh]\nshape = 'disk'\nrings = 3\n{RICCI}turning = -9000\n"));
    assert!(code == 2 && text.contains("but its 2 angles") && text.contains("stays above -180 degrees"), "{text}");

    // The octahedron's vertices 1 to 6 of the file, whose first belongs to nothing.
    let octahedron = "v 9 9 9\nv 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nf 2 4 6\nf 4 3 6\nf 3 5 6\nf 5 2 6\n\
                      f 4 2 7\nf 3 4 7\nf 5 3 7\nf 2 5 7\n";
    let text = format!("[mesh]\nfile = 'm.obj'\n{RICCI}csv = 'c.csv'\n");
    for (line, part) in [
        ("6,-360\n", "the target curvature of vertex 6 is -360 degrees, but its 4 angles"),
        ("5,400\n", "the target curvature of vertex 5: 400 degrees are too many"),
    ] {
        let (code, text) = said(&[("m.obj", octahedron), ("c.csv", line)], &text);
        assert!(code == 2 && text.contains(part), "{text}");
    }
}

/// A sphere with a single cone has no constant curvature beside it, but the cone can be had all the same.
#[test]
fn a_negative_cone_on_an_even_sphere() {
    let folder = tempfile::tempdir().expect("a folder");
    for vertex in [3, 76] {
        for degrees in [-90.0, -180.0, -270.0, -360.0, -500.0] {
            fs::write(folder.path().join("c.csv"), format!("{vertex},{degrees}\n")).expect("a file");
            let text = format!("{EVEN}{RICCI}csv = 'c.csv'\namount = 1\n");
            let scene = Scene::parse(&text, "cone", folder.path()).expect("a scene");
            let simulation = scene.simulation().unwrap_or_else(|error| panic!("{vertex} {degrees}: {error}"));
            let curvature = |v: usize| simulation.metric().curvature(simulation.mesh(), VertexId::new(v)).to_degrees();
            assert!((curvature(vertex) - degrees).abs() < 1e-8, "{vertex} {degrees}: {}", curvature(vertex));
            // All others share the rest, each between half and twice the mean.
            let mean = (720.0 - degrees) / 161.0;
            let others = (0..162).filter(|v| *v != vertex).map(curvature);
            if degrees < -250.0 {
                others.for_each(|k| assert!(k > 0.5 * mean && k < 2.0 * mean, "{vertex} {degrees}: {k} of {mean}"));
                let notes = simulation.metric_program().notes();
                assert!(
                    notes.iter().any(|(change, note)| *change == 0 && note.contains("the areas before the change"))
                );
            }
        }
    }
    // Two opposite cones have one.
    fs::write(folder.path().join("c.csv"), "0,-90\n9,-90\n").expect("a file");
    let text = format!("{EVEN}{RICCI}csv = 'c.csv'\namount = 1\n");
    let scene = Scene::parse(&text, "cone", folder.path()).expect("a scene");
    let simulation = scene.simulation().expect("a spindle");
    let at_cone = simulation.metric().curvature(simulation.mesh(), VertexId::new(9)).to_degrees();
    assert!((at_cone + 90.0).abs() < 1e-8, "{at_cone}");
}

/// What is not found is told by the vertex that is worst, never by triangles of another triangulation.
#[test]
fn what_is_not_found_names_a_vertex() {
    let surface = shapes::disk(1.0, 24).expect("a disk");
    let lengths = lengths_of_positions(&surface.mesh, surface.positions.as_ref().expect("positions"));
    let turning: Vec<f64> = (0..surface.mesh.vertex_count()).map(|_| -5000f64.to_radians() / 144.0).collect();
    let target = CurvatureTarget { boundary: BoundaryCondition::TurningAngles(turning), ..CurvatureTarget::default() };
    let error = uniformize(&surface.mesh, &lengths, &target).expect_err("no such disk");
    let MetricError::NotConverged { vertex, residual, .. } = error else { panic!("{error}") };
    assert!(vertex < surface.mesh.vertex_count() && residual > 1e-11);
    let text = error.to_string();
    assert!(text.contains(&format!("the curvature of vertex {vertex} is still off by")), "{text}");
    assert!(text.contains(" degrees; refine the mesh there") && !text.contains('['), "{text}");
}

#[test]
fn regions_say_what_they_need() {
    let surface = shapes::sphere(1.0, 2).expect("a sphere");
    let lengths = lengths_of_positions(&surface.mesh, surface.positions.as_ref().expect("positions"));
    let region = |vertices: &[usize], curvature: f64| Region {
        vertices: vertices.iter().map(|&v| VertexId::new(v)).collect(),
        curvature,
    };
    let refused = |region: Region| uniformize(&surface.mesh, &lengths, &CurvatureTarget::per_region(vec![region]));
    let low = refused(region(&[0, 1, 2], -9.0 * PI)).expect_err("too low");
    assert!(matches!(low, MetricError::TargetRegion { region: 0, .. }), "{low}");
    assert!(matches!(refused(region(&[0], -3.0 * PI)), Err(MetricError::TooFewFaces { vertex: 0, faces: 5, .. })));
}
