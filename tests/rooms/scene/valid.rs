//! What valid scene files say.

use std::path::Path;

use immerse::evolve::{Phase, TimeStep};
use immerse::mesh::Selection;
use immerse::mesh::shapes::{Body, Grid, Operation, PolyhedronSource, Shape, Solid};
use immerse::scene::*;

fn parse(text: &str) -> Scene {
    Scene::parse(text, "test", Path::new("folder")).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

#[test]
fn an_empty_scene_has_all_defaults() {
    let scene = parse("");
    assert_eq!(scene.mesh, MeshSection::Shape(Shape::Sphere { radius: 1.0, subdivisions: 16 }));
    assert_eq!(scene.metric, MetricSection::default());
    assert_eq!(scene.spin, SpinSection::Automatic);
    assert_eq!(scene.start, StartFrom::Random(0).into());
    assert_eq!((scene.phases.len(), scene.pins.len(), scene.lights.len()), (0, 0, 0));
    assert_eq!((scene.bending, scene.clock.frames), (None, 1));
    assert_eq!((scene.camera, scene.look), (CameraSection::default(), LookSection::default()));
    assert_eq!((scene.output, scene.checks), (OutputSection::default(), ChecksSection::default()));
    assert_eq!((scene.name.as_str(), scene.folder.as_path()), ("test", Path::new("folder")));
}

#[test]
fn every_section_is_read() {
    let scene = parse(
        r##"
[mesh]
file = "data/torus.OBJ"
[metric]
length = 0.05
[spin]
class = "01"
[start]
random = 18446744073709551615
[[phase]]
epsilon = [1, 0.5, 1, 0.1]
dt = 3000
[[phase]]
feedback = 0.5
tolerance = 0.01
min_steps = 2
max_steps = 3
[bending]
from = "mirror"
[[pin]]
vertices = [4, 2]
positions = [[0, 0, 1], [1, 2.5, -3e-1]]
[[pin]]
vertices = [0]
[clock]
frames = 240
[camera]
direction = [1, 0, 0]
up = [0, 0, 1]
field_of_view = 0
fill = 1
[[light]]
direction = [0, 0, 1]
color = [2, 1, 0]
shadow = false
[look]
front = "#010203"
back = "#fFfFfF"
background = "#000000"
wireframe = 0.25
lines = false
[output]
size = [320, 200]
samples = 16
format = ["exr"]
[checks]
max_l2_length_error = 0.012
max_rims = 3
max_pinch_points = 0
class = "01"
"##,
    );
    assert_eq!(scene.mesh, MeshSection::File("data/torus.OBJ".into()));
    assert_eq!(scene.resolve(Path::new("a.csv")), Path::new("folder/a.csv"));
    assert_eq!(scene.metric.lengths, LengthSource::Uniform(0.05));
    assert_eq!(scene.spin, SpinSection::Digits("01".into()));
    assert_eq!(scene.start, StartFrom::Random(u64::MAX).into());
    let section = |phase| PhaseSection { phase, like: None };
    assert_eq!(
        scene.phases,
        [
            section(Phase { stiffness: [1.0, 0.5, 1.0, 0.1], dt: TimeStep::FaceAreas(3000.0), ..Phase::default() }),
            section(Phase {
                feedback: 0.5,
                tolerance_radians: 0.01_f64.to_radians(),
                min_steps: 2,
                max_steps: 3,
                ..Phase::default()
            }),
        ]
    );
    assert_eq!(
        scene.bending,
        Some(BendingSection { from: Some(BendingFrom::Mirror), amount: NumberSection::Constant(1.0), regions: vec![] })
    );
    assert_eq!(
        scene.pins,
        [
            PinSection {
                vertices: Selection::Vertices(vec![4, 2]),
                positions: vec![[0.0, 0.0, 1.0], [1.0, 2.5, -0.3]],
                formula: None,
                motion: None,
            },
            PinSection { vertices: Selection::Vertices(vec![0]), positions: vec![], formula: None, motion: None },
        ]
    );
    assert_eq!(scene.clock.frames, 240);
    assert_eq!(
        scene.camera,
        CameraSection {
            direction: Some([1.0, 0.0, 0.0]),
            up: Some([0.0, 0.0, 1.0]),
            field_of_view: Some(0.0),
            fill: Some(1.0),
            ..CameraSection::default()
        }
    );
    assert_eq!(scene.lights, [LightSection { direction: [0.0, 0.0, 1.0], color: [2.0, 1.0, 0.0], shadow: false }]);
    assert_eq!(
        scene.look,
        LookSection {
            front: Some([1, 2, 3]),
            back: Some([255; 3]),
            background: Some([0; 3]),
            wireframe: Some(0.25),
            lines: Some(false),
            ..LookSection::default()
        }
    );
    assert_eq!(
        scene.output,
        OutputSection { size: [320, 200], samples: 16, png: false, exr: true, ..OutputSection::default() }
    );
    assert_eq!(
        scene.checks,
        ChecksSection {
            max_l2_length_error: Some(0.012),
            max_rims: Some(3),
            max_pinch_points: Some(0),
            class: Some("01".into()),
            ..ChecksSection::default()
        }
    );
}

#[test]
fn every_shape_is_read_with_its_defaults() {
    let shape = |text: &str| match parse(&format!("[mesh]\n{text}")).mesh {
        MeshSection::Shape(shape) => shape,
        MeshSection::File(path) => panic!("{path:?}"),
    };
    assert_eq!(shape("shape = 'sphere'\nradius = 2"), Shape::Sphere { radius: 2.0, subdivisions: 16 });
    assert_eq!(shape("shape = 'uv_sphere'"), Shape::UvSphere { radius: 1.0, meridians: 48, parallels: 24 });
    let octasphere = Shape::Octasphere { radius: 1.0, subdivisions: 24, sides: 4 };
    assert_eq!(shape("shape = 'octasphere'"), octasphere);
    assert_eq!(shape("shape = 'halfway'\nlobes = 3"), Shape::Halfway { lobes: 3, subdivisions: 40 });
    assert_eq!(
        shape("shape = 'flat_torus'\ngrid = 'square'\nb = [1, 1]"),
        Shape::FlatTorus { a: [3.0, 0.0], b: [1.0, 1.0], columns: 60, rows: 50, grid: Grid::Square }
    );
    assert_eq!(shape("shape = 'torus'"), Shape::Torus { major_radius: 1.0, minor_radius: 0.4, columns: 96, rows: 40 });
    assert_eq!(shape("shape = 'cylinder'"), Shape::Cylinder { radius: 1.0, height: 2.0, columns: 64, rows: 24 });
    assert_eq!(
        shape("shape = 'annulus'"),
        Shape::Annulus { inner_radius: 0.5, outer_radius: 1.0, columns: 64, rows: 12 }
    );
    assert_eq!(shape("shape = 'disk'"), Shape::Disk { radius: 1.0, rings: 24 });
    assert_eq!(
        shape("shape = 'hyperbolic_disk'\nfaces = 19000"),
        Shape::HyperbolicDisk { curvature: -1.0, radius: 3.0, faces: 19000 }
    );
    assert_eq!(
        shape("shape = 'polyhedron'\nname = 'genus_two'"),
        Shape::Polyhedron { source: PolyhedronSource::Named("genus_two".into()), subdivisions: 8 }
    );
    let tetrahedron = "shape = 'polyhedron'\nsubdivisions = 1
        vertices = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]]
        polygons = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]";
    let Shape::Polyhedron { source: PolyhedronSource::Explicit { vertices, polygons }, .. } = shape(tetrahedron) else {
        panic!("not explicit")
    };
    assert_eq!((vertices.len(), polygons[3].as_slice()), (4, [1, 3, 2].as_slice()));
}

#[test]
fn a_tree_of_solids_reads_the_same_inline_and_as_tables() {
    let inline = parse(
        "[mesh]\nshape = 'implicit'\nedge_length = 0.1\nparts = [
            { sphere = { radius = 1 } },
            { group = [{ capsule = { from = [0, 0, 0], to = [1, 0, 0], radius = 0.5 } }, { torus = { major_radius = 1, minor_radius = 0.2 }, blend = 0.1 }], operation = 'difference' },
        ]",
    );
    let tables = parse(
        "[mesh]\nshape = 'implicit'\nedge_length = 0.1
        [[mesh.parts]]\nsphere.radius = 1
        [[mesh.parts]]\noperation = 'difference'
        [[mesh.parts.group]]\ncapsule = { from = [0, 0, 0], to = [1, 0, 0], radii = [0.5, 0.5] }
        [[mesh.parts.group]]\nblend = 0.1\n[mesh.parts.group.torus]\nmajor_radius = 1\nminor_radius = 0.2",
    );
    assert_eq!(inline.mesh, tables.mesh);
    let plain = |body| Solid { body, operation: Operation::Union, blend: 0.0 };
    let ring = Body::Torus { center: [0.0; 3], axis: [0.0, 0.0, 1.0], major_radius: 1.0, minor_radius: 0.2 };
    let hole = Body::Group(vec![
        plain(Body::Capsule { from: [0.0; 3], to: [1.0, 0.0, 0.0], radii: [0.5; 2] }),
        Solid { blend: 0.1, ..plain(ring) },
    ]);
    let solid = plain(Body::Group(vec![
        plain(Body::Sphere { center: [0.0; 3], radius: 1.0 }),
        Solid { operation: Operation::Difference, ..plain(hole) },
    ]));
    assert_eq!(inline.mesh, MeshSection::Shape(Shape::Implicit { solid, edge_length: 0.1 }));
}

#[test]
fn later_stages_can_point_into_the_file() {
    let scene = parse("# é\n[mesh]\nshape = \"sphere\"\n\n[[phase]]\ndt = 5\n[[phase]]\n  dt = 77 # é\n");
    let place = scene.source.locate("phase[1].dt").unwrap();
    assert_eq!((place.line, place.column, place.text.as_str()), (8, 8, "77"));
    assert_eq!(scene.source.locate("mesh").unwrap().text, "[mesh]");
    assert_eq!(scene.source.locate("spin.class"), None);

    let error = scene.complain("phase[1].dt", "it is too large", "write 7");
    assert_eq!(error.to_string(), format!("{}:8:8: it is too large; write 7", Path::new("folder/test.toml").display()));
    // A key that was left out: at its table, or else at the top of the file.
    assert_eq!(
        (scene.complain("mesh.radius", "a", "b").line, scene.complain("phase[0].epsilon[2]", "a", "b").line),
        (2, 5)
    );
    assert_eq!(scene.complain("spin.class", "a", "b").line, 1);
    assert_eq!(Scene::default().complain("mesh.radius", "a", "b").line, 1);
}

#[test]
fn section_keys_see_what_is_simulated_and_nothing_else() {
    let fingerprint = |text: &str| parse(text).section_keys();
    let plain = fingerprint("[mesh]\nshape = 'sphere'");
    assert_eq!(plain, fingerprint("# a comment\n[mesh]\nradius = 1.0\nshape = 'sphere'\n[look]\nlines = false"));
    assert_ne!(plain, fingerprint("[mesh]\nshape = 'sphere'\nradius = 1.0000001"));
    assert_ne!(plain, fingerprint("[mesh]\nshape = 'sphere'\n[start]\nrandom = 1"));

    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), "v 0 0 0").unwrap();
    let scene = Scene::parse("[mesh]\nfile = 'a.obj'", "test", folder.path()).unwrap();
    let before = scene.section_keys();
    std::fs::write(folder.path().join("a.obj"), "v 0 0 1").unwrap();
    let after = scene.section_keys();
    let changed: Vec<&String> = before.keys().filter(|name| before[*name] != after[*name]).collect();
    assert_eq!(changed, ["mesh"]);
}
