//! FOLD files: polygons, decreed lengths, fold angles with their sign, frames that inherit, and what is refused.

use glam::DVec3;
use immerse::immersion::bending_angles;
use immerse::mesh::{EdgeId, Keyframe, Mesh, Surface, read, read_bending_angles, read_length_keyframes, read_lengths};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

struct File(PathBuf, #[allow(dead_code)] TempDir);

fn file(text: &str) -> File {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.fold");
    fs::write(&path, text).unwrap();
    File(path, folder)
}

#[track_caller]
fn surface(text: &str) -> Surface {
    read(&file(text).0).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn says(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

#[track_caller]
fn refused(text: &str, words: &[&str]) {
    says(&read(&file(text).0).map(|s| s.mesh.face_count()).unwrap_err().to_string(), words);
}

fn edge(mesh: &Mesh, u: u32, v: u32) -> EdgeId {
    mesh.edges().find(|e| mesh.file_ends(*e) == [u, v] || mesh.file_ends(*e) == [v, u]).unwrap()
}

/// A sheet of two squares with a crease between them, and `more` keys.
fn sheet(more: &str) -> String {
    format!(
        "{{\"file_spec\": 1.2, \"vertices_coords\": [[0,0],[1,0],[1,1],[0,1],[2,0],[2,1]], \
         \"faces_vertices\": [[0,1,2,3],[1,4,5,2]], \
         \"edges_vertices\": [[0,1],[1,2],[2,3],[3,0],[1,4],[4,5],[5,2]]{more}}}"
    )
}

#[test]
fn faces_positions_and_lengths() {
    let flat = surface(&sheet(""));
    assert_eq!((flat.mesh.vertex_count(), flat.mesh.face_count()), (6, 4));
    assert!(flat.edge_lengths.is_none() && flat.positions.unwrap().iter().all(|p| p.z == 0.0));
    assert_eq!(flat.mesh.file_faces(), [0, 0, 1, 1]);
    // Lengths as drawn leave the diagonals where they are.
    let drawn = surface(&sheet(", \"edges_length\": [1, 1, 1, 1, 1, 1, 1.00001]"));
    let lengths = drawn.edge_lengths.unwrap();
    assert_eq!(lengths[edge(&drawn.mesh, 5, 2).index()], 1.00001);
    let diagonals = lengths.iter().filter(|length| **length == 2.0_f64.sqrt()).count();
    assert_eq!((diagonals, lengths.len()), (2, 9));
    // Other ones do not say what becomes of them.
    refused(
        &sheet(", \"edges_length\": [1, 1, 1, 1, 1, 1, 1.2]"),
        &["face 1 has more than three corners", "triangles"],
    );
    refused(&sheet(", \"edges_length\": [1, 1, 1, null, 1, 1, 1]"), &["1 of 9 edges have no length, the first is 3,0"]);
    // A triangle needs no positions, and an edge without faces no length.
    let text = "{\"faces_vertices\": [[0,1,2]], \"edges_vertices\": [[0,1],[2,1],[0,2],[0,0]], \"edges_length\": [3,4,5,null]}";
    let alone = surface(text);
    assert!(alone.positions.is_none());
    let length = |u, v| alone.edge_lengths.as_ref().unwrap()[edge(&alone.mesh, u, v).index()];
    assert_eq!([length(0, 1), length(1, 2), length(2, 0)], [3.0, 4.0, 5.0]);
    assert_eq!(read_lengths(&file(text).0, &alone.mesh).unwrap(), alone.edge_lengths);
    assert_eq!(read_lengths(&file(&sheet("")).0, &flat.mesh).unwrap(), None);
    says(
        &read_lengths(&file(text).0, &flat.mesh).unwrap_err().to_string(),
        &["a.fold", "faces are not those of the mesh"],
    );
}

/// A valley closes between the normals of its faces and is positive in FOLD; the program's angles are positive as on a sphere.
#[test]
fn fold_angles_have_the_sign_of_the_surface_that_they_fold() {
    // The same sheet with its second square bent up by 30 degrees, toward the side that normals point to: a valley.
    let (c, s) = (30.0_f64.to_radians().cos(), 30.0_f64.to_radians().sin());
    let bent = sheet("").replace("[2,0],[2,1]", &format!("[{}, 0, {s}],[{}, 1, {s}]", 1.0 + c, 1.0 + c));
    let bent = surface(&bent);
    let crease = edge(&bent.mesh, 1, 2);
    let of_positions = bending_angles(&bent.mesh, bent.positions.as_ref().unwrap());
    let flat = surface(&sheet("")).mesh;
    let pattern = sheet(
        ", \"edges_assignment\": [\"B\",\"V\",\"B\",\"B\",\"B\",\"B\",\"B\"], \
                         \"edges_foldAngle\": [0, 30, null, 0, 0, 0, 0]",
    );
    let angles = read_bending_angles(&file(&pattern).0, &flat).unwrap().unwrap();
    let found = angles[crease.index()].unwrap();
    assert!((found - of_positions[crease.index()]).abs() < 1e-12, "{found}, {}", of_positions[crease.index()]);
    assert!((found + 30.0_f64.to_radians()).abs() < 1e-12);
    for e in flat.edges() {
        let expected = match flat.edge_sides(e) {
            None => None,
            Some(_) if e == crease => Some(found),
            // Inside of a square nothing folds.
            Some(_) => Some(0.0),
        };
        assert_eq!(angles[e.index()], expected);
    }
    // A mesh that has all faces the other way round sees the other side.
    let turned = pattern.replace("[[0,1,2,3],[1,4,5,2]]", "[[3,2,1,0],[2,5,4,1]]");
    let angles = read_bending_angles(&file(&turned).0, &flat).unwrap().unwrap();
    assert_eq!(angles[crease.index()], Some(-found));
    // Faces that disagree have no side.
    let mixed = pattern.replace("[1,4,5,2]", "[2,5,4,1]");
    let error = read_bending_angles(&file(&mixed).0, &flat).unwrap_err().to_string();
    says(&error, &["the faces at edge", "disagree in orientation", "counterclockwise"]);
    let unknown = pattern.replace("[0, 30, null", "[0, null, null");
    assert_eq!(read_bending_angles(&file(&unknown).0, &flat).unwrap().unwrap()[crease.index()], None);
    assert_eq!(read_bending_angles(&file(&sheet("")).0, &flat).unwrap(), None);
    let letters = sheet(", \"edges_assignment\": [\"B\",\"M\",\"B\",\"B\",\"B\",\"B\",\"B\"]");
    let error = read_bending_angles(&file(&letters).0, &flat).unwrap_err().to_string();
    says(&error, &["mountains and valleys on a flat sheet", "add `edges_foldAngle`"]);
}

#[test]
fn frames_inherit_and_the_first_with_faces_is_read() {
    let frame = "{\"frame_inherit\": true, \"frame_parent\": 0, \"faces_vertices\": [[0,1,2]], \"frame_title\": \"x\"}";
    let text = format!("{{\"vertices_coords\": [[0,0],[1,0],[0,1]], \"file_frames\": [{{}}, {frame}]}}");
    let found = surface(&text);
    assert_eq!(found.positions.unwrap().len(), 3);
    assert_eq!(found.repairs, ["took frame 2 of the file, the first that has faces"]);
    let text = format!(
        "{{\"vertices_coords\": [[0,0],[1,0],[0,1]], \"faces_vertices\": [[0,2,1]], \"file_frames\": [{frame}]}}"
    );
    let found = surface(&text);
    assert_eq!((found.mesh.triangles(), found.repairs.len()), (vec![[0, 2, 1]], 1));
    let circle = "{\"file_frames\": [{\"frame_inherit\": true, \"frame_parent\": 1, \"faces_vertices\": [[0,1,2]]}]}";
    refused(circle, &["frame 1: it inherits from itself", "correct `frame_parent`"]);
    refused(
        &circle.replace("\"frame_parent\": 1", "\"frame_parent\": 9"),
        &["inherits from frame 9, which is not there"],
    );
}

/// Frames of a file are keyframes, each with what it inherits.
#[test]
fn every_frame_is_a_keyframe() {
    let edges = "\"edges_vertices\": [[0,1],[1,2],[2,0]]";
    let file_of = |top: &str, frames: &[&str]| {
        file(&format!(
            "{{{top}\"vertices_coords\": [[0,0],[4,0],[0,3]], \"faces_vertices\": [[0,1,2]], {edges}, \"file_frames\": [{}]}}",
            frames.join(", ")
        ))
    };
    let mesh = surface("{\"faces_vertices\": [[0,1,2]]}").mesh;
    let heir = |parent: usize, more: &str| format!("{{\"frame_inherit\": true, \"frame_parent\": {parent}, {more}}}");
    let frames = [
        heir(0, "\"vertices_coords\": [[0,0],[8,0],[0,6]]"), // places of its own
        heir(0, "\"edges_length\": [2, 3, 4]"),              // lengths of its own
        heir(2, "\"edges_length\": null"),                   // those of the frame before
        heir(5, "\"vertices_coords\": [[0,0],[1,0],[0,1]]"), // of one that comes later
        heir(0, "\"edges_length\": [5, 6, 7]"),
    ];
    let all: Vec<&str> = frames.iter().map(String::as_str).collect();
    let keys = read_length_keyframes(&file_of("", &all).0, &mesh).unwrap();
    let at = |points: [[f64; 2]; 3]| Keyframe::Positions(points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec());
    let of = |values: [f64; 3]| {
        let length = |e| {
            let [u, v] = mesh.file_ends(e);
            values[if u.abs_diff(v) == 2 { 2 } else { u.min(v) as usize }]
        };
        Keyframe::Decreed(mesh.edges().map(length).collect())
    };
    let expected = vec![
        at([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]),
        at([[0.0, 0.0], [8.0, 0.0], [0.0, 6.0]]),
        of([2.0, 3.0, 4.0]),
        of([2.0, 3.0, 4.0]),
        of([5.0, 6.0, 7.0]),
        of([5.0, 6.0, 7.0]),
    ];
    assert_eq!(keys, expected);
    // A mesh is the key frame, and is told of the others.
    let found = read(&file_of("", &all).0).unwrap();
    assert!(found.edge_lengths.is_none() && found.repairs[0].contains("left out the 5 frames after it"));
    // One unit in all of them, whatever it is; what a frame does not say it inherits, else it is none.
    let in_units = |top: &str, more: &[&str]| {
        let frames: Vec<String> = more.iter().map(|more| heir(0, more)).collect();
        let frames: Vec<&str> = frames.iter().map(String::as_str).collect();
        read_length_keyframes(&file_of(top, &frames).0, &mesh).map(|keys| keys.len()).map_err(|error| error.to_string())
    };
    let [mm, cm, none] = ["\"frame_unit\": \"mm\"", "\"frame_unit\": \"cm\"", "\"frame_unit\": \"unit\""];
    assert_eq!(in_units(&format!("{mm}, "), &[mm, "\"edges_length\": [3, 4, 5]"]), Ok(3));
    assert_eq!(in_units("", &[none]), Ok(2));
    for (top, of) in [(format!("{mm}, "), [mm, cm]), (String::new(), [none, mm])] {
        let error = in_units(&top, &of).unwrap_err();
        says(&error, &["a.fold", "frame 2: it is measured in", "and frame 0 in", "bring all frames to one unit"]);
    }
    // What does not fit is told with its frame.
    for (frame, words) in [
        (heir(0, "\"faces_vertices\": [[0,1,3]]"), ["frame 2: its faces are not those of the mesh", "same faces"]),
        (heir(0, "\"faces_vertices\": [[0,2,3],[0,1,2]]"), ["frame 2: its faces are not", "same order"]),
        ("{}".to_owned(), ["frame 2: `faces_vertices` is empty", "triangle"]),
        (heir(0, "\"edges_length\": [1, 2]"), ["frame 2: `edges_length` has 2 entries", "for each edge"]),
        (heir(0, "\"edges_length\": [1, 2, -3]"), ["frame 2: edge 2,0 has length -3", "above 0"]),
        (heir(0, "\"edges_length\": [1, 2, \"a\"]"), ["frame 2: `edges_length` is not what FOLD has there", "number"]),
        (heir(0, "\"frame_unit\": 3"), ["frame 2: `frame_unit` is not what FOLD has there", "mm"]),
        (
            heir(9, "\"edges_length\": [1, 2, 2]"),
            ["frame 2: it inherits from frame 9, which is not there", "frame_parent"],
        ),
        (heir(2, "\"edges_length\": [1, 2, 2]"), ["frame 2: it inherits from itself", "frame_parent"]),
        ("{\"frame_inherit\": 1}".to_owned(), ["frame 2: `frame_inherit` is not what FOLD has there", "true or false"]),
        ("7".to_owned(), ["frame 2: it is no object", "export it again"]),
    ] {
        let file = file_of("", &[&frames[0], &frame]);
        says(&read_length_keyframes(&file.0, &mesh).unwrap_err().to_string(), &words);
    }
    let circle = [heir(2, "\"edges_length\": [1, 2, 2]"), heir(1, "\"edges_length\": [1, 2, 2]")];
    refused(&format!("{{\"file_frames\": [{}]}}", circle.join(",")), &["it inherits from itself"]);
    let many = vec!["{}"; 10_000];
    let error = read_length_keyframes(&file_of("", &many).0, &mesh).unwrap_err().to_string();
    says(&error, &["there are 10001 frames, 10000 are the limit"]);
    // Long chains are followed once.
    let chain: Vec<String> = (0..9_000).map(|k| heir(k, "\"frame_title\": \"x\"")).collect();
    let chain: Vec<&str> = chain.iter().map(String::as_str).collect();
    assert_eq!(read_length_keyframes(&file_of("", &chain).0, &mesh).unwrap().len(), 9_001);
}

#[test]
fn what_may_be_misread_is_refused() {
    let replaced = |from: &str, to: &str| sheet("").replace(from, to);
    for (text, words) in [
        ("{\"vertices_coords\": [[0,0]".to_owned(), ["a.fold:1:", "this is not JSON"].as_slice()),
        ("[]".into(), &["no FOLD file: it is no object"]),
        ("hello".into(), &["this is not JSON"]),
        ("{}".into(), &["there is no `faces_vertices`"]),
        (
            "{\"edges_vertices\": [[0,1]]}".into(),
            &["edges, but no `faces_vertices`", "edges_vertices_to_faces_vertices"],
        ),
        ("{\"faces_vertices\": []}".into(), &["`faces_vertices` is empty"]),
        ("{\"faces_vertices\": [[0,1]]}".into(), &["face 0 has 2 corners"]),
        ("{\"faces_vertices\": [[0,1,-1]]}".into(), &["`faces_vertices` is not what FOLD has", "count from 0"]),
        ("{\"faces_vertices\": [[0,1,2.5]]}".into(), &["`faces_vertices` is not what FOLD has"]),
        ("{\"faces_vertices\": [[0,1,99]]}".into(), &["vertex 99 is named, but all faces together have 3"]),
        ("{\"file_frames\": 3}".into(), &["`file_frames` is no list"]),
        (replaced("[2,1]]", "[2]]"), &["vertex 5 has 1 coordinates"]),
        (replaced("[2,1]]", "[2,\"a\"]]"), &["`vertices_coords` is not what FOLD has", "two or three coordinates"]),
        (replaced("[2,1]]", "[2,1e400]]"), &["`vertices_coords` is not what FOLD has", "number out of range"]),
        (replaced(",[2,1]]", "]"), &["names vertex 5, but there are only 5"]),
        (sheet(", \"edges_length\": [1]"), &["`edges_length` has 1 entries, and `edges_vertices` has 7"]),
        (sheet(", \"edges_length\": [1,1,1,1,1,1,-1]"), &["edge 5,2 has length -1"]),
        (sheet(", \"edges_foldAngle\": [1]"), &["`edges_foldAngle` has 1 entries"]),
        (sheet(", \"edges_foldAngle\": [0,270,0,0,0,0,0]"), &["edge 1, from vertex 1 to 2", "from -180 to 180"]),
        (
            sheet(
                ", \"edges_assignment\": [\"B\",\"M\",\"B\",\"B\",\"B\",\"B\",\"B\"], \"edges_foldAngle\": [0,90,0,0,0,0,0]",
            ),
            &["has fold angle 90", "it is a mountain (M)"],
        ),
        (
            sheet(", \"edges_length\": [1,1,1,1,1,1,1]").replace("[5,2]]", "[1,0]]").replace("1,1]}", "1,2]}"),
            &["edge 1,0 has length 2 in edge 6 and 1 in edge 0"],
        ),
        (
            sheet(", \"edges_length\": [1,1,1,1,1,1,1]").replace("\"edges_vertices\"", "\"edges\""),
            &["there is `edges_length`, and no `edges_vertices`"],
        ),
    ] {
        refused(&text, words);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    fs::write(&path, sheet("")).unwrap();
    says(&read(&path).map(|s| s.mesh.face_count()).unwrap_err().to_string(), &["is a FOLD file", "ends in .fold"]);
}
