//! What is written is read back, to the last bit.

use std::fs;

use glam::DVec3;
use immerse::advice::Advice;
use immerse::mesh::{Mesh, Surface, WriteError, read, shapes, write_obj};
use tempfile::TempDir;

/// A surface of several components, with numbers of all sizes and signs, none of them short.
fn awkward() -> Surface {
    let ball = shapes::sphere(1.0 / 3.0, 4).expect("a ball");
    let ring = shapes::annulus(0.1, 0.7, 9, 2).expect("a ring");
    let shift = ball.mesh.vertex_count() as u32;
    let mut faces = ball.mesh.triangles();
    faces.extend(ring.mesh.triangles().iter().map(|face| face.map(|v| v + shift)));
    let mut positions = ball.positions.expect("points");
    positions.extend(ring.positions.expect("points").iter().map(|p| *p * 1e9 + DVec3::new(3e9, 0.1, -0.0)));
    positions[0] *= 1.0 + f64::EPSILON;
    positions[1] = DVec3::new(f64::MIN_POSITIVE, -5e-324, 999999999999999.9);
    Surface::from_positions(positions, &faces).expect("a surface")
}

fn bits(positions: &[DVec3]) -> Vec<[u64; 3]> {
    positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

#[test]
fn a_surface_is_read_back_to_the_last_bit() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("shape.obj");
    let Surface { mesh, positions, .. } = awkward();
    let positions = positions.expect("points");
    write_obj(&path, &mesh, &positions).expect("a file");
    let again = read(&path).expect("a surface");
    assert_eq!(again.mesh.triangles(), mesh.triangles());
    assert_eq!(bits(&again.positions.expect("points")), bits(&positions));
    assert_eq!(again.repairs, Vec::<String>::new());
    // What was there before is replaced, and nothing else is left in the folder.
    let triangle = Mesh::from_faces(3, &[[0, 1, 2]]).unwrap();
    write_obj(&path, &triangle, &[DVec3::ZERO, DVec3::X, DVec3::Y]).expect("a file");
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text, "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\nf 1 2 3\n");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Vertices of the file that belong to no face are left out, and the others keep their order.
#[test]
fn vertices_keep_the_order_of_the_file() {
    let folder = TempDir::new().unwrap();
    let [from, to] = ["from.obj", "to.obj"].map(|name| folder.path().join(name));
    fs::write(&from, "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0\nv 1 1 2\nf 6 5 3\nf 2 3 5\n").unwrap();
    let surface = read(&from).unwrap();
    write_obj(&to, &surface.mesh, &surface.positions.clone().unwrap()).unwrap();
    let text = fs::read_to_string(&to).unwrap();
    assert_eq!(text, "v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 1.0 0.0\nv 1.0 1.0 2.0\nf 4 3 2\nf 1 2 3\n");
    assert_eq!(read(&to).unwrap().mesh.triangles(), surface.mesh.triangles());
}

#[test]
fn what_cannot_be_written_is_told_with_a_remedy() {
    let folder = TempDir::new().unwrap();
    let mesh = Mesh::from_faces(3, &[[0, 1, 2]]).unwrap();
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let missing = folder.path().join("missing");
    let path = missing.join("shape.obj");
    let error = write_obj(&path, &mesh, &points).expect_err("no folder");
    assert_eq!(error, WriteError::NoFolder { path, folder: missing.clone() });
    assert!(error.to_string().contains(&format!("there is no folder {}", missing.display())), "{error}");
    assert_eq!(error.remedy(), "make the folder first, or write to another one");
    assert!(error.reason().ends_with("missing"), "{}", error.reason());

    let path = folder.path().join("shape.obj");
    fs::write(&path, "before").unwrap();
    let error = write_obj(&path, &mesh, &points[..2]).expect_err("two positions");
    assert!(error.to_string().contains("there are 2 positions for 3 vertices; give one"), "{error}");
    let error = write_obj(&path, &mesh, &[DVec3::ZERO, DVec3::NAN, DVec3::Y]).expect_err("NaN");
    assert!(
        error.to_string().contains("vertex 1 lies at [NaN, NaN, NaN], which is not finite; give finite"),
        "{error}"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "before");

    fs::create_dir(folder.path().join("taken")).unwrap();
    let error = write_obj(&folder.path().join("taken"), &mesh, &points).expect_err("a folder");
    assert!(error.to_string().contains("cannot be written") && error.remedy().contains("permissions"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left");
}
