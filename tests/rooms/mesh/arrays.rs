//! Arrays of NumPy as meshes and lengths: every form that they come in is read right, or refused with what to do.

use crate::support::npy::{compressed, list, npy, npz, table, whole};
use immerse::mesh::{Mesh, Surface, read, read_lengths, read_positions};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

const FACES: [[i64; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const POINTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
/// u, v and length of the edges of the tetrahedron, in an order of their own.
const LENGTHS: [[f64; 3]; 6] =
    [[3.0, 2.0, 4.25], [0.0, 1.0, 3.0], [0.0, 2.0, 3.25], [3.0, 0.0, 4.0], [2.0, 1.0, 3.5], [1.0, 3.0, 4.5]];

struct File(PathBuf, #[allow(dead_code)] TempDir);

fn file(name: &str, bytes: impl AsRef<[u8]>) -> File {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    File(path, folder)
}

fn corners() -> Vec<[u32; 3]> {
    FACES.map(|face| face.map(|v| v as u32)).to_vec()
}

fn tetrahedron() -> Mesh {
    Mesh::from_faces(4, &corners()).unwrap()
}

/// The length of each edge of a mesh of these vertices.
fn of_edges(mesh: &Mesh) -> Vec<f64> {
    let length = |[u, v]: [u32; 2]| {
        let is = |row: &&[f64; 3]| [[u, v], [v, u]].iter().any(|ends| ends.map(f64::from) == [row[0], row[1]]);
        LENGTHS.iter().find(is).unwrap()[2]
    };
    mesh.edges().map(|e| length(mesh.file_ends(e))).collect()
}

#[track_caller]
fn surface(name: &str, bytes: impl AsRef<[u8]>) -> Surface {
    read(&file(name, bytes).0).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

#[test]
fn whatever_way_numpy_writes_faces_they_are_the_same() {
    let numbers = || FACES.iter().flatten().copied();
    let shape = "(4, 3)";
    let by_columns: Vec<u8> = (0..3).flat_map(|k| FACES.map(|face| face[k] as u8)).collect();
    let cases = [
        ("i8", whole(&FACES)),
        ("u1", npy("'|u1'", false, shape, &numbers().map(|x| x as u8).collect::<Vec<_>>())),
        ("i2", npy("'<i2'", false, shape, &numbers().flat_map(|x| (x as i16).to_le_bytes()).collect::<Vec<_>>())),
        ("big i4", npy("'>i4'", false, shape, &numbers().flat_map(|x| (x as i32).to_be_bytes()).collect::<Vec<_>>())),
        (
            "u8",
            npy("\"<u8\"", false, "(4L, 3L)", &numbers().flat_map(|x| (x as u64).to_le_bytes()).collect::<Vec<_>>()),
        ),
        ("by columns", npy("'|i1'", true, shape, &by_columns)),
    ];
    for (name, bytes) in cases {
        let found = surface("faces.npy", &bytes);
        assert_eq!((found.mesh.triangles(), found.positions.is_none()), (corners(), true), "{name}");
        for packed in [npz(&[("F", bytes.clone())]), compressed(&[("triangles", bytes.clone())])] {
            assert_eq!(surface("mesh.npz", packed).mesh.triangles(), corners(), "{name}");
        }
    }
}

#[test]
fn positions_and_lengths_beside_faces() {
    let faces = || ("faces", whole(&FACES));
    let single: Vec<u8> = POINTS.iter().flatten().flat_map(|x| (*x as f32).to_le_bytes()).collect();
    for (name, points) in [("positions", table(&POINTS)), ("V", npy("'<f4'", false, "(4, 3)", &single))] {
        let found = surface("mesh.npz", compressed(&[faces(), (name, points)]));
        assert_eq!(found.positions.unwrap().iter().map(|p| p.to_array()).collect::<Vec<_>>(), POINTS, "{name}");
        assert!(found.edge_lengths.is_none());
    }
    let side = |[a, b]: [i64; 2]| {
        let found = LENGTHS.iter().find(|row| [[a, b], [b, a]].iter().any(|ends| ends.map(|v| v as f64) == row[..2]));
        found.unwrap()[2]
    };
    let by_face = FACES.map(|[a, b, c]| [[a, b], [b, c], [c, a]].map(side));
    let ends = LENGTHS.map(|[u, v, _]| [u as i64, v as i64]);
    let column = list(&LENGTHS.map(|row| row[2]));
    for lengths in [
        vec![("edge_lengths", table(&LENGTHS))],
        vec![("lengths", table(&LENGTHS))],
        vec![("halfedge_lengths", table(&by_face))],
        vec![("lengths", table(&by_face))],
        vec![("edge_lengths", column.clone()), ("edges", whole(&ends))],
        vec![("lengths", column), ("edges", whole(&ends))],
    ] {
        let found = surface("mesh.npz", npz(&[vec![faces()], lengths.clone()].concat()));
        assert_eq!(found.edge_lengths.as_ref(), Some(&of_edges(&found.mesh)), "{:?}", lengths[0].0);
        assert!(found.positions.is_none());
        // The same as the metric of another file of the mesh.
        let metric = file("metric.npz", npz(&[vec![faces()], lengths.clone()].concat()));
        assert_eq!(read_lengths(&metric.0, &tetrahedron()).unwrap(), Some(of_edges(&tetrahedron())));
    }
    let rows = file("metric.npy", table(&LENGTHS));
    assert_eq!(read_lengths(&rows.0, &tetrahedron()).unwrap(), Some(of_edges(&tetrahedron())));
    let in_order = file("metric.npy", list(&of_edges(&tetrahedron())));
    assert_eq!(read_lengths(&in_order.0, &tetrahedron()).unwrap(), Some(of_edges(&tetrahedron())));
}

/// What is no mesh, or may be another one than is meant.
#[test]
fn what_may_be_misread_is_refused() {
    let faces = || ("faces", whole(&FACES));
    let from_one = FACES.map(|face| face.map(|v| v + 1));
    let mut padded = FACES;
    padded[1][2] = -1;
    let edges = |rows: &[[f64; 3]]| npz(&[faces(), ("edge_lengths", table(rows))]);
    let with = |k: usize, column: usize, x: f64| {
        let mut rows = LENGTHS;
        rows[k][column] = x;
        edges(&rows)
    };
    let mut halves = FACES.map(|_| [1.0; 3]);
    halves[2][0] = 1.1;
    let positions = |rows: &[[f64; 3]]| npz(&[faces(), ("positions", table(rows))]);
    let header = |shape: &str| npy("'<i8'", false, shape, &[0; 96]);
    let quads = whole(&[[0, 1, 2, 3], [0, 3, 2, 4]]);
    let cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
        ("from 1", npz(&[("faces", whole(&from_one))]), &["names vertices from 1 on", "subtract 1"]),
        ("from 1 with positions", npz(&[("faces", whole(&from_one)), ("V", table(&POINTS))]), &["subtract 1"]),
        ("padded", npz(&[("faces", whole(&padded))]), &["-1 in row 1", "padded"]),
        ("quads", npz(&[("faces", quads)]), &["faces is 2 x 4, it must be n x 3", "faces[:, [0, 2, 3]]"]),
        ("counted", npz(&[("faces", whole(&[[3, 0, 1, 2], [3, 0, 2, 1]]))]), &["faces[:, 1:]"]),
        ("a list", npz(&[("faces", list(&[0.0, 1.0, 2.0]))]), &["faces is 3, it must be n x 3"]),
        ("fractions", npz(&[("faces", table(&POINTS))]), &["faces has fractions", "astype(int)"]),
        ("two names", npz(&[faces(), ("F", whole(&FACES))]), &["both `faces` and `F`"]),
        ("no faces", npz(&[("positions", table(&POINTS))]), &["there is no array `faces`"]),
        ("out of range", npz(&[faces(), ("V", table(&POINTS[..3]))]), &["names vertex 3, but there are only 3"]),
        ("gaps", npz(&[("faces", whole(&[[0, 1, 1_000_000_000]]))]), &["names vertex 1000000000", "without gaps"]),
        ("twice", npz(&[("faces", whole(&[FACES[0], FACES[0]]))]), &["same corners"]),
        ("plane", npz(&[faces(), ("V", table(&POINTS.map(|[x, y, _]| [x, y])))]), &["V is 4 x 2", "z may be 0"]),
        ("nan position", positions(&[[0.0; 3], [0.0, f64::NAN, 0.0], [0.0; 3], [0.0; 3]]), &["in row 1", "not finite"]),
        ("far", positions(&[[0.0; 3], [1e20; 3], [0.0; 3], [0.0; 3]]), &["too far away"]),
        ("nan length", with(2, 2, f64::NAN), &["edge 0,2 has length NaN (row 2)"]),
        ("endless length", with(2, 2, f64::INFINITY), &["edge 0,2 has length inf"]),
        ("zero length", with(2, 2, 0.0), &["edge 0,2 has length 0", "above 0"]),
        ("negative length", with(2, 2, -1.0), &["edge 0,2 has length -1"]),
        ("half a vertex", with(2, 0, 0.5), &["edge_lengths has 0.5 in row 2, which is no vertex"]),
        ("negative vertex", with(2, 0, -1.0), &["-1 in row 2", "count from 0"]),
        ("no vertex", with(2, 0, 4.0), &["row 2 names vertex 4, the mesh has 4", "count from 0"]),
        ("no edge", with(2, 1, 0.0), &["row 2 is from vertex 0 to vertex 0", "no edge"]),
        ("missing", edges(&LENGTHS[..5]), &["1 of 6 edges have no length, the first is"]),
        (
            "twice a length",
            edges(&[LENGTHS, LENGTHS.map(|[u, v, l]| [v, u, l + 1.0])].concat()),
            &["in row 6 and", "row 0"],
        ),
        (
            "halves",
            npz(&[faces(), ("halfedge_lengths", table(&halves))]),
            &["edge 1,2 has length 1.1 in face 2, column 0 and 1 in face 0, column 1", "numpy.roll"],
        ),
        ("halves of others", npz(&[faces(), ("halfedge_lengths", table(&LENGTHS))]), &["is 6 x 3, it must be 4 x 3"]),
        ("a column", npz(&[faces(), ("edge_lengths", list(&[1.0; 6]))]), &["nothing says which edges", "add `edges`"]),
        (
            "edges of others",
            npz(&[faces(), ("edge_lengths", list(&[1.0; 6])), ("edges", whole(&[[0, 1]]))]),
            &["edges is 1 x 2, it must be 6 x 2"],
        ),
        ("misspelt", npz(&[faces(), ("edge_length", table(&LENGTHS))]), &["`edge_length` is not known"]),
        ("truth", npz(&[("faces", npy("'|b1'", false, "(4, 3)", &[1; 12]))]), &["truth values (`|b1`)"]),
        (
            "objects",
            npz(&[("faces", npy("'|O'", false, "(4, 3)", b"\x80\x04K\x01."))]),
            &["Python objects", "equal length"],
        ),
        ("complex", npz(&[("faces", npy("'<c16'", false, "(1,)", &[0; 16]))]), &["complex numbers"]),
        ("records", npz(&[("faces", npy("[('a', '<i8')]", false, "(1,)", &[0; 8]))]), &["records"]),
        ("half", npz(&[("faces", npy("'<f2'", false, "(1,)", &[0; 2]))]), &["unusual size", "astype(float)"]),
        ("three indices", npz(&[("faces", header("(4, 3, 1)"))]), &["3 indices"]),
        ("cut short", npz(&[("faces", header("(5, 3)"))]), &["array `faces`: its shape [5, 3]"]),
        ("huge", npz(&[("faces", header("(1000000000000000000, 3)"))]), &["does not fit the 96 that follow"]),
        ("overflow", npz(&[("faces", header("(18446744073709551615, 18446744073709551615)"))]), &["does not fit"]),
        ("no header", npz(&[("faces", b"\x93NUMPY\x01\x00".to_vec())]), &["ends within its header"]),
        ("other header", npz(&[("faces", b"hello".to_vec())]), &["does not begin as an array"]),
        ("version", npz(&[("faces", b"\x93NUMPY\x09\x00\x02\x00{}".to_vec())]), &["version 9"]),
        ("an array", whole(&FACES), &["what is in it is an array of NumPy", ".npy"]),
        ("text", b"hello".to_vec(), &["no npz archive"]),
        ("half an archive", npz(&[faces()])[..60].to_vec(), &["no npz archive"]),
    ];
    for (name, bytes, words) in cases {
        let message = match read(&file("mesh.npz", bytes).0) {
            Ok(surface) => panic!("{name} was read as {} faces", surface.mesh.face_count()),
            Err(error) => error.to_string(),
        };
        assert!(message.contains("mesh.npz: "), "{message}");
        says(&message, words);
    }
    for (bytes, words) in [
        (whole(&from_one), ["names vertices from 1 on"].as_slice()),
        (table(&POINTS), &["fractions"]),
        (npz(&[faces()]), &["zip archive"]),
    ] {
        says(&read(&file("faces.npy", bytes).0).map(|s| s.mesh.face_count()).unwrap_err().to_string(), words);
    }
    // Metrics of a mesh.
    let others = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 1]];
    for (name, bytes, words) in [
        ("a.npy", list(&[1.0; 5]), ["it has 5 lengths, the mesh has 6 edges"].as_slice()),
        ("a.npy", table(&[[1.5, 2.0, 2.5]; 4]), &["1.5 in row 0, which is no vertex", "halfedge_lengths"]),
        ("a.npz", npz(&[("halfedge_lengths", table(&[[1.0; 3]; 4]))]), &["no `faces`"]),
        (
            "a.npz",
            npz(&[("faces", whole(&others)), ("edge_lengths", table(&LENGTHS))]),
            &["faces are not those of the mesh"],
        ),
        ("a.npz", npz(&[("edge_lengths", list(&[1.0; 7]))]), &["it has 7 lengths"]),
        ("a.npz", npz(&[("edge_lengths", list(&[1.0, 1.0, f64::NAN, 1.0, 1.0, 1.0]))]), &["has length NaN"]),
    ] {
        says(&read_lengths(&file(name, bytes).0, &tetrahedron()).unwrap_err().to_string(), words);
    }
}

/// What a film leaves can be gone on with: its mesh, the lengths of a frame, and its positions.
#[test]
fn arrays_of_a_film_are_a_mesh_a_metric_and_a_start() {
    let places = npz(&[("triangles", whole(&FACES)), ("places", table(&POINTS)), ("file_vertex", whole(&[[0]; 4]))]);
    let found = surface("mesh.npz", places);
    assert!(found.positions.is_none(), "places may be coordinates of a chart");
    assert_eq!(found.coordinates.unwrap()[3].to_array(), POINTS[3]);
    let frame = npz(&[
        ("positions", table(&POINTS)),
        ("edge_lengths", list(&of_edges(&tetrahedron()))),
        ("face_frames", table(&[[1.0, 0.0, 0.0, 0.0]; 4])),
        ("transport", table(&[[1.0, 0.0]; 6])),
    ]);
    let frame = file("000001.npz", frame);
    assert_eq!(read_lengths(&frame.0, &tetrahedron()).unwrap(), Some(of_edges(&tetrahedron())));
    let positions = read_positions(&frame.0, &tetrahedron()).unwrap();
    assert_eq!(positions.iter().map(|p| p.to_array()).collect::<Vec<_>>(), POINTS);
    says(
        &read(&frame.0).map(|s| s.mesh.face_count()).unwrap_err().to_string(),
        &["no array `faces`", "mesh.npz under [mesh]"],
    );
    let fewer = file("000001.npz", npz(&[("positions", table(&POINTS[..3]))]));
    says(&read_positions(&fewer.0, &tetrahedron()).unwrap_err().to_string(), &["3 positions, the mesh has 4"]);
}
