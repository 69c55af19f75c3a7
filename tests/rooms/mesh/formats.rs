//! Every format, read back from files written here, and every way a file can be wrong.

use std::path::PathBuf;

use immerse::mesh::{Mesh, MeshError, Surface, read, read_edge_lengths};
use tempfile::TempDir;

const POINTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

struct File {
    path: PathBuf,
    _folder: TempDir,
}

fn file(name: &str, content: impl AsRef<[u8]>) -> File {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    File { path, _folder: folder }
}

fn read_text(name: &str, content: impl AsRef<[u8]>) -> Result<Surface, MeshError> {
    read(&file(name, content).path)
}

#[track_caller]
fn assert_tetrahedron(surface: Surface) {
    assert_eq!(surface.mesh.triangles(), FACES);
    let positions = surface.positions.unwrap();
    assert_eq!(positions.iter().map(|p| p.to_array()).collect::<Vec<_>>(), POINTS);
    assert!(surface.repairs.is_empty());
}

/// The error's message, which has to contain all of the words.
#[track_caller]
fn assert_refused(name: &str, content: impl AsRef<[u8]>, words: &[&str]) {
    let message = read_text(name, content).map(|s| s.mesh.face_count()).unwrap_err().to_string();
    for word in words.iter().chain([&name]) {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

fn obj() -> String {
    let mut text = String::from("# a tetrahedron\no corner\n");
    for [x, y, z] in POINTS {
        text += &format!("v {x} {y} {z}\n");
    }
    text += "vt 0 0\nvn 0 0 1\ns off\nf 1 3 2\nf 1/1 2/1 4/1\nf 2//1 3//1 4//1\nf -2/1/1 -4/1/1 -1/1/1\n";
    text
}

fn off() -> String {
    let mut text = String::from("OFF\n# counts\n4 4 0\n");
    for [x, y, z] in POINTS {
        text += &format!("{x} {y} {z}\n");
    }
    for [a, b, c] in FACES {
        text += &format!("3 {a} {b} {c}\n");
    }
    text
}

fn ply_header(format: &str, vertices: &str, faces: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment test\nelement vertex {vertices}\nproperty double x\nproperty double y\n\
         property float z\nproperty uchar red\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ply_ascii() -> String {
    let mut text = ply_header("ascii", "4", "4");
    for [x, y, z] in POINTS {
        text += &format!("{x} {y} {z} 255\n");
    }
    for [a, b, c] in FACES {
        text += &format!("3 {a} {b} {c}\n");
    }
    text
}

fn ply_binary(big: bool) -> Vec<u8> {
    let mut bytes = ply_header(if big { "binary_big_endian" } else { "binary_little_endian" }, "4", "4").into_bytes();
    let mut put = |little: &[u8]| {
        if big {
            bytes.extend(little.iter().rev());
        } else {
            bytes.extend(little);
        }
    };
    for [x, y, z] in POINTS {
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&(z as f32).to_le_bytes());
        put(&[255]);
    }
    for face in FACES {
        put(&[3]);
        for v in face {
            put(&v.to_le_bytes());
        }
    }
    bytes
}

fn stl_ascii() -> String {
    let mut text = String::from("solid test\n");
    for face in FACES {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for [x, y, z] in face.map(|v| POINTS[v as usize]) {
            text += &format!("      vertex {x} {y} {z}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid test\n"
}

fn stl_binary() -> Vec<u8> {
    // A header that begins with "solid" must not be taken for ascii.
    let mut bytes = vec![b' '; 80];
    bytes[..5].copy_from_slice(b"solid");
    bytes.extend((FACES.len() as u32).to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        for x in face.iter().flat_map(|&v| POINTS[v as usize]) {
            bytes.extend((x as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn every_format_gives_the_same_tetrahedron() {
    assert_tetrahedron(read_text("a.obj", obj()).unwrap());
    assert_tetrahedron(read_text("a.OBJ", obj().replace('\n', "\r\n")).unwrap());
    assert_tetrahedron(read_text("a.off", off()).unwrap());
    assert_tetrahedron(read_text("a.off", off().replace("OFF\n# counts\n", "OFF ")).unwrap());
    assert_tetrahedron(read_text("a.ply", ply_ascii()).unwrap());
    assert_tetrahedron(read_text("a.ply", ply_binary(false)).unwrap());
    assert_tetrahedron(read_text("a.ply", ply_binary(true)).unwrap());
}

#[test]
fn stl_corners_with_equal_coordinates_are_merged() {
    for bytes in [stl_ascii().into_bytes(), stl_binary()] {
        let surface = read_text("a.stl", bytes).unwrap();
        assert_eq!((surface.mesh.vertex_count(), surface.mesh.euler_characteristic()), (4, 2));
        // Vertices are numbered as they come.
        let positions = surface.positions.unwrap();
        assert_eq!(positions.iter().map(|p| p.to_array()).collect::<Vec<_>>(), [0, 2, 1, 3].map(|v| POINTS[v]));
    }
    // Zero and minus zero are the same place.
    let surface = read_text("a.stl", stl_ascii().replacen("vertex 0 0 0", "vertex -0 0 -0.0", 1)).unwrap();
    assert_eq!(surface.mesh.vertex_count(), 4);
}

#[test]
fn polygons_become_fans() {
    let surface = read_text("a.obj", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n").unwrap();
    assert_eq!(surface.mesh.triangles(), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    let surface = read_text("a.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n").unwrap();
    assert_eq!(surface.mesh.face_count(), 2);
}

#[test]
fn faces_without_positions_are_intrinsic() {
    let surface = read_text("a.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").unwrap();
    assert!(surface.positions.is_none());
    assert_eq!(surface.mesh.triangles(), FACES);
    let surface = read_text("a.off", "OFF 3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n").unwrap();
    assert!(surface.positions.is_none());
}

#[test]
fn what_was_repaired_is_reported() {
    let surface = read_text("a.obj", obj().replace("f 1 3 2", "f 1 2 3") + "v 9 9 9\n").map(|s| (s.mesh, s.repairs));
    // The late vertex would shift the negative indices of nothing; it is dropped.
    let (mesh, repairs) = surface.unwrap();
    assert_eq!(mesh.triangles(), FACES);
    assert_eq!(repairs.len(), 2);
    assert!(repairs[0].contains("reversed 1 of 4") && repairs[1].contains("vertex 4"), "{repairs:?}");
}

#[test]
fn files_that_are_not_there_or_unknown_are_refused() {
    let error = read(&PathBuf::from("no/such/mesh.obj")).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("no/such/mesh.obj: cannot be read") && error.contains("check the path"), "{error}");
    assert_refused("mesh.fbx", "x", &["known mesh format", ".obj, .ply, .off, .stl, .fold, .npz or .npy"]);
    for name in ["a.obj", "a.off", "a.ply", "a.stl"] {
        assert_refused(name, "", &[]);
    }
    assert_refused("a.obj", "v 0 0 0\nv 1 0 0\n", &["no faces", "give at least one"]);
}

#[test]
fn malformed_lines_are_named() {
    assert_refused("a.obj", "v 0 0 0\nv 1 0\n", &["a.obj:2:", "coordinate z is missing"]);
    assert_refused("a.obj", "v 0 0 zero\n", &[":1:", "`zero` is not a number"]);
    assert_refused("a.obj", obj() + "f 1 2\n", &[":14:", "2 corners"]);
    assert_refused("a.obj", obj() + "f 1 2 0\n", &[":14:", "`0` does not exist", "count from 1"]);
    assert_refused("a.obj", obj() + "f 1 2 -9\n", &[":14:", "`-9` does not exist"]);
    assert_refused("a.obj", obj() + "f 1 2 9\n", &[":14:", "vertex 9", "only 4"]);
    assert_refused("a.obj", obj() + "f 1 x 3\n", &[":14:", "`x` is not a whole number"]);
    assert_refused("a.off", off().replace("3 0 2 1", "3 0 2"), &[":8:", "a corner is missing"]);
    assert_refused("a.off", off().replace("OFF", "OOPS"), &[":1:", "`OOPS`", "begin the file with `OFF`"]);
    assert_refused("a.off", off().replace("3 2 0 3\n", ""), &["ends after 3 of 4 faces"]);
    assert_refused("a.ply", ply_ascii().replace("0 1 0 255", "0 one 0 255"), &[":14:", "`one` is not a number"]);
    assert_refused("a.ply", ply_ascii().replace("property float z\n", "property quad z\n"), &[":7:", "quad"]);
    assert_refused("a.ply", ply_ascii().replace("float z", "float w"), &[":4:", "no property z"]);
    let mut cut = ply_binary(false);
    cut.truncate(cut.len() - 5);
    assert_refused("a.ply", cut, &["a list claims 3 values, but the file ends before"]);
    let one_less = stl_ascii().replacen("      vertex 0 0 0\n", "", 1);
    assert_refused("a.stl", one_less, &[":7:", "2 vertices", "exactly three"]);
    let mut cut = stl_binary();
    cut[..5].copy_from_slice(b"model");
    cut.truncate(200);
    assert_refused("a.stl", cut, &["4 triangles are claimed", "284 bytes, not 200"]);
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    assert_refused("a.obj", obj().replace("v 1 0 0", "v NaN 0 0"), &["a.obj:4:", "`NaN` is not finite"]);
    assert_refused("a.obj", obj().replace("v 1 0 0", "v 1 1e999 0"), &["a.obj:4:", "`1e999` is not finite"]);
    assert_refused("a.off", off().replace("1 0 0\n", "inf 0 0\n"), &[":5:", "coordinate x `inf` is not finite"]);
    assert_refused("a.ply", ply_ascii().replace("1 0 0 255", "1 nan 0 255"), &["vertex 1", "not finite"]);
    assert_refused("a.stl", stl_ascii().replacen("vertex 0 0 0", "vertex 0 -inf 0", 1), &[":4:", "not finite"]);
    let mut ply = ply_binary(false);
    let start = ply_header("binary_little_endian", "4", "4").len();
    ply[start..start + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    assert_refused("a.ply", ply, &["vertex 0", "not finite"]);
    let mut stl = stl_binary();
    stl[84 + 50 + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert_refused("a.stl", stl, &["corner 0 of triangle 1", "not finite"]);
}

#[test]
fn counts_that_the_file_cannot_hold_are_refused() {
    for count in ["1000000000", "1152921504606846976"] {
        for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
            assert_refused("a.ply", ply_header(format, count, "4"), &[":4:", count, "bytes that are left"]);
            assert_refused("a.ply", ply_header(format, "0", count), &[":9:", count, "bytes that are left"]);
        }
    }
    let hollow = format!("ply\nformat ascii 1.0\nelement nothing {}\nend_header\n", 1u64 << 60);
    assert_refused("a.ply", hollow, &["element `nothing`", "bytes that are left"]);
    let long_list = ply_ascii().replace("3 0 2 1\n", "1000000000 0 2 1\n").replace("uchar int", "uint int");
    assert_refused("a.ply", long_list, &[":16:", "a list claims 1000000000"]);
    assert_refused("a.off", "OFF 1000000000 4 0\n0 0 0\n", &[":1:", "1000000000 vertices", "too many"]);
    assert_refused("a.obj", "f 1 2 1000000000\n", &[":1:", "vertex 1000000000", "without gaps"]);
    let mut stl = stl_binary();
    stl[..5].copy_from_slice(b"model");
    stl[80..84].copy_from_slice(&1_000_000_000u32.to_le_bytes());
    assert_refused("a.stl", stl, &["1000000000 triangles are claimed"]);
}

#[test]
fn a_surface_that_is_none_names_the_lines() {
    assert_refused("a.obj", "f 1 2 3\nf 3 4 4\n", &["counted from 1, face 2", "two of them equal", "a.obj:2:"]);
    assert_refused("a.obj", "f 1 2 3\n\nf 3 2 1\n", &["faces [1, 2] have the same corners", "lines 1, 3"]);
    // Three quads in a ring, closed with a half turn.
    let moebius = "f 1 2 5 4\nf 2 3 6 5\nf 3 4 1 6\n";
    assert_refused("a.obj", moebius, &["not orientable", "lines "]);
    assert_refused("a.obj", "f 1 2 3\nf 1 4 5\n", &["vertex 1 ", "more than one fan", "lines 1, 2"]);
}

fn triangle() -> Mesh {
    Mesh::from_faces(3, &[[0, 1, 2]]).unwrap()
}

fn lengths_of_triangle(content: &str) -> Result<Vec<f64>, String> {
    read_edge_lengths(&file("l.csv", content).path, &triangle()).map_err(|e| e.to_string())
}

#[test]
fn edge_lengths_come_in_edge_order() {
    let text = "u,v,length\n# the longest\n 2, 1, 5\n0,2,4\n1,0,3 # the last\n0,1,3\n";
    assert_eq!(lengths_of_triangle(text).unwrap(), [3.0, 5.0, 4.0]);
    assert_eq!(lengths_of_triangle("0,1,3\n1,2,5\n2,0,4").unwrap(), [3.0, 5.0, 4.0]);
}

#[test]
fn wrong_edge_lengths_are_named() {
    let rest = "0,1,3\n1,2,5\n";
    for (line, words) in [
        ("", ["1 of 3 edges have no length, the first is 2,0", "l.csv"]),
        ("2,0,4\n0,2,4.5", ["l.csv:4:", "4.5 here and 4 on line 3"]),
        ("2,0,0", ["l.csv:3:", "not positive"]),
        ("2,0,-1", ["l.csv:3:", "not positive"]),
        ("2,0,NaN", ["l.csv:3:", "not finite"]),
        ("2,0,x", ["l.csv:3:", "not a number"]),
        ("2,0", ["l.csv:3:", "the length is missing"]),
        ("2,0,4,1", ["l.csv:3:", "three columns"]),
        ("2,7,4", ["l.csv:3:", "no edge from vertex 2 to vertex 7"]),
        ("2,-1,4", ["l.csv:3:", "vertex v `-1`"]),
        ("u,v,length", ["l.csv:3:", "vertex u `u`"]),
    ] {
        let message = lengths_of_triangle(&format!("{rest}{line}\n")).unwrap_err();
        for word in words {
            assert!(message.contains(word), "`{word}` is missing in: {message}");
        }
    }
    let missing = read_edge_lengths(&PathBuf::from("no.csv"), &triangle()).unwrap_err().to_string();
    assert!(missing.contains("no.csv: cannot be read"), "{missing}");
}
