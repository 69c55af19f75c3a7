//! Seams: what is glued, what is not, and what is said of it.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use crate::support::{Random, program};
use glam::DVec3;
use immerse::mesh::Weld;
use immerse::mesh::{Surface, VertexId, read, read_edge_lengths, read_welded, shapes};

type Triangles = Vec<[u32; 3]>;

/// Every triangle with corners of its own where `apart` says so of the triangle and the vertex.
fn obj(points: &[DVec3], faces: &[[u32; 3]], group: impl Fn(usize, u32) -> usize) -> String {
    let (mut lines, mut numbers, mut text) = (String::new(), HashMap::new(), String::new());
    for (f, face) in faces.iter().enumerate() {
        let corners = face.map(|v| {
            let next = numbers.len() + 1;
            *numbers.entry((v, group(f, v))).or_insert_with(|| {
                let p = points[v as usize];
                text += &format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z);
                next
            })
        });
        lines += &format!("f {} {} {}\n", corners[0], corners[1], corners[2]);
    }
    text + &lines
}

fn stl(points: &[DVec3], faces: &[[u32; 3]], mut jitter: impl FnMut() -> DVec3) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        bytes.extend([0; 12]);
        for v in face {
            let p = points[*v as usize] + jitter();
            p.to_array().iter().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn parts(surface: Surface) -> (Vec<DVec3>, Triangles) {
    (surface.positions.expect("positions"), surface.mesh.triangles())
}

/// The faces of a cube of side 1 at a corner, two triangles a side, all eight corners shared.
fn cube(at: DVec3) -> (Vec<DVec3>, Triangles) {
    let points = (0..8).map(|k| at + DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (points, quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// Two bodies in one list.
fn both(a: (Vec<DVec3>, Triangles), b: (Vec<DVec3>, Triangles)) -> (Vec<DVec3>, Triangles) {
    let shift = a.0.len() as u32;
    let faces = a.1.into_iter().chain(b.1.into_iter().map(|f| f.map(|v| v + shift))).collect();
    (a.0.into_iter().chain(b.0).collect(), faces)
}

fn read_bytes(name: &str, bytes: impl AsRef<[u8]>, weld: Option<Weld>) -> Surface {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(name);
    fs::write(&path, bytes).expect("a file");
    read_welded(&path, weld).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Vertices, Euler characteristic, boundary loops, components.
fn topology(surface: &Surface) -> (usize, i64, usize, usize) {
    let mesh = &surface.mesh;
    (mesh.vertex_count(), mesh.euler_characteristic(), mesh.boundary_loops().len(), mesh.components().len())
}

fn says(surface: &Surface, words: &str) -> bool {
    surface.repairs.iter().any(|sentence| sentence.contains(words))
}

#[test]
fn a_sphere_with_a_seam() {
    let (points, faces) = parts(shapes::uv_sphere(1.0, 16, 9).expect("a sphere"));
    // A vertex of the half-plane y = 0, x > 0 (and both poles) is another one for faces on the other side.
    let middle = |f: usize| faces[f].iter().map(|&v| points[v as usize].y).sum::<f64>();
    let on_seam = |v: u32| points[v as usize].y.abs() < 1e-12 && points[v as usize].x > 1e-9;
    let text = obj(&points, &faces, |f, v| usize::from(on_seam(v) && middle(f) < 0.0));
    let welded = read_bytes("a.obj", &text, None);
    assert_eq!(topology(&welded), (points.len(), 2, 0, 1));
    assert!(says(&welded, "welded 10 pairs of boundary edges that lie upon each other"), "{:?}", welded.repairs);
    assert!(says(&welded, "weld = \"none\"") && welded.repairs.len() == 1, "{:?}", welded.repairs);
    let doubled = text.lines().filter(|line| line.starts_with('v')).count() - points.len();
    assert_eq!(doubled, 9);
    let open = read_bytes("a.obj", &text, Some(Weld::None));
    assert_eq!(topology(&open), (points.len() + doubled, 1, 1, 1));
    let said = format!("{doubled} boundary vertices lie at the place of another one");
    assert!(says(&open, &said) && says(&open, "weld = \"exact\""), "{:?}", open.repairs);
    // Both numbers mean the merged vertex, whose own is the smaller.
    for (number, v) in (0..welded.mesh.file_vertex_count()).map(|n| (n, welded.mesh.vertex_of_file(n).expect("used"))) {
        assert!(welded.mesh.file_vertex(v) <= number);
    }
}

#[test]
fn a_cube_with_24_vertices() {
    let (points, faces) = cube(DVec3::ZERO);
    let text = obj(&points, &faces, |f, _| f / 2);
    assert_eq!(topology(&read_bytes("a.obj", &text, None)), (8, 2, 0, 1));
    assert_eq!(topology(&read_bytes("a.obj", &text, Some(Weld::Exact))), (8, 2, 0, 1));
    assert_eq!(topology(&read_bytes("a.obj", &text, Some(Weld::None))), (24, 6, 6, 6));
    // Each triangle by itself, and every other face the wrong way round.
    assert_eq!(topology(&read_bytes("a.obj", obj(&points, &faces, |f, _| f), None)), (8, 2, 0, 1));
    let turned: Triangles =
        faces.iter().enumerate().map(|(f, &[a, b, c])| if f % 3 == 0 { [b, a, c] } else { [a, b, c] }).collect();
    let surface = read_bytes("a.obj", obj(&points, &turned, |f, _| f), None);
    assert_eq!(topology(&surface), (8, 2, 0, 1));
    assert!(says(&surface, "reversed 4 of 12 faces"), "{:?}", surface.repairs);
}

#[test]
fn jitter() {
    let mut random = Random::new(3);
    for (name, (points, faces)) in [
        ("sphere", parts(shapes::sphere(1.0, 8).expect("a sphere"))),
        ("torus", parts(shapes::torus(1.0, 0.4, 30, 16).expect("a torus"))),
        ("cube", cube(DVec3::new(0.3, 0.1, 0.7))),
    ] {
        let characteristic = if name == "torus" { 0 } else { 2 };
        for share in [0.0, 0.1, 1.0] {
            let mut noise = || if random.unit() < share { 1e-7 * random.vector() } else { DVec3::ZERO };
            let surface = read_bytes("a.stl", stl(&points, &faces, &mut noise), None);
            assert_eq!(topology(&surface), (points.len(), characteristic, 0, 1), "{name} {share}");
            let numbers: Vec<u32> = (0..points.len() as u32).collect();
            assert_eq!(surface.mesh.file_vertices(), numbers, "STL has no numbers of its own");
        }
        // Formats that name vertices want to be asked.
        let mut shaken = points.clone();
        shaken.extend(points.iter().map(|p| *p + 1e-7 * random.vector()));
        let second: Triangles = faces
            .iter()
            .enumerate()
            .map(|(f, face)| if f < 6 { face.map(|v| v + points.len() as u32) } else { *face })
            .collect();
        let text = obj(&shaken, &second, |_, _| 0);
        let open = read_bytes("a.obj", &text, None);
        assert!(!open.mesh.boundary_loops().is_empty());
        assert!(says(&open, "of another one") && says(&open, "a distance as `weld`"), "{name}: {:?}", open.repairs);
        let closed = read_bytes("a.obj", &text, Some(Weld::Within(1e-6)));
        assert_eq!(topology(&closed), (points.len(), characteristic, 0, 1), "{name}");
        assert!(says(&closed, "lie within 1.0e-6 of each other"), "{:?}", closed.repairs);
    }
}

#[test]
fn a_torus_with_a_seam_both_ways() {
    let (columns, rows) = (12, 7);
    let point = |i: usize, j: usize| {
        let angle = |k: usize, n: usize| std::f64::consts::TAU * (k % n) as f64 / n as f64;
        let (a, b) = (angle(i, columns), angle(j, rows));
        let r = 1.0 + 0.4 * b.cos();
        format!("v {:?} {:?} {:?}\n", r * a.cos(), r * a.sin(), 0.4 * b.sin())
    };
    let mut text: String =
        (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j))).map(|(i, j)| point(i, j)).collect();
    let vertex = |i: usize, j: usize| 1 + i * (rows + 1) + j;
    for (i, j) in (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        text += &format!("f {} {} {} {}\n", vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
    let surface = read_bytes("a.obj", &text, None);
    assert_eq!(topology(&surface), (columns * rows, 0, 0, 1));
    // All four corners are one vertex.
    let corners = [vertex(0, 0), vertex(columns, 0), vertex(0, rows), vertex(columns, rows)];
    assert!(corners.iter().all(|&n| surface.mesh.vertex_of_file(n - 1) == Ok(VertexId::new(0))));
    assert_eq!(topology(&read_bytes("a.obj", &text, Some(Weld::None))), ((columns + 1) * (rows + 1), 1, 1, 1));
}

/// However cubes touch, as eight vertices each, as 24, or as triangles of an STL file, they stay two.
#[test]
fn cubes_that_touch_stay_apart() {
    for (name, shift) in [("corner", DVec3::ONE), ("edge", DVec3::new(1.0, 1.0, 0.0)), ("face", DVec3::X)] {
        let (points, faces) = both(cube(DVec3::ZERO), cube(shift));
        for (how, text) in [
            ("8", obj(&points, &faces, |_, _| 0)),
            ("24", obj(&points, &faces, |f, _| f / 2)),
            ("36", obj(&points, &faces, |f, _| f)),
        ] {
            let surface = read_bytes("a.obj", &text, None);
            assert_eq!(topology(&surface), (16, 4, 0, 2), "{name} {how}: {:?}", surface.repairs);
        }
        for amount in [0.0, 1e-7] {
            let mut random = Random::new(5);
            let surface = read_bytes("a.stl", stl(&points, &faces, || amount * random.vector()), None);
            assert_eq!(topology(&surface), (16, 4, 0, 2), "{name} {amount}: {:?}", surface.repairs);
        }
    }
}

/// Triangles that are no surfaces side by side are refused as before.
#[test]
fn what_is_torn_is_no_surface() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.stl");
    let (mut points, faces) = cube(DVec3::ZERO);
    points.push(DVec3::new(0.0, -1.0, -1.0));
    for (more, part) in
        [([0, 2, 3], "have the same corners"), ([0, 1, 8], "shared by 3 faces"), ([0, 0, 3], "two of them equal")]
    {
        let faces: Triangles = faces.iter().copied().chain([more]).collect();
        fs::write(&path, stl(&points, &faces, || DVec3::ZERO)).expect("a file");
        let error = read(&path).expect_err(part).to_string();
        assert!(error.contains(part) && error.contains("counted from 0"), "{error}");
    }
}

/// Two sheets that lie upon each other are not a surface around nothing.
#[test]
fn sheets_upon_each_other_stay_two() {
    let disk = parts(shapes::disk(1.0, 5).expect("a disk"));
    let mut other = disk.clone();
    other.1.iter_mut().for_each(|face| face.swap(0, 1));
    let (points, faces) = both(disk.clone(), other.clone());
    let surface = read_bytes("a.obj", obj(&points, &faces, |_, _| 0), None);
    assert_eq!(topology(&surface), (points.len(), 2, 2, 2));
    assert!(says(&surface, "30 boundary vertices lie at the place of another one"), "{:?}", surface.repairs);
    assert!(says(&surface, "would lie upon each other"), "{:?}", surface.repairs);
    // Blown up they are one.
    other.0.iter_mut().for_each(|p| p.z += 0.3 * (1.0 - p.length_squared()).max(0.0));
    let (points, faces) = both(disk, other);
    let text = obj(&points, &faces, |_, _| 0);
    let lens = read_bytes("a.obj", &text, Some(Weld::Within(1e-9)));
    assert_eq!(topology(&lens), (points.len() - 30, 2, 0, 1), "{:?}", lens.repairs);
}

/// A strip glued with a half turn would have one side only, and one that meets itself in single vertices has no seam.
#[test]
fn what_would_be_no_surface_is_left() {
    let n = 12;
    let place = |k: u32, side: f64| {
        let a = std::f64::consts::TAU * f64::from(k % n) / f64::from(n);
        let side = if k >= n { -side } else { side };
        let r = 1.0 + 0.3 * side * (0.5 * a).cos();
        DVec3::new(r * a.cos(), r * a.sin(), 0.3 * side * (0.5 * a).sin())
    };
    let points: Vec<DVec3> = (0..=n).flat_map(|k| [place(k, -1.0), place(k, 1.0)]).collect();
    let faces: Triangles =
        (0..n).flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]]).collect();
    let surface = read_bytes("a.obj", obj(&points, &faces, |_, _| 0), None);
    assert_eq!(topology(&surface), (points.len(), 1, 1, 1));
    assert!(says(&surface, "2 boundary vertices lie at the place of another one"), "{:?}", surface.repairs);
    assert!(says(&surface, "the wrong way round"), "{:?}", surface.repairs);
    // Two triangles with a corner in common.
    let points =
        [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 0.], [-1., 0., 0.], [0., -1., 0.]].map(DVec3::from);
    let surface = read_bytes("a.obj", obj(&points, &[[0, 1, 2], [3, 4, 5]], |_, _| 0), None);
    assert_eq!(topology(&surface), (6, 2, 2, 2));
    assert!(says(&surface, "(the first are 1 and 4 of the file, counted from 1)"), "{:?}", surface.repairs);
}

#[test]
fn a_rim_upon_a_closed_surface_is_told() {
    let (points, faces) = both(cube(DVec3::ZERO), (vec![DVec3::ZERO, DVec3::X, -DVec3::Z], vec![[0, 1, 2]]));
    let surface = read_bytes("a.obj", obj(&points, &faces, |_, _| 0), None);
    assert_eq!(topology(&surface), (11, 3, 1, 2));
    assert!(
        says(&surface, "2 boundary vertices lie at the place of one that is not on the boundary"),
        "{:?}",
        surface.repairs
    );
    assert!(says(&surface, "(the first are 9 and 1 of the file"), "{:?}", surface.repairs);
}

/// A slit is a seam like any other, which is said, and kept on demand.
#[test]
fn a_slit_disk() {
    let (points, faces) = parts(shapes::disk(1.0, 6).expect("a disk"));
    let on_slit = |v: u32| points[v as usize].y.abs() < 1e-12 && points[v as usize].x > 0.01;
    let above = |f: usize| faces[f].iter().map(|&v| points[v as usize].y).sum::<f64>() > 0.0;
    let text = obj(&points, &faces, |f, v| usize::from(on_slit(v) && above(f)));
    let welded = read_bytes("a.obj", &text, None);
    assert_eq!(topology(&welded), (points.len(), 1, 1, 1));
    assert!(says(&welded, "welded 6 pairs") && says(&welded, "to keep the seam open"), "{:?}", welded.repairs);
    let kept = read_bytes("a.obj", &text, Some(Weld::None));
    assert_eq!(topology(&kept), (points.len() + 6, 1, 1, 1));
}

#[test]
fn lengths_of_both_sides_of_a_seam() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let (points, faces) = cube(DVec3::ZERO);
    fs::write(at.join("a.obj"), obj(&points, &faces, |f, _| f / 2)).expect("a file");
    let raw = read_welded(&at.join("a.obj"), Some(Weld::None)).expect("squares").mesh;
    let mesh = read(&at.join("a.obj")).expect("a cube").mesh;
    let lines: Vec<String> = raw.edges().map(|e| raw.file_ends(e)).map(|[a, b]| format!("{a},{b},1\n")).collect();
    let table = |lines: &[String]| {
        fs::write(at.join("l.csv"), lines.concat()).expect("a file");
        read_edge_lengths(&at.join("l.csv"), &mesh)
    };
    assert_eq!(table(&lines).expect("lengths"), vec![1.0; 18]);
    let k = (0..raw.edge_count()).rfind(|&e| raw.is_boundary_edge(immerse::mesh::EdgeId::new(e))).expect("a seam");
    let mut other = lines.clone();
    other[k] = other[k].replace(",1\n", ",2\n");
    let error = table(&other).expect_err("a contradiction").to_string();
    assert!(
        error.contains(&format!("l.csv:{}: edge ", k + 1)) && error.contains("has length 2 here and 1 on"),
        "{error}"
    );
}

#[test]
fn the_key_of_a_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let at: &Path = folder.path();
    let (points, faces) = cube(DVec3::ZERO);
    fs::write(at.join("a.obj"), obj(&points, &faces, |f, _| f / 2)).expect("a file");
    fs::write(at.join("flat.obj"), "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").expect("a file");
    let check = |text: &str| {
        fs::write(at.join("film.toml"), text).expect("a scene");
        let (code, out, err) = program(at, &["check", "film.toml"]);
        (code, out + &err)
    };
    for (weld, faces) in [
        ("", "genus 0, 0 boundary loops, 1 comp"),
        ("weld = 'none'", "6 components"),
        ("weld = 0.001", "8 vertices"),
        ("weld = 'exact'", "8 vertices"),
    ] {
        let (code, text) = check(&format!("[mesh]\nfile = 'a.obj'\n{weld}\n"));
        assert!(code == 0 && text.contains(faces), "{weld}: {text}");
    }
    let (code, text) = check("[mesh]\nfile = 'flat.obj'\nweld = 'exact'\n[metric]\nlength = 1\n");
    assert!(code == 0 && text.contains("nothing was welded, because the file has no positions"), "{text}");
    for (text, part) in [
        ("file = 'a.obj'\nweld = 'exakt'", "did you mean `exact`?"),
        ("file = 'a.obj'\nweld = -1", "`weld` is -1, it must be one of the strings exact, none or a number at least 0"),
        ("file = 'a.obj'\nweld = true", "`weld` is true"),
        ("shape = 'sphere'\nweld = 'none'", "this is a generated shape"),
    ] {
        let (code, said) = check(&format!("[mesh]\n{text}\n"));
        let said = said.replace("\n  | ", " ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(code == 2 && said.contains(part), "{text}: {said}");
    }
}
