//! Pins against the metric: what no surface can keep is said, and what selections catch.

use std::fs;
use std::path::Path;

use crate::support::{program, scene};
use immerse::mesh::Selection;
use immerse::mesh::{SelectionError, Surface, longest_loops, outer_loops, select_vertices, shapes};
use immerse::scene::Scene;

const DISK: &str = "[mesh]\nshape = 'disk'\nrings = 4\n[start]\nfrom = 'mesh'\n";

fn warnings(text: &str) -> Vec<String> {
    scene(text).simulation().expect("a simulation").pin_contradictions().expect("an answer")
}

#[test]
fn a_rim_that_must_grow() {
    let found = warnings(&format!("{DISK}[metric]\nformula = 'length * 2.5'\n[[pin]]\nboundary = [0]\n"));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].starts_with("pinned edges are 0.4 times the length that the metric asks for at time 0"),
        "{}",
        found[0]
    );
    assert!(found[0].contains("24 of them together are 0.4 times"), "{}", found[0]);

    // Over a film the worst time, be it in the middle.
    let middle = format!(
        "{DISK}[metric]\nformula = 'length * (1 + 6 * t * (1 - t))'\n[[pin]]\nboundary = [0]\n[clock]\nframes = 5\n"
    );
    let found = warnings(&middle);
    assert!(found.len() == 1 && found[0].contains("0.4 times") && found[0].contains("at time 0.5"), "{found:?}");
}

#[test]
fn pins_that_are_led_apart() {
    // Poles of a sphere are pi apart on it, and a little more along edges.
    let apart = |distance: f64, more: &str| {
        format!(
            "[mesh]\nshape = 'sphere'\nsubdivisions = 6\n[start]\nfrom = 'mesh'\n[[pin]]\nnearest = [[0, 0, 1], [0, 0, -1]]\n\
             positions = [[0, 0, 0], [0, 0, {distance}]]\n{more}"
        )
    };
    assert_eq!(warnings(&apart(3.0, "")), Vec::<String>::new());
    let found = warnings(&apart(7.0, ""));
    assert!(found.len() == 1 && found[0].contains("are pinned 7 apart at time 0"), "{found:?}");
    assert!(found[0].contains("times as far as the shortest path along edges"), "{found:?}");
    let moving = apart(1.0, "formula = ['x', 'y', 'z * (1 + 6 * t)']\n[clock]\nframes = 3\n");
    let found = warnings(&moving);
    assert!(found.len() == 1 && found[0].contains("pinned 7 apart at time 1"), "{found:?}");
    // A rigid motion contradicts nothing.
    let motion =
        "motion = { times = [0, 1], translations = [[0, 0, 0], [0, 5, 0]], rotations = [[0, 0, 0], [90, 0, 0]] }\n";
    let rigid = format!("{DISK}[[pin]]\nboundary = [0]\n{motion}[clock]\nframes = 4\n");
    assert_eq!(warnings(&rigid), Vec::<String>::new());
    assert_eq!(
        warnings(&format!("{DISK}[metric]\nformula = 'length * 2'\n[[pin]]\nvertices = [0]\n")),
        Vec::<String>::new()
    );
}

/// Numbers are those of the file.
#[test]
fn an_edge_is_named_as_in_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m.obj"), "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4 5\n").expect("a file");
    let text = "[mesh]\nfile = 'm.obj'\n[[pin]]\nvertices = [3, 4]\npositions = [[0, 0, 0], [0, 0, 1.5]]\n";
    let scene = Scene::parse(text, "film", folder.path()).expect("a scene");
    let found = scene.simulation().expect("a simulation").pin_contradictions().expect("an answer");
    assert!(found.len() == 1 && found[0].contains("between vertices [3, 4] with 1.5 instead of 1"), "{found:?}");
}

fn check(folder: &Path, text: &str) -> (i32, String, String) {
    fs::write(folder.join("film.toml"), text).expect("a scene");
    program(folder, &["check", "film.toml"])
}

#[test]
fn check_and_run_say_it_on_standard_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let steps = "[[phase]]\nmax_steps = 3\n[output]\nsize = [32, 24]\n";
    let text = format!("{DISK}[metric]\nformula = 'length * 2.5'\n[[pin]]\nboundary = 'outer'\n{steps}");
    let (code, out, err) = check(folder.path(), &text);
    assert_eq!(code, 0, "{err}");
    assert!(err.starts_with("warning: pinned edges are 0.4 times the length") && err.lines().count() == 1, "{err}");
    assert!(out.contains("pin[0]: 24 vertices, 24 edges, 0 faces"), "{out}");
    let (code, _, err) = program(folder.path(), &["run", "film.toml", "--out", "out"]);
    assert!(code == 0 && err.contains("warning: pinned edges are 0.4 times the length"), "{err}");
    let (_, _, err) = check(folder.path(), &text.replace("* 2.5", "* 1"));
    assert_eq!(err, "");
}

#[test]
fn check_says_what_selections_catch() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cones.csv"), "1,10\n2,20\n").expect("a file");
    let text = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[start]\nfrom = 'mesh'\n\
                [[metric.change]]\nkind = 'ricci'\ncsv = 'cones.csv'\namount = 0\n\
                [[metric.change.region]]\nvertices = [0]\ntotal = 30\n\
                [[bending.region]]\nball = [0, 0, 0, 2]\nangle = 10\n[[bending.region]]\nedges = [[0, 12], [12, 0]]\nangle = 5\n\
                [[pin]]\nvertices = [3]\n[[pin]]\nball = [0, 0, 0, 2]\n";
    let (code, out, err) = check(folder.path(), text);
    assert_eq!(code, 0, "{err}");
    for line in [
        "metric.change[0].region[0]: 1 vertex, 0 edges, 0 faces",
        "metric.change[0].csv: 2 vertices, 0 edges, 0 faces",
        "bending.region[0]: 42 vertices, 120 edges, 80 faces",
        "bending.region[1]: 2 vertices, 1 edge, 0 faces",
        "pin[0]: 1 vertex, 0 edges, 0 faces",
        "pin[1]: 42 vertices, 120 edges, 80 faces",
    ] {
        assert!(out.lines().any(|said| said == line), "no `{line}` in\n{out}");
    }
}

#[test]
fn loops_by_what_they_are() {
    // The inner rim of an annulus is the shorter one; a long inner rim is still inside.
    let Surface { mesh, positions, .. } = shapes::annulus(0.5, 1.0, 24, 6).expect("an annulus");
    let mut positions = positions.expect("positions");
    let radius = |k: usize| {
        let v = mesh.tail(mesh.boundary_loops()[k][0]);
        positions[v.index()].length()
    };
    let (outer, inner) = if radius(0) > radius(1) { (0, 1) } else { (1, 0) };
    assert_eq!(outer_loops(&mesh, Some(&positions)), [outer]);
    assert_eq!(longest_loops(&mesh, Some(&positions)), [outer]);
    for (k, h) in mesh.boundary_loops()[inner].iter().enumerate() {
        positions[mesh.tail(*h).index()].z = if k % 2 == 0 { 3.0 } else { -3.0 };
    }
    for h in &mesh.boundary_loops()[outer] {
        positions[mesh.tail(*h).index()].z = 0.0;
    }
    assert_eq!(longest_loops(&mesh, Some(&positions)), [inner]);
    positions.iter_mut().for_each(|p| p.z = p.z.clamp(-0.1, 0.1));
    let flat: Vec<_> = positions.iter().map(|p| p.with_z(0.0)).collect();
    assert_eq!(outer_loops(&mesh, Some(&flat)), [outer]);
    // Nothing is known of places: equally many edges, so the first.
    assert_eq!(longest_loops(&mesh, None), [0]);
    assert_eq!(outer_loops(&mesh, None), [0]);
    // Neither rim of a cylinder is around the other.
    let Surface { mesh, positions, .. } = shapes::cylinder(1.0, 2.0, 12, 4).expect("a cylinder");
    assert_eq!(outer_loops(&mesh, positions.as_deref()), [0]);
    let closed = shapes::sphere(1.0, 2).expect("a sphere");
    let found = select_vertices(&Selection::OuterBoundary, &closed.mesh, closed.places());
    assert_eq!(found, Err(SelectionError::NoBoundary));
}

#[test]
fn loops_of_a_scene_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "[mesh]\nshape = 'annulus'\ncolumns = 24\nrows = 4\n[start]\nfrom = 'mesh'\n[[pin]]\nboundary = ";
    let (code, out, err) = check(folder.path(), &format!("{text}'outer'\n"));
    assert!(code == 0 && out.contains(" with 24 vertices (outer, longest)"), "{out}{err}");
    let pinned = |name: &str| {
        let (_, out, _) = check(folder.path(), &format!("{text}{name}\n"));
        out.lines().find(|line| line.starts_with("pin[0]")).map(str::to_owned)
    };
    for name in ["'outer'", "'longest'", "[0]", "[1]"] {
        assert_eq!(pinned(name).as_deref(), Some("pin[0]: 24 vertices, 24 edges, 0 faces"), "{name}");
    }
    for (name, part) in [
        ("'outter'", "did you mean `outer`?"),
        ("0", "it must be one of the strings outer, longest or a list, each entry an integer at least 0"),
        ("[]", "`boundary` is empty"),
        ("[2]", "there is no boundary loop 2, the mesh has 2"),
    ] {
        let (code, _, err) = check(folder.path(), &format!("{text}{name}\n"));
        let err = err.split_whitespace().collect::<Vec<_>>().join(" ").replace("| ", "");
        assert!(code == 2 && err.contains(part), "{name}: {err}");
    }
    let (code, _, err) = check(folder.path(), "[mesh]\nshape = 'sphere'\n[[pin]]\nboundary = 'outer'\n");
    assert!(code == 2 && err.contains("the mesh has no boundary"), "{err}");
}
