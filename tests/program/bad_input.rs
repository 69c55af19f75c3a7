//! Inputs that are at fault: exit code 2, the place, the reason, a remedy, and nothing written.

use std::fs;
use std::path::Path;

use crate::support::program;

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// As above without positions.
const INTRINSIC: &str = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Writes the files, and a scene of this text, and runs it.
#[track_caller]
fn refuse(files: &[(&str, &str)], scene: &str, parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    refuse_in(folder.path(), scene, parts);
}

#[track_caller]
fn refuse_in(folder: &Path, scene: &str, parts: &[&str]) {
    fs::write(folder.join("film.toml"), scene).unwrap();
    let before = fs::read_dir(folder).unwrap().count();
    for arguments in [
        &["check", "film.toml"][..],
        &["run", "film.toml", "--out", "out"],
        &["simulate", "film.toml", "--out", "out", "--restart"],
    ] {
        let (code, out, err) = program(folder, arguments);
        assert_eq!((code, out.as_str()), (2, ""), "{arguments:?}: {err}");
        for part in ["film.toml", "help: "].iter().chain(parts) {
            assert!(unwrapped(&err).contains(part), "{arguments:?}: no `{part}` in\n{err}");
        }
        assert_eq!(fs::read_dir(folder).unwrap().count(), before, "{arguments:?} wrote something");
    }
}

/// Long lines are wrapped for people.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace("| ", "")
}

const FILE: &str = "[mesh]\nfile = 'mesh.obj'\n";

#[test]
fn missing_mesh_file() {
    refuse(&[], FILE, &["film.toml:2:8", "mesh.obj: cannot be read", "check the path"]);
}

#[test]
fn unknown_format() {
    refuse(
        &[("mesh.3ds", "x")],
        "[mesh]\nfile = 'mesh.3ds'",
        &["film.toml:2:8", "no mesh format that can be read", "`obj`, `ply`"],
    );
}

#[test]
fn malformed_mesh() {
    refuse(&[("mesh.obj", "v 0 0 0\nv 1 zero 0\n")], FILE, &["mesh.obj:2", "`zero` is not a number", "write a number"]);
    let too_far = TETRAHEDRON.replace("f 3 1 4", "f 3 1 9");
    refuse(&[("mesh.obj", &too_far)], FILE, &["mesh.obj:8", "9"]);
}

#[test]
fn empty_mesh() {
    refuse(&[("mesh.obj", "v 0 0 0\n")], FILE, &["mesh.obj", "the mesh has no faces", "give at least one triangle"]);
    refuse(&[("mesh.obj", "")], FILE, &["mesh.obj", "no"]);
}

#[test]
fn duplicate_faces() {
    let twice = format!("{TETRAHEDRON}f 2 1 3\n");
    refuse(&[("mesh.obj", &twice)], FILE, &["mesh.obj", "have the same corners", "lines 5, 9", "help: remove one of"]);
}

#[test]
fn not_a_number_in_a_mesh() {
    let broken = TETRAHEDRON.replace("v 0 1 0", "v 0 NaN 0");
    refuse(&[("mesh.obj", &broken)], FILE, &["mesh.obj:3", "`NaN` is not finite"]);
}

#[test]
fn a_billion_claimed_vertices() {
    let header = "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
    let parts = ["mesh.ply:3", "1000000000 of element `vertex` are claimed", "correct the header's counts"];
    refuse(&[("mesh.ply", header)], "[mesh]\nfile = 'mesh.ply'", &parts);
}

/// A strip of quadrilaterals, glued with a half turn.
fn moebius_band() -> String {
    let n = 6;
    let mut text = String::new();
    for k in 0..n {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (0.5 * angle).cos();
            text += &format!("v {} {} {}\n", r * angle.cos(), r * angle.sin(), side * (0.5 * angle).sin());
        }
    }
    for k in 0..n {
        let (a, b) = (2 * k + 1, 2 * k + 2);
        let (c, d) = if k + 1 < n { (2 * k + 3, 2 * k + 4) } else { (2, 1) };
        text += &format!("f {a} {c} {d}\nf {a} {d} {b}\n");
    }
    text
}

#[test]
fn moebius() {
    refuse(&[("mesh.obj", &moebius_band())], FILE, &["mesh.obj", "is not orientable", "use an orientable surface"]);
}

#[test]
fn klein_bottle() {
    // A grid with both pairs of sides glued, one of them in reverse.
    let (n, m) = (6, 5);
    let vertex = |i: i32, j: i32| {
        let (i, j) = if i == n { (0, (m - j).rem_euclid(m)) } else { (i, j.rem_euclid(m)) };
        i * m + j + 1
    };
    let mut text = String::new();
    for i in 0..n {
        for j in 0..m {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    let scene = format!("{FILE}[metric]\nlength = 1\n");
    refuse(&[("mesh.obj", &text)], &scene, &["mesh.obj", "is not orientable", "use an orientable surface"]);
}

/// The six edges of a tetrahedron, one of them with another length.
fn lengths(of_01: &str) -> String {
    format!("u,v,length\n0,1,{of_01}\n0,2,1\n0,3,1\n1,2,1\n1,3,1\n2,3,1\n")
}

const FROM_CSV: &str = "[mesh]\nfile = 'mesh.obj'\n[metric]\ncsv = 'lengths.csv'\n";

#[test]
fn triangle_inequality() {
    let files = [("mesh.obj", INTRINSIC), ("lengths.csv", &lengths("2.5"))];
    refuse(
        &files,
        FROM_CSV,
        &["film.toml:3:1", "the triangle inequality fails in 2 faces", "2.5", "correct these lengths"],
    );
    // Equality is no triangle either.
    refuse(&[files[0], ("lengths.csv", &lengths("2"))], FROM_CSV, &["triangle inequality"]);
}

#[test]
fn lengths_that_are_none() {
    for (length, reason) in
        [("NaN", "is not finite"), ("0", "is not positive"), ("-1", "is not positive"), ("inf", "is not finite")]
    {
        let files = [("mesh.obj", INTRINSIC), ("lengths.csv", &lengths(length))];
        refuse(&files, FROM_CSV, &["lengths.csv:2", reason]);
    }
    let incomplete = lengths("1").replace("2,3,1\n", "");
    let parts = ["lengths.csv", "1 of 6 edges have no length, the first is 2,3", "help: give every edge"];
    refuse(&[("mesh.obj", INTRINSIC), ("lengths.csv", &incomplete)], FROM_CSV, &parts);
    refuse(&[("mesh.obj", INTRINSIC)], FROM_CSV, &["lengths.csv: cannot be read", "check the path"]);
    refuse(&[("mesh.obj", INTRINSIC)], FILE, &["the mesh has no positions to take lengths from", "add `length = "]);
    let on_top = TETRAHEDRON.replace("v 1 0 0", "v 0 0 0");
    refuse(&[("mesh.obj", &on_top)], FILE, &["edge", "has length 0", "every length must be positive"]);
    refuse(&[], "[metric]\nlength = nan\n", &["film.toml:2:10", "length"]);
    refuse(&[], "[metric]\nlength = 0.0\n", &["film.toml:2:10", "length"]);
}

#[test]
fn formulas() {
    let with = |formula: &str| format!("[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[metric]\nformula = '{formula}'\n");
    refuse(
        &[],
        &with("length * w"),
        &["film.toml:5:11", "formula `length * w`", "there is no `w`", "it may use x, y, z"],
    );
    refuse(&[], &with("length * "), &["formula `length *`"]);
    refuse(&[], &with("length * (0/0)"), &["NaN", "every length must be positive and finite"]);
    refuse(&[], &with("length * ln(z - 9)"), &["NaN", "every length must be positive and finite"]);
    refuse(&[], &with("length - length"), &["has length 0", "every length must be positive and finite"]);
    let flat = "[mesh]\nshape = 'flat_torus'\ncolumns = 6\nrows = 6\n[metric]\nformula = 'length * x'\n";
    refuse(&[], flat, &["film.toml:6:11", "uses coordinates, but the mesh has no positions"]);
}

#[test]
fn classes() {
    let torus = "[mesh]\nshape = 'torus'\ncolumns = 12\nrows = 6\n[spin]\nclass = ";
    let place = "film.toml:6:9";
    refuse(&[], &format!("{torus}'011'"), &[place, "has 3 digits", "2 generators", "write one digit 0 or 1"]);
    refuse(&[], &format!("{torus}''"), &[place, "has 0 digits"]);
    refuse(&[], &format!("{torus}'0x'"), &[place, "one digit 0 or 1"]);
    let sphere = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n[spin]\nclass = '0'";
    refuse(&[], sphere, &["film.toml:5:9", "0 generators", "leave `class` out"]);
    let flat = "[mesh]\nshape = 'flat_torus'\ncolumns = 6\nrows = 6\n[spin]\nclass = 'immersion'";
    refuse(&[], flat, &["film.toml:6:9", "needs vertex positions", "write the digits"]);
}

#[test]
fn what_wants_positions() {
    let flat = "[mesh]\nshape = 'flat_torus'\ncolumns = 6\nrows = 6\n";
    for from in ["mesh", "mirror"] {
        let start = format!("{flat}[start]\nfrom = '{from}'\n");
        refuse(&[], &start, &["film.toml:6:8", "the mesh has none", "write `random = 0`"]);
        let bending = format!("{flat}[bending]\nfrom = '{from}'\n");
        refuse(&[], &bending, &["film.toml:6:8", "bending angles", "the mesh has none", "a `file`"]);
    }
    refuse(&[], &format!("{flat}[[pin]]\nvertices = [0]\n"), &["film.toml:5:1", "add `positions`"]);
}

#[test]
fn pins() {
    let sphere = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n";
    refuse(
        &[],
        &format!("{sphere}[[pin]]\nvertices = [42]\n"),
        &["film.toml:4:1", "there is no vertex 42", "42 vertices", "below 42"],
    );
    let twice = "[[pin]]\nvertices = [3]\npositions = [[0, 0, 0]]\n[[pin]]\nvertices = [3]\n";
    refuse(&[], &format!("{sphere}{twice}"), &["vertex 3 is pinned to", "keep one of the two"]);
    let uneven = "[[pin]]\nvertices = [3, 4]\npositions = [[0, 0, 0]]\n";
    refuse(&[], &format!("{sphere}{uneven}"), &["1 positions for 2 vertices", "give one"]);
}

const SPHERE: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n";
const TORUS: &str = "[mesh]\nshape = 'torus'\ncolumns = 8\nrows = 6\n";
/// Times 0, 0.5 and 1.
const CLOCK: &str = "[clock]\nframes = 3\n";

#[test]
fn meshes_of_other_connectivity() {
    let turned = TETRAHEDRON.replace("f 3 1 4", "f 1 4 3");
    let smaller = TETRAHEDRON.replace("f 3 1 4\n", "");
    let scenes = [
        ("[[metric.key]]\ntime = 0\n[[metric.key]]\ntime = 1\nfile = 'other.obj'\n", "film.toml:7:8"),
        ("[metric]\nfile = 'other.obj'\n", "film.toml:4:8"),
        ("[start]\nfile = 'other.obj'\n", "film.toml:4:8"),
        ("[bending]\nfile = 'other.obj'\n", "film.toml:4:8"),
    ];
    for (scene, place) in scenes {
        let scene = format!("{FILE}{scene}");
        let help = "help: use a mesh with the same faces in the same order";
        for (other, reason) in [
            (&turned, "other.obj: face 3 has vertices [0, 3, 2], in the mesh of the scene [2, 0, 3]"),
            (&smaller, "other.obj: it has 3 faces, the mesh of the scene has 4"),
        ] {
            refuse(&[("mesh.obj", TETRAHEDRON), ("other.obj", other)], &scene, &[place, reason, help]);
        }
        let files = [("mesh.obj", TETRAHEDRON), ("other.obj", INTRINSIC)];
        refuse(&files, &scene, &[place, "other.obj: it has no positions", "help: use a file that has them"]);
        refuse(&[("mesh.obj", TETRAHEDRON)], &scene, &[place, "other.obj: cannot be read", "check the path"]);
    }
}

/// What goes wrong at a time is found before anything is computed.
#[track_caller]
fn refuse_at_half_time(scene: &str, parts: &[&str]) {
    refuse_check(&format!("{scene}{CLOCK}"), &[parts, &["at time 0.5"]].concat());
    // Two frames are at the ends, where nothing is wrong.
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("film.toml"), format!("{scene}[clock]\nframes = 2\nend = 0.25\n")).unwrap();
    let (code, _, err) = program(folder.path(), &["check", "film.toml"]);
    assert_eq!(code, 0, "{err}");
}

/// Refused by `check`.
#[track_caller]
fn refuse_check(scene: &str, parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("film.toml"), scene).unwrap();
    let (code, out, err) = program(folder.path(), &["check", "film.toml"]);
    assert_eq!((code, out.as_str()), (2, ""), "{err}");
    for part in ["film.toml", "help: "].iter().chain(parts) {
        assert!(unwrapped(&err).contains(part), "no `{part}` in\n{err}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn lengths_that_are_none_at_a_time() {
    let metric = |text: &str| format!("{SPHERE}[metric]\n{text}\n");
    let formula = |text: &str| metric(&format!("formula = '{text}'"));
    let place = "film.toml:4:1";
    refuse_at_half_time(&formula("length * (0.5 - t)"), &[place, "edge 0 between vertices [", "has length 0"]);
    refuse_at_half_time(&formula("length * (0.4 - t)"), &[place, "edge 0 between vertices [", "has length -0."]);
    refuse_at_half_time(&formula("length * sqrt(0.4 - t)"), &[place, "edge 0 between", "has length NaN"]);
    refuse_at_half_time(&formula("length / (0.5 - t)"), &[place, "edge 0 between", "has length inf"]);
    // What grows with the square of a difference gets too long for two halves.
    refuse_at_half_time(
        &formula("length + 400*t^4*dz^2"),
        &[place, "the triangle inequality fails in", "worst in face"],
    );
    refuse_at_half_time(&metric("positions = ['x', 'y / (0.5 - t)', 'z']"), &[place, "edge", "every length must be"]);
    let change = |text: &str| format!("{SPHERE}[[metric.change]]\nkind = 'conformal'\n{text}\n");
    refuse_at_half_time(&change("log_scale = '1 / (0.5 - t)'"), &[place, "log scale factor of vertex 0 is inf"]);
    refuse_at_half_time(&change("log_scale = 'z'\namount = 'ln(0.4 - t)'"), &[place, "is NaN", "correct the formula"]);
    refuse_at_half_time(&change("log_scale = '400*t^5*x'"), &[place, "the triangle inequality fails in", "face"]);
    let ricci = format!("{TORUS}[[metric.change]]\nkind = 'ricci'\namount = 'sqrt(0.4 - t)'\n");
    refuse_at_half_time(&ricci, &["film.toml:5:1", "not at NaN", "or the amount"]);
    let amount = format!("{SPHERE}[bending]\nfrom = 'mesh'\namount = '1 / (0.5 - t)'\n");
    refuse_at_half_time(&amount, &["film.toml:6:10", "it is inf", "it must be finite there"]);
    let angle =
        "[[bending.region]]\nvertices = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13]\nangle = 'ln(0.4 - t)'\n";
    refuse_at_half_time(&format!("{SPHERE}{angle}"), &["film.toml:6:9", "it is NaN"]);
}

#[test]
fn curvature_that_cannot_be() {
    let ricci = |shape: &str, rest: &str| format!("{shape}[[metric.change]]\nkind = 'ricci'\n{rest}");
    let place = "break Gauss-Bonnet";
    refuse(&[], &ricci(TORUS, "curvature = 1\n"), &["film.toml:5:1", place, "spread the difference"]);
    refuse(&[], &ricci(SPHERE, "curvature = -1\n"), &["film.toml:4:1", place]);
    let region = |vertices: &str, total: f64| format!("[[metric.change.region]]\n{vertices}\ntotal = {total}\n");
    let all = region("ball = [0, 0, 0, 2]", 700.0);
    refuse(&[], &ricci(SPHERE, &all), &["film.toml:4:1", place, "instead of 2 pi chi = 12.56"]);
    for total in [360.0, 400.0] {
        let one = region("vertices = [3]", total);
        let parts = ["film.toml:6:1", "region 0", "degrees are too many for 1 vertices", "less than 360 degrees"];
        refuse(&[], &ricci(SPHERE, &one), &parts);
    }
    let nothing = region("ball = [0, 0, 9, 1]", 90.0);
    refuse(&[], &ricci(SPHERE, &nothing), &["film.toml:6:1", "nothing is selected", "choose a larger region"]);
    let disk = "[mesh]\nshape = 'disk'\nrings = 3\n";
    let rim = region("boundary = [0]", 90.0);
    refuse(&[], &ricci(disk, &rim), &["film.toml:6:1", "region 0", "no interior vertices"]);
    refuse(&[], &ricci(disk, "turning = 9000\n"), &["film.toml:4:1", "target curvature of vertex", "below 3.14"]);
}

#[test]
fn pins_at_a_time() {
    let pin = |rest: &str| format!("[[pin]]\nvertices = [3]\n{rest}\n");
    let apart = format!("{SPHERE}{}{}", pin(""), pin("formula = ['x', 'y + max(0, t - 0.3)', 'z']"));
    refuse_at_half_time(&apart, &["film.toml:7:1", "vertex 3 is pinned to", "keep one of the two"]);
    let lost = format!("{SPHERE}{}", pin("formula = ['x', 'y', 'z + sqrt(0.4 - t)']"));
    refuse_at_half_time(&lost, &["film.toml:4:1", "vertex 3 is led to", "NaN", "correct the formula"]);
    for (selection, reason) in [
        ("ball = [0, 0, 9, 1]", "nothing is selected"),
        ("box = [[2, 2, 2], [3, 3, 3]]", "nothing is selected"),
        ("boundary = [0]", "there is no boundary loop 0, the mesh has 0"),
        ("nearest = []", "`nearest` is empty"),
    ] {
        refuse(&[], &format!("{SPHERE}[[pin]]\n{selection}\n"), &[reason]);
    }
    let name = pin("formula = ['x', 'y', 'z * speed']");
    refuse(&[], &format!("{SPHERE}{name}"), &["film.toml:4:1", "there is no `speed`", "it may use x, y, z, t"]);
}

#[test]
fn bending_on_the_boundary() {
    let disk = "[mesh]\nshape = 'disk'\nrings = 2\n[[bending.region]]\nangle = 10\n";
    // Of two rings the outer one is 7, 8, … 18.
    let rim = format!("{disk}edges = [[7, 8]]\n");
    refuse(&[], &rim, &["film.toml:4:1", "the edge [7, 8] is on the boundary, where nothing bends", "leave it out"]);
    refuse(&[], &format!("{disk}edges = [[1, 1]]\n"), &["there is no edge between vertices [1, 1]", "two neighbours"]);
    refuse(&[], &format!("{disk}boundary = [0]\n"), &["film.toml:4:1", "nothing is selected"]);
}

#[test]
fn parameters() {
    let with = |parameters: &str, amount: &str| {
        format!("{SPHERE}[parameters]\n{parameters}\n[bending]\nfrom = 'mesh'\namount = {amount}\n")
    };
    refuse(
        &[],
        &with("speed = 1", "'sped * t'"),
        &["film.toml:8:10", "there is no `sped`", "it may use t, speed and the usual functions"],
    );
    refuse(&[], &with("b = '2 * a'\na = 1", "'b'"), &["film.toml:5:5", "there is no `a`"]);
    for name in ["t", "x", "length", "PI", "TAU", "sin", "e"] {
        let parts = ["film.toml:5:", "cannot name a parameter", "help: choose another name"];
        refuse(&[], &with(&format!("{name} = 1"), "1"), &parts);
    }
    refuse(&[], &with("\"two words\" = 1", "1"), &["cannot name a parameter"]);
}

#[test]
fn more_frames_than_classes() {
    let all = "[spin]\nclass = 'all'\n[clock]\nframes = ";
    let place = "film.toml:8:10";
    refuse(&[], &format!("{TORUS}{all}5\n"), &[place, "5 frames for the classes of 2 generators", "lower `frames`"]);
    refuse(&[], &format!("{SPHERE}{all}2\n"), &["film.toml:7:10", "2 frames for the classes of 0 generators"]);
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("film.toml"), format!("{TORUS}{all}4\n")).unwrap();
    assert_eq!(program(folder.path(), &["check", "film.toml"]).0, 0);
}

#[test]
fn unknown_keys() {
    refuse(
        &[],
        "[mesh]\nshap = 'sphere'\n",
        &["film.toml:2:1", "there is no `shap` in [mesh]", "did you mean `shape`?"],
    );
}

/// One triangle is a surface like any other, and comes out as that triangle.
#[test]
fn one_triangle() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mesh.obj"), "f 1 2 3\n").unwrap();
    fs::write(folder.path().join("lengths.csv"), "0,1,3\n1,2,4\n2,0,5\n").unwrap();
    let checks = "[output]\nsize = [32, 24]\nsamples = 1\n[checks]\nmax_l2_length_error = 1e-14\nmax_rims = 0\n";
    fs::write(folder.path().join("film.toml"), format!("{FROM_CSV}{checks}")).unwrap();
    let (code, out, err) = program(folder.path(), &["run", "film.toml", "--out", "out"]);
    assert_eq!(code, 0, "{out}{err}");
    let cache = immerse::film::FilmFolder::open(&folder.path().join("out")).unwrap();
    let p = cache.read_frame(1).unwrap().positions;
    assert!(((p[1] - p[0]).length() - 3.0).abs() < 1e-14 && ((p[2] - p[1]).length() - 4.0).abs() < 1e-14);
    assert!((p[1] - p[0]).dot(p[2] - p[1]).abs() < 1e-13);
    assert!(folder.path().join("out/000001.png").exists());
}
