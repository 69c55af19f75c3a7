//! Numbers that 32 bits do not hold are refused before anything is computed or reserved for them.

use std::fs;
use std::time::Instant;

use immerse::mesh::{Component, MOST_VERTICES, Mesh, MeshError, VertexId, read, read_positions, repair};
use std::sync::Arc;
use tempfile::TempDir;

const TRIANGLE: [[u32; 3]; 1] = [[0, 1, 2]];

#[test]
fn a_mesh_has_fewer_vertices_than_32_bits_count() {
    for vertices in [MOST_VERTICES + 1, 1 << 32, (1 << 32) + 3, usize::MAX] {
        let expected =
            |error: &MeshError| matches!(error, MeshError::TooLarge { faces: 1, vertices: v, .. } if *v == vertices);
        let error = Mesh::from_faces(vertices, &TRIANGLE).expect_err("too many vertices");
        assert!(expected(&error), "{vertices}: {error}");
        let error = repair(vertices, &TRIANGLE).expect_err("too many vertices");
        assert!(expected(&error), "{vertices}: {error}");
        assert!(error.to_string().ends_with("are the limit; use a coarser mesh"), "{error}");
    }
}

#[test]
fn what_is_not_there_is_not_taken_for_something_else() {
    let two = Mesh::from_faces(6, &[[0, 1, 2], [3, 4, 5]]).expect("two triangles");
    let components = Component::all_of(&Arc::new(two));
    assert_eq!(components[1].vertices.here(3), Some(0));
    // 3 in the lower half of the bits.
    assert_eq!(components[1].vertices.here((1 << 32) + 3), None);
    assert!(std::panic::catch_unwind(|| VertexId::new((1 << 32) + 3)).map_or(true, |v| v.index() != 3));
}

/// An error with the name of the file, at once.
#[track_caller]
fn refused(name: &str, bytes: impl AsRef<[u8]>, part: &str) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, &bytes).unwrap();
    let start = Instant::now();
    let error = read(&path).map(|_| ()).expect_err(part).to_string();
    assert!(error.contains(name) && error.contains(part), "{part}: {error}");
    let triangle = Mesh::from_faces(3, &TRIANGLE).unwrap();
    let error = read_positions(&path, &triangle).map(|_| ()).expect_err(part).to_string();
    assert!(error.contains(name) && error.contains(part), "{part}: {error}");
    assert!(start.elapsed().as_secs_f64() < 1.0, "{name}: {part}");
}

const ABSURD: [u64; 5] = [1_431_655_765, 4_294_967_295, 4_294_967_296, 1 << 63, u64::MAX];

#[test]
fn counts_that_a_file_announces_and_does_not_hold() {
    let vertices = "property float x\nproperty float y\nproperty float z\n";
    for count in ABSURD {
        for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let ply = |vertex_count: u64, more: &str, face_count: u64| {
                format!(
                    "ply\nformat {format} 1.0\nelement vertex {vertex_count}\n{vertices}{more}\
                     element face {face_count}\nproperty list uint uint vertex_indices\nend_header\n"
                )
            };
            let claim = format!("{count} of element");
            refused("a.ply", ply(count, "", 1), &claim);
            refused("a.ply", ply(0, "", count), &claim);
            refused("a.ply", ply(0, &format!("element nothing {count}\n"), 1), &claim);
        }
        let reason = if count > u32::MAX.into() { "is not a number from 0 to 4294967295" } else { "are claimed" };
        refused("a.off", format!("OFF\n{count} 1 0\n0 0 0\n"), reason);
        refused("a.off", format!("OFF\n3 {count} 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), reason);
        let sides = if count > u32::MAX.into() { "is not a number from" } else { "a corner is missing" };
        refused("a.off", format!("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n{count} 0 1 2\n"), sides);
    }
    for beyond in ["99999999999999999999", "-1", "1e3"] {
        refused("a.ply", format!("ply\nformat ascii 1.0\nelement vertex {beyond}\nend_header\n"), "is not understood");
    }
    for count in [u32::MAX, u32::MAX / 3, 1 << 31] {
        let mut stl = vec![0; 80];
        stl.extend(count.to_le_bytes());
        stl.extend([0; 100]);
        refused("a.stl", stl, &format!("{count} triangles are claimed"));
        let mut ply = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex 1\n{vertices}element face 1\n\
             property list uint uint vertex_indices\nend_header\n"
        )
        .into_bytes();
        ply.extend([0; 12]);
        ply.extend(count.to_le_bytes());
        refused("a.ply", ply, &format!("a list claims {count} values"));
    }
}

#[test]
fn corners_that_are_no_numbers_of_vertices() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for number in ["4294967296", "4294967297", "9223372036854775807", "-9223372036854775808", "18446744073709551617"] {
        refused("a.obj", format!("{points}f 1 2 {number}\n"), number);
    }
    // Without vertices a mesh has as many as its faces name.
    for number in ["4294967295", "4294967296"] {
        refused("a.obj", format!("f 1 2 {number}\n"), "triangles have fewer corners");
    }
    for number in ["4294967295", "4294967296", "18446744073709551616", "-1", "0.5", "nan", "1e300"] {
        let ply = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element face 1\nproperty list uchar double vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 {number}\n"
        );
        refused("a.ply", ply, "a.ply:13: face 0 names vertex");
        let reason = if number == "4294967295" { "names vertex 4294967295" } else { "is not a number from 0" };
        refused("a.off", format!("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 {number}\n"), reason);
    }
}
