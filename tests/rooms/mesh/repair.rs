//! What repair orients, drops and refuses.

use immerse::mesh::{Mesh, MeshError, repair};

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// A strip of `2 n` triangles between the cycles 0, 1, … and n, n+1, …, closed with a half turn if asked.
fn band(n: u32, twisted: bool) -> Vec<[u32; 3]> {
    let mut faces = Vec::new();
    for k in 0..n {
        let (a, b) = (k, n + k);
        let (c, d) = match (k + 1 == n, twisted) {
            (false, _) => (k + 1, n + k + 1),
            (true, false) => (0, n),
            (true, true) => (n, 0),
        };
        faces.extend([[a, c, b], [c, d, b]]);
    }
    faces
}

/// A square grid with opposite sides glued, the second pair with a reflection.
fn klein_bottle(n: u32) -> Vec<[u32; 3]> {
    let vertex = |i: u32, j: u32| if i == n { (n - j % n) % n } else { i * n + j % n };
    let mut faces = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let (a, b, c, d) = (vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    faces
}

#[test]
fn a_valid_mesh_is_left_alone() {
    let repaired = repair(4, &TETRAHEDRON).unwrap();
    assert!(repaired.repairs.is_empty());
    assert_eq!(repaired.mesh.triangles(), TETRAHEDRON);
    assert_eq!(repaired.input_vertices, [0, 1, 2, 3]);
}

#[test]
fn one_triangle_is_valid() {
    let mesh = repair(3, &[[0, 1, 2]]).unwrap().mesh;
    assert_eq!((mesh.euler_characteristic(), mesh.boundary_loops().len(), mesh.genus()), (1, 1, 0));
}

#[test]
fn the_majority_decides_the_orientation() {
    for flipped in 0..4 {
        let mut faces = TETRAHEDRON;
        faces[flipped].swap(1, 2);
        assert!(matches!(Mesh::from_faces(4, &faces), Err(MeshError::InconsistentOrientation { .. })));
        let repaired = repair(4, &faces).unwrap();
        let mut fixed = repaired.mesh.triangles()[flipped];
        let smallest = (0..3).min_by_key(|&k| fixed[k]).unwrap();
        fixed.rotate_left(smallest);
        let mut expected = TETRAHEDRON[flipped];
        let smallest = (0..3).min_by_key(|&k| expected[k]).unwrap();
        expected.rotate_left(smallest);
        assert_eq!(fixed, expected);
        assert_eq!(repaired.repairs.len(), 1);
        assert!(repaired.repairs[0].contains("reversed 1 of 4 faces, in 1 component,"), "{}", repaired.repairs[0]);
    }
}

#[test]
fn each_component_is_oriented_on_its_own() {
    let mut faces: Vec<[u32; 3]> = TETRAHEDRON.to_vec();
    faces.extend(TETRAHEDRON.map(|f| f.map(|v| v + 4)));
    faces[1].swap(1, 2);
    faces[6].swap(1, 2);
    let repaired = repair(8, &faces).unwrap();
    assert_eq!(repaired.mesh.components().len(), 2);
    assert!(repaired.repairs[0].contains("reversed 2 of 8 faces, in 2 components"), "{}", repaired.repairs[0]);
}

#[test]
fn unreferenced_vertices_are_dropped_and_reported() {
    let faces = TETRAHEDRON.map(|f| f.map(|v| 2 * v + 1));
    let repaired = repair(9, &faces).unwrap();
    assert_eq!(repaired.mesh.vertex_count(), 4);
    assert_eq!(repaired.input_vertices, [1, 3, 5, 7]);
    assert_eq!(repaired.vertex_map[5].map(|v| v.index()), Some(2));
    assert_eq!(repaired.vertex_map[4], None);
    assert_eq!(repaired.repairs, ["dropped 5 vertices that belong to no face (the first is vertex 0)"]);
}

#[test]
fn a_band_is_orientable_and_a_moebius_band_is_not() {
    let band_mesh = repair(12, &band(6, false)).unwrap().mesh;
    assert_eq!((band_mesh.euler_characteristic(), band_mesh.boundary_loops().len()), (0, 2));
    let error = repair(12, &band(6, true)).unwrap_err();
    let MeshError::NonOrientable { edge, faces } = error.clone() else { panic!("{error}") };
    for f in faces {
        let corners = band(6, true)[f];
        assert!(edge.iter().all(|v| corners.contains(v)), "edge {edge:?} lies in face {f}");
    }
    assert!(error.to_string().contains("not orientable") && error.to_string().contains("double cover"));
}

#[test]
fn a_klein_bottle_is_not_orientable() {
    assert!(matches!(repair(25, &klein_bottle(5)), Err(MeshError::NonOrientable { .. })));
}

#[test]
fn faces_that_cannot_be_repaired_are_named() {
    assert_eq!(repair(0, &[]).unwrap_err(), MeshError::Empty);
    assert_eq!(
        repair(3, &[[0, 1, 2], [0, 1, 7]]).unwrap_err(),
        MeshError::VertexOutOfRange { face: 1, vertex: 7, vertex_count: 3 }
    );
    assert_eq!(
        repair(4, &[[0, 1, 2], [1, 3, 3]]).unwrap_err(),
        MeshError::DegenerateFace { face: 1, corners: [1, 3, 3] }
    );
    for twice in [[0, 1, 3], [3, 1, 0]] {
        let mut faces = TETRAHEDRON.to_vec();
        faces.push(twice);
        assert_eq!(repair(4, &faces).unwrap_err(), MeshError::DuplicateFace { faces: [1, 4] });
    }
    assert_eq!(
        repair(9, &[[4, 5, 6], [5, 4, 7], [4, 5, 8]]).unwrap_err(),
        MeshError::NonManifoldEdge { edge: [4, 5], faces: vec![0, 1, 2] }
    );
}

#[test]
fn a_vertex_of_two_fans_is_named_as_in_the_input() {
    // Vertices 0 and 1 are unreferenced, so the mesh's own number would be another.
    let faces = [[2, 3, 4], [4, 5, 6]];
    assert_eq!(repair(7, &faces).unwrap_err(), MeshError::NonManifoldVertex { vertex: 4 });
}
