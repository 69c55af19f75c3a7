//! Numbers in scenes, tables and messages are those of the mesh file, whatever was dropped, welded or cut.

use std::fs;
use std::path::Path;

use crate::support::program;
use immerse::film::FilmFolder;
use immerse::mesh::{EdgeSelection, Selection};
use immerse::mesh::{
    SelectionError, Surface, VertexId, read, read_edge_lengths, read_positions, select_edges, select_vertices,
};
use immerse::scene::Scene;

/// An octahedron whose vertices are 1, 3, 4, 6, 7 and 9 of eleven, counted from 0.
const USED: [usize; 6] = [1, 3, 4, 6, 7, 9];
const POINTS: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.2], [0.0, 0.0, -1.2]];
const FACES: [[usize; 3]; 8] = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

fn vertex_lines(mark: &str) -> String {
    let line = |n: usize| match USED.iter().position(|&used| used == n) {
        Some(k) => format!("{mark}{} {} {}\n", POINTS[k][0], POINTS[k][1], POINTS[k][2]),
        None => format!("{mark}{n} 7 7\n"),
    };
    (0..11).map(line).collect()
}

fn obj() -> String {
    let faces = FACES.map(|f| f.map(|k| USED[k] + 1));
    vertex_lines("v ") + &faces.map(|[a, b, c]| format!("f {a} {b} {c}\n")).concat()
}

fn off() -> String {
    let faces = FACES.map(|f| f.map(|k| USED[k]));
    format!("OFF\n11 8 0\n{}", vertex_lines("")) + &faces.map(|[a, b, c]| format!("3 {a} {b} {c}\n")).concat()
}

fn write(folder: &Path, name: &str, text: impl AsRef<[u8]>) {
    fs::write(folder.join(name), text).expect("a file");
}

fn surface(folder: &Path) -> Surface {
    write(folder, "mesh.obj", obj());
    read(&folder.join("mesh.obj")).expect("an octahedron")
}

#[test]
fn the_map_of_every_format() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [("mesh.obj", obj()), ("mesh.off", off())] {
        write(folder.path(), name, text);
        let Surface { mesh, repairs, .. } = read(&folder.path().join(name)).expect("an octahedron");
        assert_eq!(mesh.file_vertices(), USED.map(|v| v as u32), "{name}");
        assert_eq!(mesh.file_vertex_count(), 11);
        assert_eq!(mesh.vertex_of_file(6), Ok(VertexId::new(3)));
        assert!(mesh.vertex_of_file(5).is_err() && mesh.vertex_of_file(11).is_err());
        assert_eq!(repairs, ["dropped 5 vertices that belong to no face (the first is vertex 0)"]);
    }
}

#[test]
fn selections() {
    let folder = tempfile::tempdir().expect("a folder");
    let Surface { mesh, positions, .. } = surface(folder.path());
    let select = |v: Vec<usize>| select_vertices(&Selection::Vertices(v), &mesh, positions.as_deref());
    assert_eq!(select(vec![9, 1, 4]), Ok([5, 0, 2].map(VertexId::new).to_vec()));
    assert_eq!(select(vec![5]), Err(SelectionError::DroppedVertex { vertex: 5 }));
    assert!(
        SelectionError::DroppedVertex { vertex: 5 }.to_string().starts_with("vertex 5 belongs to no face of the file")
    );
    assert_eq!(select(vec![11]), Err(SelectionError::NoSuchVertex { vertex: 11, vertices: 11 }));
    let edge = |ends| select_edges(&EdgeSelection::Edges(vec![ends]), &mesh, positions.as_deref());
    let found = edge([9, 1]).expect("an edge")[0];
    let ends = mesh.edge_vertices(found).map(|v| v.index());
    assert!(ends == [0, 5] || ends == [5, 0], "{ends:?}");
    assert_eq!(edge([1, 3]), Err(SelectionError::NoSuchEdge { ends: [1, 3] }));
    assert_eq!(edge([1, 2]), Err(SelectionError::DroppedVertex { vertex: 2 }));
}

#[test]
fn tables_of_lengths() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path().join("lengths.csv");
    let Surface { mesh, .. } = surface(folder.path());
    let length = |a: usize, b: usize| 1.0 + 0.01 * (a.min(b) as f64) + 0.001 * (a.max(b) as f64);
    let lines: Vec<String> = mesh
        .edges()
        .map(|e| mesh.edge_vertices(e).map(|v| USED[v.index()]))
        .map(|[a, b]| format!("{b},{a},{}\n", length(a, b)))
        .collect();
    write(folder.path(), "lengths.csv", lines.concat());
    let lengths = read_edge_lengths(&at, &mesh).expect("lengths");
    for e in mesh.edges() {
        let [a, b] = mesh.edge_vertices(e).map(|v| USED[v.index()]);
        assert_eq!(lengths[e.index()], length(a, b));
    }
    for (line, reason) in [
        ("1,5,1\n", "lengths.csv:1: vertex 5 belongs to no face of the file"),
        ("1,11,1\n", "lengths.csv:1: the mesh has no edge from vertex 1 to vertex 11"),
        ("1,3,1\n", "lengths.csv:1: the mesh has no edge from vertex 1 to vertex 3"),
        ("1,4,1\n", "11 of 12 edges have no length, the first is 4,7"),
    ] {
        write(folder.path(), "lengths.csv", line);
        let error = read_edge_lengths(&at, &mesh).expect_err(line).to_string();
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn cones_pins_and_angles_of_a_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    write(at, "mesh.obj", obj());
    write(at, "cones.csv", "7,150\n9,150\n");
    let text = "[mesh]\nfile = 'mesh.obj'\n[[metric.change]]\nkind = 'ricci'\ncsv = 'cones.csv'\namount = 1\n\
                [[pin]]\nvertices = [7]\npositions = [[0, 0, 3]]\n[[bending.region]]\nedges = [[7, 4]]\nangle = 20\n";
    let scene = Scene::parse(text, "film", at).expect("a scene");
    let simulation = scene.simulation().expect("a simulation");
    for (number, degrees) in [(7, 150.0), (9, 150.0), (1, 105.0), (6, 105.0)] {
        let v = simulation.mesh().vertex_of_file(number).expect("a vertex");
        let found = simulation.metric().curvature(simulation.mesh(), v).to_degrees();
        assert!(
            (found - degrees).abs() < 15.0 && (degrees != 150.0 || (found - degrees).abs() < 1e-8),
            "{number}: {found}"
        );
    }
    for (from, to, reason) in [
        ("7,150", "8,150", "vertex 8 belongs to no face of the file"),
        ("7,150", "11,150", "there is no vertex 11, the mesh has 11"),
        ("vertices = [7]", "vertices = [10]", "vertex 10 belongs to no face of the file"),
        ("[[7, 4]]", "[[7, 2]]", "vertex 2 belongs to no face of the file"),
        ("[[0, 0, 3]]", "[[0, 0, 3]]\n[[pin]]\nvertices = [7]", "vertex 7 is pinned to"),
        ("positions = [[0, 0, 3]]", "formula = ['0/0', '0', '0']", "vertex 7 is led to"),
    ] {
        write(at, "cones.csv", "7,150\n9,150\n".replace(from, to));
        write(at, "film.toml", text.replace(from, to));
        let (code, _, err) = program(at, &["check", "film.toml"]);
        assert!(code == 2 && err.split_whitespace().collect::<Vec<_>>().join(" ").contains(reason), "{reason}\n{err}");
    }
}

#[test]
fn messages_about_lengths() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    // A quadrilateral in front, so that triangles are counted otherwise than faces.
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nf 2 3 4 5\nf 5 4 6\n";
    write(at, "mesh.obj", text);
    let film = |more: &str| write(at, "film.toml", format!("[mesh]\nfile = 'mesh.obj'\n{more}"));
    let check = || program(at, &["check", "film.toml"]).2.split_whitespace().collect::<Vec<_>>().join(" ");
    film("[metric]\nformula = 'length + 80 * max(0, y - 1.2) * max(0, x - 0.8)'\n");
    let err = check();
    assert!(err.contains("face 1 with vertices [4, 3, 5]"), "{err}");
    film("[metric]\nformula = 'length * (1.2 - y)'\n");
    let err = check();
    assert!(err.contains("between vertices [3, 5] has length"), "{err}");
    film("[start]\nfrom = 'mesh'\nformula = ['x', 'y', '1 / (y - 2)']\n");
    let err = check();
    assert!(err.contains("vertex 5 would be moved to"), "{err}");
    film("[[metric.change]]\nkind = 'conformal'\nlog_scale = '1 / (y - 2)'\n");
    let err = check();
    assert!(err.contains("log scale factor of vertex 5 is inf"), "{err}");
}

#[test]
fn other_files_of_the_same_connectivity() {
    let folder = tempfile::tempdir().expect("a folder");
    let Surface { mesh, .. } = surface(folder.path());
    let other = folder.path().join("other.obj");
    // The same numbers, other places, also of those that nobody uses.
    write(folder.path(), "other.obj", obj().replace("v 0 0 1.2", "v 0 0 2.5").replace("v 0 7 7", "v 1 1 1"));
    let positions = read_positions(&other, &mesh).expect("positions");
    assert_eq!(positions[4].to_array(), [0.0, 0.0, 2.5]);
    // Without the vertices that nobody uses.
    let compact: String = POINTS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat()
        + &FACES.map(|f| f.map(|k| k + 1)).map(|[a, b, c]| format!("f {a} {b} {c}\n")).concat();
    write(folder.path(), "other.obj", compact);
    assert_eq!(read_positions(&other, &mesh).expect("positions")[4].to_array(), [0.0, 0.0, 1.2]);
    // Other faces.
    write(folder.path(), "other.obj", obj().replace("f 2 5 8", "f 5 8 2"));
    let error = read_positions(&other, &mesh).expect_err("another face").to_string();
    assert!(error.contains("face 0 has vertices [4, 7, 1], in the mesh of the scene [1, 4, 7]"), "{error}");
}

/// What is on disk says which number each vertex has, and `hide_faces` means faces of the file.
#[test]
fn the_outcome_carries_the_map() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    // Two quadrilaterals and a triangle: five triangles.
    let strip =
        "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nv 0 2 0\nv 0.5 3 0\nf 2 3 4 5\nf 5 4 6 7\nf 7 6 8\n";
    write(at, "mesh.obj", strip);
    let film = |hidden: &str| {
        let text =
            "[mesh]\nfile = 'mesh.obj'\n[start]\nfrom = 'mesh'\n[output]\nsize = [32, 24]\n[look]\nhide_faces = ";
        write(at, "film.toml", format!("{text}{hidden}\n"));
        program(at, &["run", "film.toml", "--out", "out"])
    };
    let (code, _, err) = film("[3]");
    assert!(code == 2 && err.contains("there is no face 3") && err.contains("below 3"), "{err}");
    let picture = |hidden| {
        let (code, out, err) = film(hidden);
        assert_eq!(code, 0, "{out}{err}");
        fs::read(at.join("out/000001.png")).expect("a picture")
    };
    let [all, first, last] = ["[]", "[0]", "[2]"].map(picture);
    assert!(all != first && first != last && all != last);
    let bytes = fs::read(at.join("out/mesh.npz")).expect("a mesh");
    let array = |name: &str| {
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(&bytes)).expect("an archive");
        let mut content = Vec::new();
        std::io::Read::read_to_end(&mut archive.by_name(name).expect(name), &mut content).expect("bytes");
        let start = content.iter().position(|&b| b == b'\n').expect("a header") + 1;
        content[start..].as_chunks::<4>().0.iter().map(|&b| u32::from_le_bytes(b)).collect::<Vec<_>>()
    };
    assert_eq!(array("file_vertex.npy"), [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(array("file_face.npy"), [0, 0, 1, 1, 2]);
    assert_eq!(FilmFolder::open(&at.join("out")).expect("a film").file_faces().expect("faces"), [0, 0, 1, 1, 2]);
}

#[test]
fn triangles_of_concave_polygons_and_strips() {
    let inputs = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/mesh/inputs/readers");
    for name in ["l_prism.obj", "l_prism.off", "l_prism.ply", "l_prism_binary.ply"] {
        let mesh = read(&inputs.join(name)).expect("a prism").mesh;
        let faces = mesh.file_faces();
        assert!(faces.is_sorted(), "{name}: {faces:?}");
        // Two caps of six corners and six sides of four, in whatever order the file has them.
        let mut counts: Vec<usize> = faces.chunk_by(|a, b| a == b).map(<[u32]>::len).collect();
        counts.sort_unstable();
        assert_eq!(counts, [2, 2, 2, 2, 2, 2, 4, 4], "{name}: {faces:?}");
    }
    // Every triangle of a strip is a face of its own.
    let mesh = read(&inputs.join("strips.ply")).expect("strips").mesh;
    assert!(mesh.file_faces().iter().copied().eq(0..mesh.face_count() as u32));
}
