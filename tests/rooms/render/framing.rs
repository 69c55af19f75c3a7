//! The default view depends on the shape alone: not on the unit of length, the place in space or the triangles.

use crate::support::{Random, program, subdivide};
use glam::{DMat3, DQuat, DVec3};
use immerse::{
    immersion::RigidMotion,
    mesh::shapes,
    render::{Camera, Extent, Output, View},
};

/// A box with its corners at these multiples of its sides.
fn cuboid(sides: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corners = (0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * sides);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (corners.collect(), quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// A box that is open above: every axis has a side.
fn basin() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (corners, mut faces) = cuboid(DVec3::new(4.0, 2.0, 0.7));
    faces.drain(2..4);
    (corners, faces)
}

fn sphere(subdivisions: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let surface = shapes::sphere(1.0, subdivisions).unwrap();
    (surface.positions.unwrap(), surface.mesh.triangles())
}

fn rotation_of(extent: &Extent) -> DMat3 {
    let output = Output::new(640, 480, 1).unwrap();
    Camera::framing(&View::default(), extent, &output).unwrap().view_from_world().matrix3
}

fn rotation(positions: &[DVec3], triangles: &[[u32; 3]]) -> DMat3 {
    rotation_of(&Extent::of_surface(positions, triangles))
}

fn apart(a: DMat3, b: DMat3) -> f64 {
    (a - b).to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn scaled(positions: &[DVec3], factor: f64) -> Vec<DVec3> {
    positions.iter().map(|&p| p * factor).collect()
}

#[test]
fn the_unit_of_length_makes_no_difference() {
    let solids = [cuboid(DVec3::new(4.0, 2.0, 0.7)), basin(), sphere(3), cuboid(DVec3::ONE)];
    for (k, (positions, triangles)) in solids.iter().enumerate() {
        let usual = rotation(positions, triangles);
        let points = rotation_of(&Extent::of(positions));
        for factor in [2.0_f64.powi(-7), 2.0_f64.powi(40), 2.0_f64.powi(-60)] {
            let scaled = scaled(positions, factor);
            assert_eq!(rotation(&scaled, triangles), usual, "solid {k}: a power of two scales exactly");
            assert_eq!(rotation_of(&Extent::of(&scaled)), points, "solid {k}");
        }
        for factor in [0.2, 1e-3, 25.4, 1e6] {
            let apart = apart(rotation(&scaled(positions, factor), triangles), usual);
            assert!(apart < 1e-12, "solid {k} at scale {factor}: {apart}");
        }
    }
}

#[test]
fn the_number_of_triangles_makes_no_difference() {
    for (k, (positions, triangles)) in [cuboid(DVec3::new(4.0, 2.0, 0.7)), basin(), sphere(2)].into_iter().enumerate() {
        let usual = rotation(&positions, &triangles);
        let mut finer = positions.clone();
        let mut fine = triangles.clone();
        for _ in 0..3 {
            fine = subdivide(&mut finer, &fine);
        }
        assert!(apart(rotation(&finer, &fine), usual) < 1e-12, "solid {k}, all triangles cut");
        // One side has most of the vertices.
        let mut uneven = positions.clone();
        let mut faces = triangles[..2].to_vec();
        for _ in 0..4 {
            faces = subdivide(&mut uneven, &faces);
        }
        faces.extend(&triangles[2..]);
        assert!(apart(rotation(&uneven, &faces), usual) < 1e-12, "solid {k}, two triangles cut");
    }
}

#[test]
fn far_from_the_origin_a_surface_is_seen_as_at_the_origin() {
    let far = DVec3::new(1e8, -3e8, 2e8);
    for (positions, triangles) in [cuboid(DVec3::new(4.0, 2.0, 0.7)), basin(), sphere(3)] {
        let moved: Vec<DVec3> = positions.iter().map(|&p| p + far).collect();
        let back: Vec<DVec3> = moved.iter().map(|&p| p - far).collect();
        assert!(apart(rotation(&moved, &triangles), rotation(&back, &triangles)) < 1e-12);
        assert!(apart(rotation(&moved, &triangles), rotation(&positions, &triangles)) < 1e-6);
        let [there, here] = [&moved, &back].map(|points| {
            let mut film = Extent::default();
            film.merge(&Extent::of_surface(points, &triangles));
            film.merge(&Extent::of_surface(&points.iter().map(|&p| p + DVec3::X).collect::<Vec<_>>(), &triangles));
            film
        });
        assert!(apart(rotation_of(&there), rotation_of(&here)) < 1e-6);
    }
}

/// What is round has no axes of its own: rounding and the choice of vertices must not give it any.
#[test]
fn what_is_round_is_seen_with_its_height_upward() {
    let mut random = Random::new(5);
    let (cube, faces) = cuboid(DVec3::ONE);
    let upright = rotation(&cube, &faces);
    assert!((upright * DVec3::Z).y > 0.8, "z is up in the picture: {upright}");
    for (mut positions, triangles) in [sphere(1), sphere(2), sphere(4)] {
        assert!(apart(rotation(&positions, &triangles), upright) < 1e-12);
        positions.iter_mut().for_each(|p| *p *= 1.0 + 1e-3 * random.unit());
        assert!(apart(rotation(&positions, &triangles), upright) < 0.02, "a sphere with noise");
    }
    // A cylinder with any number of sides, which is round about its axis.
    let of_sides = |sides: usize| {
        let cylinder = shapes::cylinder(1.0, 5.0, sides, 4).unwrap();
        rotation(&cylinder.positions.unwrap(), &cylinder.mesh.triangles())
    };
    for sides in [5, 12, 37, 100] {
        assert!(apart(of_sides(sides), of_sides(64)) < 1e-9, "{sides} sides");
    }
}

#[test]
fn principal_axes_of_round_things_are_those_of_space() {
    let surface = shapes::sphere(1.0, 3).unwrap();
    let positions = surface.positions.unwrap();
    let weights = vec![1.0; positions.len()];
    let motion = RigidMotion::to_principal_axes(&positions, &weights);
    let moved = positions.iter().map(|&p| motion.point(p).distance(p)).fold(0.0, f64::max);
    assert!(moved < 1e-12, "a sphere stays as it is: {moved}");
    // Nor does the unit matter, of lengths or of weights.
    let egg: Vec<DVec3> = positions
        .iter()
        .map(|&p| DQuat::from_rotation_x(0.7) * (DVec3::new(2.0, 1.0, 0.6) * p * (1.0 + 0.2 * p.x + 0.1 * p.y)))
        .collect();
    let usual = RigidMotion::to_principal_axes(&egg, &weights);
    for factor in [2.0_f64.powi(-60), 2.0_f64.powi(-7), 2.0_f64.powi(100)] {
        let weights = vec![factor * factor; egg.len()];
        let motion = RigidMotion::to_principal_axes(&scaled(&egg, factor), &weights);
        for &p in &egg {
            assert!(motion.point(p * factor).distance(usual.point(p) * factor) < 1e-12 * factor);
        }
    }
}

/// Onto the mirror image of a sphere many rotations are as good, and onto points on a line.
#[test]
fn of_motions_that_are_as_close_the_one_that_turns_least_is_taken() {
    let (positions, _) = sphere(3);
    let weights = vec![1.0; positions.len()];
    let mirror: Vec<DVec3> = positions.iter().map(|&p| DVec3::new(-p.x, p.y, p.z)).collect();
    let line: Vec<DVec3> = positions.iter().map(|&p| DVec3::X * p.x).collect();
    for factor in [1.0, 0.2, 2.0_f64.powi(-7), 37.0] {
        let onto = |reference: &[DVec3], positions: &[DVec3]| {
            RigidMotion::onto(&scaled(reference, factor), &scaled(positions, factor), &weights)
        };
        let turned = onto(&mirror, &positions);
        // None is as good as half turns about y and z.
        for &p in &positions {
            assert!(turned.point(p * factor).distance(p * factor) < 1e-9 * factor, "scale {factor}");
        }
        let still = onto(&line, &line);
        assert!(still.point(DVec3::Z * factor).distance(DVec3::Z * factor) < 1e-9 * factor, "scale {factor}");
    }
}

/// Rotation from the scene to the eye, as an EXR picture says it.
fn world_to_camera(picture: &std::path::Path) -> Vec<f32> {
    let bytes = std::fs::read(picture).unwrap();
    let name = b"worldToCamera\0m44f\0\x40\0\0\0";
    let start = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len();
    let number = |k: usize| f32::from_le_bytes(bytes[start + 4 * k..start + 4 * k + 4].try_into().unwrap());
    [0, 1, 2, 4, 5, 6, 8, 9, 10].map(number).to_vec()
}

/// A relaxed box as the program shows it.
#[test]
fn a_scene_in_another_unit_has_the_same_view() {
    let folder = tempfile::TempDir::new().unwrap();
    let view = |name: &str, factor: f64, shift: f64, start: &str| {
        let (corners, faces) = cuboid(DVec3::new(4.0, 2.0, 0.7));
        let mut positions = corners;
        let faces = subdivide(&mut positions, &faces);
        let mut obj = String::new();
        positions.iter().for_each(|p| {
            let p = *p * factor + shift;
            obj.push_str(&format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z));
        });
        faces.iter().for_each(|[a, b, c]| obj.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1)));
        std::fs::write(folder.path().join(format!("{name}.obj")), obj).unwrap();
        let text = format!(
            "[mesh]\nfile = '{name}.obj'\n[start]\n{start}\n[bending]\nfrom = 'mesh'\n\
             [output]\nsize = [32, 24]\nsamples = 1\nformat = 'exr'\n"
        );
        std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        let (code, _, err) = program(folder.path(), &["run", &format!("{name}.toml"), "--out", name, "-q"]);
        assert_eq!(code, 0, "{err}");
        world_to_camera(&folder.path().join(name).join("000001.exr"))
    };
    for start in ["from = 'mesh'", "random = 1"] {
        let usual = view("usual", 1.0, 0.0, start);
        assert_eq!(view("small", 2.0_f64.powi(-7), 0.0, start), usual, "{start}");
        for (name, factor, shift) in [("fifth", 0.2, 0.0), ("far", 1.0, 1e8)] {
            let other = view(name, factor, shift, start);
            let apart = other.iter().zip(&usual).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(apart < 1e-4, "{name}, {start}: {apart}");
        }
        for name in ["usual", "small", "fifth", "far"] {
            std::fs::remove_dir_all(folder.path().join(name)).unwrap();
        }
    }
}

#[test]
fn triangles_with_a_corner_that_has_no_position_are_left_out() {
    let positions = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(9.0, 9.0, 1.0)];
    let [with, without] = [&[[0, 1, 2], [1, 2, 9]][..], &[[0, 1, 2]]];
    assert_eq!(rotation(&positions, with), rotation(&positions, without));
}
