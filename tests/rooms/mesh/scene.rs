//! What is wrong with the surface of a scene is shown where the scene names it.

use std::fs;

use immerse::mesh::shapes::{Body, Operation, Shape, Solid};
use immerse::scene::{MeshSection, Scene, SceneError};
use tempfile::TempDir;

/// A fault of a file, in a scene that names it on its third line.
fn in_file(name: &str, text: &str) -> SceneError {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join(name), text).unwrap();
    let scene = format!("[clock]\n[mesh]\nfile = '{name}'\n");
    Scene::parse(&scene, "film", folder.path()).unwrap().surface().expect_err(text)
}

#[test]
fn a_fault_of_a_file_points_at_the_line_that_names_it() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    for (name, text, reason, remedy) in [
        (
            "a.obj",
            format!("{points}f 1 2 9\n"),
            "a.obj:5: counted from 1, face 1 names vertex 9",
            "check the file's index base",
        ),
        (
            "a.obj",
            format!("{points}f 1 2 3\nf 1 2 4\nf 2 1 3\n"),
            "a.obj, lines 5, 7: counted from 1, faces [1, 3]",
            "remove one of them",
        ),
        ("a.obj", format!("{points}f 1 2 x\n"), "a.obj:5: vertex `x` is not a whole number", "indices count from 1"),
        (
            "a.off",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n".into(),
            "counted from 0, face 0 names vertex 3",
            "check the file's index base",
        ),
        ("a.obj", "v 0 0 0\n".into(), "the mesh has no faces", "give at least one triangle"),
        ("a.stl", "solid\nendsolid\n".into(), "the mesh has no faces", "give at least one triangle"),
        (
            "a.obj",
            format!("{points}f 1 2 2\nf 1 2 9\n"),
            "there are 2 faults:",
            "correct all of these in the program that made the mesh, or in the file",
        ),
    ] {
        let error = in_file(name, &text);
        assert_eq!((error.line, error.column), (3, 8), "{error}");
        assert!(error.reason.contains(reason) && error.remedy.contains(remedy), "{error}");
        assert!(!error.reason.contains(&error.remedy), "{error}");
    }
}

/// The reader of scenes refuses most of it before; what is changed in code is not read.
#[test]
fn a_fault_of_a_shape_points_at_its_parameter() {
    let text = "[mesh]\nshape = 'torus'\ncolumns = 9\nrows = 7\n";
    let error = Scene::parse(text, "film", "".as_ref()).unwrap().surface().expect_err("odd rows");
    assert_eq!((error.line, error.column), (4, 8), "{error}");
    assert_eq!(error.reason, "shape `torus`: `rows` is 7");
    assert_eq!(error.remedy, "give an even number, so that shifted rows close up");

    let text = "[mesh]\nshape = 'hyperbolic_disk'\nradius = 50\n";
    let error = Scene::parse(text, "film", "".as_ref()).unwrap().surface().expect_err("a large radius");
    assert_eq!((error.line, error.column), (3, 10), "{error}");

    let text = "[mesh]\nshape = 'implicit'\n[[mesh.parts]]\nsphere = { radius = 1 }\n[[mesh.parts]]\n\
                group = [{ sphere = { radius = 1 } }, { capsule = { from = [0, 0, 0], to = [1, 0, 0], radius = 1 } }]\n";
    let mut scene = Scene::parse(text, "film", "".as_ref()).unwrap();
    let MeshSection::Shape(Shape::Implicit { solid: Solid { body: Body::Group(parts), .. }, .. }) = &mut scene.mesh
    else {
        panic!("a solid")
    };
    let Body::Group(group) = &mut parts[1].body else { panic!("a group") };
    let Body::Capsule { to, .. } = &mut group[1].body else { panic!("a capsule") };
    to[1] = f64::NAN;
    let error = scene.surface().expect_err("NaN");
    assert_eq!((error.line, error.text[error.span.0..].starts_with("[1, 0, 0]")), (6, true), "{error}");
    assert_eq!(error.reason, "shape `implicit`: `to` contains NaN");

    // Without a text there is no place.
    let group = Solid { body: Body::Group(Vec::new()), operation: Operation::Union, blend: 0.0 };
    let shape = Shape::Implicit { solid: group, edge_length: 0.1 };
    let error = Scene { mesh: MeshSection::Shape(shape), ..Scene::default() }.surface().expect_err("nothing");
    assert!(error.reason.contains("no parts"), "{error}");
}

/// What is read and what is generated know the same least sizes.
#[test]
fn least_sizes_are_the_same_in_scenes_and_shapes() {
    let text = |rest: &str| format!("[mesh]\nshape = {rest}\n");
    for (rest, key) in [
        ("'uv_sphere'\nmeridians = {}\nparallels = 1", "meridians"),
        ("'uv_sphere'\nparallels = {}", "parallels"),
        ("'octasphere'\nsubdivisions = {}", "subdivisions"),
        ("'octasphere'\nsides = {}", "sides"),
        ("'halfway'\nsubdivisions = {}", "subdivisions"),
        ("'halfway'\nlobes = {}", "lobes"),
        ("'flat_torus'\ngrid = 'square'\ncolumns = {}\nrows = 3", "columns"),
        ("'flat_torus'\ngrid = 'square'\nrows = {}", "rows"),
        ("'torus'\nrows = {}", "rows"),
        ("'torus'\ncolumns = {}", "columns"),
        ("'cylinder'\nrows = {}", "rows"),
        ("'annulus'\ncolumns = {}\nrows = 1", "columns"),
        ("'disk'\nrings = {}", "rings"),
        ("'sphere'\nsubdivisions = {}", "subdivisions"),
        ("'polyhedron'\nname = 'cube'\nsubdivisions = {}", "subdivisions"),
    ] {
        let parsed = |n: usize| Scene::parse(&text(&rest.replace("{}", &n.to_string())), "film", "".as_ref());
        let least = (0..10).find(|&n| parsed(n).is_ok()).expect("some size is large enough");
        let surface = parsed(least).expect(rest).surface();
        assert!(surface.is_ok(), "{rest}: {least} is read, and refused by the shape: {surface:?}");
        if least > 0 {
            let mistake = parsed(least - 1).expect_err(rest).to_string();
            assert!(mistake.contains(&format!("`{key}` is {}", least - 1)), "{mistake}");
        }
    }
}
