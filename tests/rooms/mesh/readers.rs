//! Files as other programs and other people write them: `inputs/readers`.

use std::fs;
use std::path::{Path, PathBuf};

use immerse::mesh::{Mesh, Surface, read, read_edge_lengths, read_vertex_numbers};
use immerse::scene::Scene;
use tempfile::TempDir;

const POINTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.5]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn input(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/mesh/inputs/readers").join(name)
}

#[track_caller]
fn surface(name: &str) -> Surface {
    read(&input(name)).unwrap_or_else(|error| panic!("{error}"))
}

struct File {
    path: PathBuf,
    _folder: TempDir,
}

fn file(name: &str, content: impl AsRef<[u8]>) -> File {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    File { path, _folder: folder }
}

/// What is said of a file, which has to contain all of the words.
#[track_caller]
fn refused(name: &str, content: impl AsRef<[u8]>, words: &[&str]) {
    let message = read(&file(name, content).path).map(|s| s.mesh.face_count()).unwrap_err().to_string();
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

#[track_caller]
fn is_tetrahedron(name: &str) {
    let surface = surface(name);
    let positions: Vec<_> = surface.positions.unwrap().iter().map(|p| p.to_array()).collect();
    // STL numbers vertices as they come.
    let number = |v: u32| if name.ends_with(".stl") { [0, 2, 1, 3][v as usize] } else { v as usize };
    assert_eq!(positions, [0, 1, 2, 3].map(|v| POINTS[number(v)]), "{name}");
    assert_eq!(
        surface.mesh.triangles().iter().map(|t| t.map(|v| number(v) as u32)).collect::<Vec<_>>(),
        FACES,
        "{name}"
    );
}

#[test]
fn byte_order_marks_utf_16_and_line_ends_of_old_macs() {
    for name in ["mark.obj", "mark.off", "mark.ply", "mark.stl"] {
        is_tetrahedron(name);
    }
    for name in ["utf16_little.obj", "utf16_big.off", "utf16.ply", "utf16.stl"] {
        is_tetrahedron(name);
    }
    for name in ["old_mac.obj", "old_mac.off", "old_mac.ply", "old_mac.stl"] {
        is_tetrahedron(name);
    }
    is_tetrahedron("upper_case.obj");
    // Without a mark, too, and with a letter of Latin-1 in a comment.
    let utf16: Vec<u8> = OBJ.encode_utf16().flat_map(u16::to_be_bytes).collect();
    assert_eq!(read(&file("a.obj", utf16).path).unwrap().mesh.triangles(), FACES);
    let latin: Vec<u8> = [b"OFF # caf\xe9\n".as_slice(), &fs::read(input("lower_case.off")).unwrap()[4..]].concat();
    assert_eq!(read(&file("a.off", latin).path).unwrap().mesh.triangles(), FACES);
    // Lines are those that an editor shows.
    refused("a.obj", "\u{feff}v 0 0 0\rv 1 0 0\rv 0 1\r", &["a.obj:3:", "coordinate z"]);
    refused("a.obj", "v 0 0 0\r\nv 1 0 0\r\nv 0 1\r\n", &["a.obj:3:", "coordinate z"]);
}

#[test]
fn a_scene_may_have_a_byte_order_mark() {
    let text = "[mesh]\nshape = 'sphere'\nradius = 2\n";
    let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let (marked, old_mac) = (format!("\u{feff}{text}"), text.replace('\n', "\r"));
    for bytes in [marked.as_bytes(), &utf16(&marked), old_mac.as_bytes()] {
        let scene = Scene::read(&file("film.toml", bytes).path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.source.locate("mesh.radius").unwrap().line, 3);
    }
    assert!(Scene::parse(&marked, "film", Path::new("")).is_ok());
    let error = Scene::read(&file("film.toml", utf16("\u{feff}[mesh]\nshape = 1\n")).path).unwrap_err().to_string();
    assert!(error.contains("film.toml:2:9"), "{error}");
}

#[test]
fn obj_lines_are_continued_by_a_backslash() {
    let surface = surface("continued.obj");
    assert_eq!(surface.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(surface.positions.unwrap()[2].to_array(), [1.0, 1.0, 0.0]);
    // The line of a mistake is the first of its statement; the count goes on after it.
    refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2\\\n9\nf 1 2 3\n", &["a.obj:4:", "vertex 9"]);
    refused("a.obj", "v 0 0 0\nv 1 0 \\\n0\nv 0 x 0\n", &["a.obj:4:", "`x`"]);
    // A path may end with a backslash, and the file with one.
    let text = format!("mtllib C:\\meshes\\\n{}f 3 1 4\\", OBJ.replace("f 3 1 4\n", ""));
    assert_eq!(read(&file("a.obj", text).path).unwrap().mesh.triangles(), FACES);
}

#[test]
fn obj_indices_numbers_and_other_statements() {
    is_tetrahedron("indices.obj");
    is_tetrahedron("exponents.obj");
    let first = surface("faces_first.obj");
    assert_eq!(first.mesh.triangles().len(), 2);
    assert_eq!(first.positions.unwrap()[1].to_array(), [2.0, 0.0, 0.0]);
    refused("a.obj", "v 0,5 0 0\n", &["a.obj:1:", "`0,5` is not a number", "decimal point"]);
    refused("a.obj", "v 1e400 0 0\n", &["a.obj:1:", "`1e400` is not finite"]);
    refused("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", &["a.obj:3:", "no faces, only lines or points"]);
    refused("a.obj", "v 0 0 0\nv 1 0 0\ncurv 0 1 1 2\n", &["no faces, only free-form curves", "export it as polygons"]);
    refused("a.obj", "hello\n", &["no faces: no line begins with `v` or `f`"]);
}

#[test]
fn ply_types_strips_and_other_elements() {
    for name in ["int64.ply", "uint64.ply", "big_endian.ply", "crlf.ply", "crlf_header.ply", "other_elements.ply"] {
        is_tetrahedron(name);
    }
    let strips = surface("strips.ply");
    assert_eq!(strips.mesh.triangles(), [[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]]);
    assert!(strips.repairs.is_empty(), "all triangles of a strip have one orientation: {:?}", strips.repairs);
    // Strips are joined by repeated vertices, too; the turn goes on through them.
    let text = fs::read_to_string(input("strips.ply")).unwrap();
    let joined = text.replace("10 0 2 1 3 -1 2 4 3 5 -1", "10 0 2 1 3 3 2 2 4 3 5");
    let joined = read(&file("a.ply", joined).path).unwrap();
    assert_eq!(joined.mesh.triangles().len(), 4);
    assert!(joined.repairs.is_empty(), "{:?}", joined.repairs);
    refused("a.ply", text.replace("-1 2", "2.5 2"), &["strip 0 names vertex 2.5"]);

    // All names of all types, one file each.
    type Bytes = fn(f64) -> Vec<u8>;
    let values: [(&str, Bytes); 20] = [
        ("char", |x| (x as i8).to_le_bytes().into()),
        ("int8", |x| (x as i8).to_le_bytes().into()),
        ("uchar", |x| (x as u8).to_le_bytes().into()),
        ("uint8", |x| (x as u8).to_le_bytes().into()),
        ("short", |x| (x as i16).to_le_bytes().into()),
        ("int16", |x| (x as i16).to_le_bytes().into()),
        ("ushort", |x| (x as u16).to_le_bytes().into()),
        ("uint16", |x| (x as u16).to_le_bytes().into()),
        ("int", |x| (x as i32).to_le_bytes().into()),
        ("int32", |x| (x as i32).to_le_bytes().into()),
        ("uint", |x| (x as u32).to_le_bytes().into()),
        ("uint32", |x| (x as u32).to_le_bytes().into()),
        ("long", |x| (x as i64).to_le_bytes().into()),
        ("int64", |x| (x as i64).to_le_bytes().into()),
        ("ulong", |x| (x as u64).to_le_bytes().into()),
        ("uint64", |x| (x as u64).to_le_bytes().into()),
        ("float", |x| (x as f32).to_le_bytes().into()),
        ("float32", |x| (x as f32).to_le_bytes().into()),
        ("double", |x| x.to_le_bytes().into()),
        ("float64", |x| x.to_le_bytes().into()),
    ];
    for (name, bytes) in values {
        let mut file_bytes = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty {name} x\nproperty {name} y\n\
             property {name} z\nproperty {name} quality\nelement face 1\nproperty list {name} {name} vertex_index\nend_header\n"
        )
        .into_bytes();
        for x in [0, 0, 0, 9, 2, 0, 0, 9, 0, 5, 0, 9, 3, 0, 1, 2] {
            file_bytes.extend(bytes(f64::from(x)));
        }
        let read = read(&file("a.ply", file_bytes).path).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(read.positions.unwrap()[2].to_array(), [0.0, 5.0, 0.0], "{name}");
    }
}

#[test]
fn stl_as_it_is_written() {
    for name in
        ["upper_case.stl", "spaced_end.stl", "two_solids.stl", "binary.stl", "solid_binary.stl", "long_name.stl"]
    {
        is_tetrahedron(name);
        assert!(surface(name).repairs.is_empty(), "{name}");
    }
    is_tetrahedron("trailing.stl");
    let repairs = surface("trailing.stl").repairs;
    assert!(repairs[0].contains("ignored 5 bytes after the 4 triangles"), "{repairs:?}");
    // Many statements on a line, and normals that are no numbers.
    let text = fs::read_to_string(input("spaced_end.stl")).unwrap().replace("solid test\n", "solid\n");
    let text = text.replace("0 0 0\n outer", "-nan(ind) 1.#QNAN nan\n outer");
    let (first, rest) = text.split_once('\n').unwrap();
    let text = format!("{first}\n{}", rest.replace('\n', " "));
    assert_eq!(read(&file("a.stl", text).path).unwrap().mesh.face_count(), 4);
    // A text is never a binary file that claims 774905905 triangles.
    let hello = "Lorem ipsum dolor sit amet, consectetur adipiscing elit, sed do eiusmod tempor 1100.0 incididunt\n";
    refused("a.stl", hello, &["a.stl:1:", "a text that begins with `Lorem`, and an STL file with `solid`"]);
    refused("a.stl", "solid test\nfacet normal 0 0 0\nfacet normal 0 0 0\n", &["a.stl:2:", "does not end"]);
    let mut cut = fs::read(input("solid_binary.stl")).unwrap();
    cut.truncate(200);
    refused("a.stl", cut, &["4 triangles are claimed, which takes 284 bytes, not 200"]);
}

#[test]
fn off_headers() {
    for name in ["lower_case.off", "counts_in_header.off", "headless.off", "ncoff.off", "st4.off"] {
        is_tetrahedron(name);
    }
    let text = fs::read_to_string(input("lower_case.off")).unwrap();
    for header in ["COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF", "NCSTOFF", "cnoff", "Off", "# made by hand\n\nOFF"] {
        assert_eq!(
            read(&file("a.off", text.replacen("off", header, 1)).path).unwrap().mesh.triangles(),
            FACES,
            "{header}"
        );
    }
    // ModelNet forgets the line's end.
    assert_eq!(read(&file("a.off", text.replacen("off\n", "OFF", 1)).path).unwrap().mesh.triangles(), FACES);
    refused(
        "a.off",
        text.replacen("off", "nOFF 3", 1),
        &["a.off:1:", "`nOFF` has vertices in a space of any dimension"],
    );
    refused("a.off", text.replacen("off", "4nOFF", 1), &["`4nOFF` has vertices in a space"]);
    refused("a.off", text.replacen("off", "CCOFF", 1), &["`CCOFF` is not an OFF header"]);
    refused(
        "a.off",
        b"OFF BINARY\n\0\0\0\x04\0\0\0\x04\0\0\0\0".as_slice(),
        &["the binary form", "save it as ascii OFF"],
    );
    let infinite =
        fs::read_to_string(input("st4.off")).unwrap().replace("2.0 2 255", "2.0 0 255").replace("3.0 2", "3.0 0");
    refused("a.off", infinite, &["a.off:6:", "infinitely far"]);
}

#[test]
fn what_is_no_mesh_or_another_one_is_told() {
    let [ply, off, stl] = ["crlf.ply", "lower_case.off", "upper_case.stl"].map(|name| fs::read(input(name)).unwrap());
    let binary = fs::read(input("binary.stl")).unwrap();
    for (content, what, ending) in [
        (OBJ.as_bytes(), "an OBJ file", "obj"),
        (&ply, "a PLY file", "ply"),
        (&off, "an OFF file", "off"),
        (&stl, "an STL file", "stl"),
        (&binary, "a binary STL file", "stl"),
    ] {
        for other in ["obj", "ply", "off", "stl"].into_iter().filter(|&other| other != ending) {
            let said = format!("the file ends in .{other}, but what is in it is {what}");
            refused(&format!("a.{other}"), content, &[&said, &format!("rename it so that it ends in .{ending}")]);
        }
    }
    for ending in ["obj", "ply", "off", "stl"] {
        let name = format!("a.{ending}");
        refused(&name, b"\x1f\x8b\x08\0\0\0\0\0".as_slice(), &["packed by gzip", "unpack it"]);
        refused(&name, b"PK\x03\x04 and so on".as_slice(), &["a zip archive", "unpack it"]);
        refused(&name, "version https://git-lfs.github.com/spec/v1\noid sha256:0\n", &["Git LFS", "git lfs pull"]);
        refused(&name, "\n<!DOCTYPE html>\n<html>", &["a web page", "the raw file"]);
        refused(&name, "", &["the file is empty"]);
        refused(&name, "\u{feff} \r\n\n", &["the file is empty"]);
    }
}

fn tetrahedron() -> Mesh {
    Mesh::from_faces(4, &FACES).unwrap()
}

#[test]
fn tables_of_lengths_as_spreadsheets_write_them() {
    let mesh = tetrahedron();
    let lengths = |path: &Path| read_edge_lengths(path, &mesh).map_err(|error| error.to_string());
    let plain = "0,1,3\n0,2,3\n0,3,4\n1,2,3.5\n1,3,4.5\n2,3,4.25\n";
    let right = lengths(&file("a.csv", plain).path).unwrap();
    for name in [
        "semicolon.csv",
        "decimal_comma.csv",
        "tab.csv",
        "blank.csv",
        "quoted.csv",
        "quoted_headless.csv",
        "floats.csv",
        "mark.csv",
        "utf16.csv",
        "old_mac.csv",
        "excel.csv",
    ] {
        assert_eq!(lengths(&input(name)).as_ref(), Ok(&right), "{name}");
    }
    for (line, words) in [
        ("0,1,3,5", ["a.csv:1:", "more than three columns", "decimals with a point"].as_slice()),
        ("0 1 3,5", &["a.csv:1:", "`0 1 3`", "separate columns by `;`"]),
        ("0;1;3,5\n0;2;3.5", &["a.csv:2:", "`3.5` may mean two things", "line 1 a decimal comma"]),
        ("0,1,\"1,234\"", &["a.csv:1:", "`1,234` may mean two things", "thousands"]),
        ("0;1;1,234.5", &["a.csv:1:", "may mean two things"]),
        ("0.5,1,3", &["a.csv:1:", "vertex u `0.5` is not a number from 0"]),
        ("0;;3", &["a.csv:1:", "vertex v ``"]),
    ] {
        let message = lengths(&file("a.csv", format!("{line}\n")).path).unwrap_err();
        for word in words {
            assert!(message.contains(word), "`{word}` is missing in: {message}");
        }
    }
}

#[test]
fn tables_of_vertices_as_spreadsheets_write_them() {
    let mesh = tetrahedron();
    for text in [
        "v;curvature\r\n0,0;10,5\r\n3,0;-2\r\n",
        "\u{feff}\"0\",\"10.5\"\n\"3\",\"-2\"",
        "0.0\t10.5\n3.0\t-2",
        "0 10.5\n3 -2",
    ] {
        let numbers = read_vertex_numbers(&file("a.csv", text).path, &mesh).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(numbers.iter().map(|(v, x)| (v.0, *x)).collect::<Vec<_>>(), [(0, 10.5), (3, -2.0)], "{text}");
    }
}

/// A header is read, not skipped: whatever order it names, lengths are those of the edges, and what it does not name is refused.
#[test]
fn headers_say_which_column_is_which() {
    let mesh = tetrahedron();
    let lengths = |text: &str| read_edge_lengths(&file("a.csv", text).path, &mesh).map_err(|error| error.to_string());
    let rows = [(0, 1, 3), (0, 2, 3), (0, 3, 4), (1, 2, 2), (1, 3, 4), (2, 3, 4)];
    let table = |header: &str, row: fn(i32, i32, i32) -> String| {
        rows.iter().fold(format!("{header}\n"), |text, &(u, v, l)| text + &row(u, v, l) + "\n")
    };
    let right = lengths(&table("u,v,length", |u, v, l| format!("{u},{v},{l}"))).unwrap();
    for (header, row) in [
        ("length,u,v", (|u, v, l| format!("{l},{u},{v}")) as fn(i32, i32, i32) -> String),
        ("Length (mm); I; J", |u, v, l| format!("{l};{u};{v}")),
        ("from\tlength\tto", |u, v, l| format!("{u}\t{l}\t{v}")),
        ("v,u,l", |u, v, l| format!("{v},{u},{l}")),
        ("\u{feff}# made by hand\r\nv0,v1,edge_length", |u, v, l| format!("{u},{v},{l} # mm\r")),
        ("edge,source,target,length,kind", |u, v, l| format!("{},{u},{v},{l},x", 10 * u + v)),
        ("\"start\" \"end\" \"len\"", |u, v, l| format!("{u} {v} {l}")),
    ] {
        assert_eq!(lengths(&table(header, row)).as_ref(), Ok(&right), "{header}");
    }
    let plain: fn(i32, i32, i32) -> String = |u, v, l| format!("{u},{v},{l}");
    for (text, words) in [
        (table("nan,0,1", plain), ["a.csv:1:", "vertex u `nan`"].as_slice()),
        (table("x,y,z", plain), &["a.csv:1:", "the header `x,y,z` does not say", "u,v,length"]),
        (table("u,v", plain), &["a.csv:1:", "does not say which column is which"]),
        (table("u,v,length,length", plain), &["a.csv:1:", "does not say which column is which"]),
        (table("u,v,i,j,length", plain), &["a.csv:1:", "does not say which column is which"]),
        (table("u,v,length", |u, v, l| format!("{u},{v},{l},5")), &["a.csv:2:", "4 columns, and the header names 3"]),
        (table("u,v,length", |u, v, l| format!("{},{},{l}", u + 1, v + 1)), &["a.csv:4:", "count from 0"]),
        (table("u,v,length", |u, v, _| format!("{u},{v},nan")), &["a.csv:2:", "`nan` is not finite"]),
        (table("u,v,length", |u, v, _| format!("{u},{v}")), &["a.csv:2:", "the length is missing"]),
        (table("length,u,v", |u, v, l| format!("{l},{u},") + &v.to_string()[..0]), &["a.csv:2:", "v is missing"]),
        (table("u,v,length", plain) + "1,0,5\n", &["a.csv:8:", "edge 1,0 has length 5 here and 3 on line 2"]),
        (table("u,v,length\nu,v,length", plain), &["a.csv:2:", "vertex u `u`"]),
    ] {
        let message = lengths(&text).unwrap_err();
        for word in words {
            assert!(message.contains(word), "`{word}` is missing in: {message}");
        }
    }
    let numbers = |text: &str| read_vertex_numbers(&file("a.csv", text).path, &mesh).map_err(|error| error.to_string());
    let found = numbers("degrees,vertex,note\n10.5,0,a\n-2,3,b\n").unwrap();
    assert_eq!(found.iter().map(|(v, x)| (v.0, *x)).collect::<Vec<_>>(), [(0, 10.5), (3, -2.0)]);
    assert!(numbers("v,radians\n0,1\n").unwrap_err().contains("column `radians` is in radians"));
    assert!(numbers("curvature\n0,1\n").unwrap_err().contains("does not say which column is which"));
}
