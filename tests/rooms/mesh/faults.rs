//! All that is wrong with a mesh is told at once, in the numbers of the file.

use std::fs;
use std::time::Instant;

use crate::support::program;
use immerse::mesh::{MeshError, read, repair};

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn faults(vertex_count: usize, faces: &[[u32; 3]]) -> (usize, Vec<MeshError>, Vec<String>) {
    match repair(vertex_count, faces).expect_err("faults") {
        MeshError::Several { count, faults, unlisted } => {
            (count, faults.into_iter().map(|fault| fault.error).collect(), unlisted)
        }
        one => (1, vec![one], Vec::new()),
    }
}

#[test]
fn every_kind_at_once() {
    let mut faces = TETRAHEDRON.to_vec();
    // Two duplicates of the same face, one of another, in any order of corners.
    faces.extend([[1, 2, 0], [3, 1, 0], [0, 1, 2]]);
    // An edge 4 5 with three faces, whose ends are no bow-ties of their own.
    faces.extend([[4, 5, 6], [5, 4, 7], [4, 5, 8]]);
    // Two bow-ties at 10 and 13.
    faces.extend([[9, 10, 11], [10, 12, 13], [13, 14, 15]]);
    // Out of range and degenerate.
    faces.extend([[16, 17, 99], [18, 18, 19], [20, 21, 77]]);
    let (count, found, unlisted) = faults(22, &faces);
    let wanted = vec![
        MeshError::VertexOutOfRange { face: 13, vertex: 99, vertex_count: 22 },
        MeshError::VertexOutOfRange { face: 15, vertex: 77, vertex_count: 22 },
        MeshError::DegenerateFace { face: 14, corners: [18, 18, 19] },
        MeshError::DuplicateFace { faces: [0, 4] },
        MeshError::DuplicateFace { faces: [1, 5] },
        MeshError::DuplicateFace { faces: [0, 6] },
        MeshError::NonManifoldEdge { edge: [4, 5], faces: vec![7, 8, 9] },
        MeshError::NonManifoldVertex { vertex: 10 },
        MeshError::NonManifoldVertex { vertex: 13 },
    ];
    assert_eq!((count, found, unlisted), (9, wanted, vec![]));
}

#[test]
fn every_component_that_cannot_be_oriented() {
    let moebius = |from: u32| {
        (0..5).flat_map(move |k| {
            let (a, b) = (from + k, from + 5 + k);
            let (c, d) = if k == 4 { (from + 5, from) } else { (a + 1, b + 1) };
            [[a, c, b], [c, d, b]]
        })
    };
    let faces: Vec<[u32; 3]> = moebius(0).chain(TETRAHEDRON.map(|f| f.map(|v| v + 10))).chain(moebius(14)).collect();
    let (count, found, _) = faults(24, &faces);
    assert_eq!(count, 2);
    assert!(found.iter().all(|error| matches!(error, MeshError::NonOrientable { .. })), "{found:?}");
}

#[test]
fn what_is_taken_out_makes_no_faults_of_its_own() {
    // A closed fan around 0, two faces of which are degenerate or out of range: what is left of it is no bow-tie.
    let mut faces: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
    faces[0][1] = 50;
    faces[3][2] = faces[3][1];
    let (count, found, _) = faults(7, &faces);
    assert_eq!(count, 2, "{found:?}");
}

#[test]
fn twenty_are_listed_and_all_are_counted_in_no_time() {
    let n = 200_000;
    let mut faces: Vec<[u32; 3]> = (0..n).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    faces.extend_from_within(..);
    let start = Instant::now();
    let (count, found, unlisted) = faults(3 * n as usize, &faces);
    assert!(start.elapsed().as_secs_f64() < 5.0, "{:?}", start.elapsed());
    assert_eq!((count, found.len()), (n as usize, 20));
    assert_eq!(unlisted, ["199980 more faces with the corners of another, 200000 in all"]);
    // All around one vertex.
    let star: Vec<[u32; 3]> = (0..n).map(|k| [0, 2 * k + 1, 2 * k + 2]).collect();
    let start = Instant::now();
    assert_eq!(repair(2 * n as usize + 1, &star).expect_err("fans"), MeshError::NonManifoldVertex { vertex: 0 });
    assert!(start.elapsed().as_secs_f64() < 5.0, "{:?}", start.elapsed());
}

const OBJ: &str = "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 2 2 2\nv 3 2 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n\
                   f 2 1 3\n# again\nf 4 2 1\nf 1 5 6\nf 3 9 1\n";

#[test]
fn lines_and_numbers_are_those_of_the_file_and_the_caret_is_at_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    fs::write(at.join("mesh.obj"), OBJ).expect("a file");
    fs::write(at.join("film.toml"), "[mesh]\n# here\nfile = 'mesh.obj'\n").expect("a scene");
    let (code, _, err) = program(at, &["check", "film.toml"]);
    assert_eq!(code, 2);
    let text = err.replace("\n  | ", " ").split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "mesh.obj: counted from 1, there are 3 faults:",
        "- line 16: face 8 names vertex 9, but there are only 6 vertices",
        "- lines 8, 12: faces [1, 5] have the same corners",
        "- lines 9, 14: faces [2, 6] have the same corners",
        "film.toml:3:8",
    ] {
        assert!(text.contains(part), "no `{part}` in\n{err}");
    }
    // Once these are mended there is a bow-tie.
    let mended = OBJ.replace("f 2 1 3\n", "").replace("f 4 2 1\n", "").replace("f 3 9 1\n", "");
    fs::write(at.join("mesh.obj"), mended).expect("a file");
    let error = read(&at.join("mesh.obj")).expect_err("a bow-tie").to_string();
    assert!(error.contains("mesh.obj, lines 8, 13: counted from 1, the faces around vertex 1 form"), "{error}");
}

/// OFF counts from 0, and faces that were cut are told as they stand in the file.
#[test]
fn polygons_are_told_by_their_own_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mesh.off");
    let points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n1 0 1\n1 1 1\n";
    fs::write(&path, format!("OFF\n8 3 0\n{points}4 0 1 2 3\n4 1 4 5 2\n4 1 2 7 6\n")).expect("a file");
    let error = read(&path).expect_err("three quadrilaterals at an edge").to_string();
    let part = "mesh.off, lines 11, 12, 13: counted from 0, edge [1, 2] is shared by 3 faces [0, 1, 2]";
    assert!(error.contains(part), "{error}");
}
