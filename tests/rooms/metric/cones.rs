//! Curvatures of single vertices, from a file.

use crate::support::program;
use immerse::mesh::VertexId;
use immerse::scene::Scene;
use std::f64::consts::{PI, TAU};
use std::fs;

const SCENE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 4\n[start]\nfrom = 'mesh'\n\
                     [[metric.change]]\nkind = 'ricci'\ncsv = 'cones.csv'\namount = 1\n";

/// A sphere that is flat but for three cones of 240 degrees, given for some vertices and by area for the rest.
#[test]
fn three_cones_on_a_sphere() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut lines = "vertex,degrees\n0,240\n5,240\n# one more\n11,240\n".to_owned();
    (0..162).filter(|v| ![0, 5, 11].contains(v)).for_each(|v| lines += &format!("{v},0\n"));
    fs::write(folder.path().join("cones.csv"), lines).expect("a file");
    let scene = Scene::parse(SCENE, "cones", folder.path()).expect("a scene");
    let simulation = scene.simulation().expect("a metric");
    for v in simulation.mesh().vertices() {
        let wanted = if [0, 5, 11].contains(&v.index()) { 4.0 * PI / 3.0 } else { 0.0 };
        assert!((simulation.metric().curvature(simulation.mesh(), v) - wanted).abs() < 1e-10, "{v:?}");
    }

    // The rest in proportion to area.
    fs::write(folder.path().join("cones.csv"), "3,90\n").expect("a file");
    let simulation = scene.simulation().expect("a metric");
    let (mesh, metric) = (simulation.mesh(), simulation.metric());
    assert!((metric.curvature(mesh, VertexId::new(3)) - PI / 2.0).abs() < 1e-10);
    let areas = metric.vertex_areas(mesh);
    let density = (2.0 * TAU - PI / 2.0) / (areas.iter().sum::<f64>() - areas[3]);
    for v in mesh.vertices().filter(|v| v.index() != 3) {
        assert!((metric.curvature(mesh, v) - density * areas[v.index()]).abs() < 1e-10, "{v:?}");
    }
}

#[test]
fn bad_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("film.toml"), SCENE).expect("a scene");
    let all = |degrees: f64| (0..162).map(|v| format!("{v},{degrees}\n")).collect::<String>();
    for (lines, parts) in [
        ("", ["cones.csv: it has no lines", "write lines `v,number`"]),
        ("0,10\n162,20\n", ["cones.csv:2: there is no vertex 162, the mesh has 162", "count vertices from 0"]),
        ("0,10\n3,1\n0,10\n", ["cones.csv:3: vertex 0 was given on line 1", "give every vertex once"]),
        ("0,10,7\n", ["cones.csv:1: there are more than two columns", "write `v,number`"]),
        ("0,ten\n", ["cones.csv:1:", "ten"]),
        ("0,360\n", ["film.toml:6", "360"]),
        (&*all(1.0), ["film.toml:6", "Gauss-Bonnet"]),
    ] {
        fs::write(at.join("cones.csv"), lines).expect("a file");
        let (code, _, err) = program(at, &["check", "film.toml"]);
        assert_eq!(code, 2, "{lines}: {err}");
        parts.iter().for_each(|part| assert!(err.contains(part), "{part:?} is not in\n{err}"));
    }
}
