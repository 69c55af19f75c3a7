//! What the page on files says of NumPy: its blocks of Python are run on films, and what it says of arrays is measured.
//!
//! It takes Python with NumPy; `IMMERSE_PYTHON` names one, else it is `python3`.

use std::fs;
use std::path::Path;
use std::process::Command;

fn python() -> String {
    std::env::var("IMMERSE_PYTHON").unwrap_or_else(|_| "python3".into())
}

/// Whether there is a Python with NumPy; says loudly if there is none.
pub fn has_numpy(what: &str) -> bool {
    let python = python();
    let has = Command::new(&python).args(["-c", "import numpy"]).output();
    if has.is_ok_and(|output| output.status.success()) {
        return true;
    }
    // Written to standard error itself, which the test harness does not keep back.
    use std::io::Write;
    let _ = writeln!(
        std::io::stderr(),
        "SKIPPED: {what}, because `{python}` has no NumPy; `pip install numpy`, or name another Python by IMMERSE_PYTHON"
    );
    assert!(std::env::var("IMMERSE_PYTHON").is_err(), "IMMERSE_PYTHON was named, and has no NumPy");
    false
}

/// Runs a script in a folder with the built program in the path, and returns what it prints.
#[track_caller]
pub fn run_python(folder: &Path, script: &str) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_immerse"));
    let mut path = vec![program.parent().expect("a folder").to_owned()];
    path.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()));
    let output = Command::new(python())
        .args(["-c", script])
        .current_dir(folder)
        .env("PATH", std::env::join_paths(path).expect("paths"))
        .output()
        .expect("Python");
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{script}\n{out}\n{err}");
    out
}

/// The blocks of Python of a page.
pub fn blocks(page: &str) -> Vec<String> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).expect("a page");
    let parts = text.split("```python\n").skip(1);
    parts.map(|part| part.split("```").next().unwrap_or_default().to_owned()).collect()
}

/// The number that stands behind a word.
#[track_caller]
pub fn number_after(text: &str, words: &str) -> f64 {
    let rest = text.split_once(words).unwrap_or_else(|| panic!("no `{words}` in {text}")).1;
    rest.split_whitespace().next().and_then(|word| word.parse().ok()).unwrap_or_else(|| panic!("no number in {rest}"))
}

#[track_caller]
fn immerse(folder: &Path, arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_immerse"))
        .args(["--quiet"])
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

const SCENE: &str = "[mesh]\nshape = 'torus'\ncolumns = 18\nrows = 8\n[metric]\nformula = 'length * (1 + 0.1 * z)'\n\
    [start]\nfrom = 'mesh'\n[[phase]]\nlike = 'default'\nmax_steps = 20\n";

/// Of every array of the page: its shape and type, and that orientations are what is said of them.
const ARRAYS: &str = r#"
import re, numpy
mesh = numpy.load("renders/hare/mesh.npz")
frame = numpy.load("renders/hare/frames/000001.npz")
t, edges = mesh["triangles"], mesh["edges"]
halfedges = numpy.stack([t, numpy.roll(t, -1, axis=1)], axis=2).reshape(-1, 2)
# In order of their halfedges of smaller index, in whose direction they run.
first = {}
for u, v in halfedges.tolist():
    first.setdefault((min(u, v), max(u, v)), (u, v))
assert list(first.values()) == [tuple(edge) for edge in edges.tolist()]
sizes = {"|V|": len(frame["positions"]), "|E|": len(edges), "|F|": len(t)}
listed = 0
for line in open(PAGE, encoding="utf-8"):
    row = re.match(r"\| `(\w+)` \| (.*?) \| `(.*?)` \|", line.replace("\\|", "|"))
    if row:
        name, shape, dtype = row.groups()
        source = mesh if name in mesh.files else frame
        if name == "lattice":
            continue
        words = [] if shape == "scalar" else [word.strip() for word in shape.split("×")]
        expected = tuple(sizes.get(word) or int(word) for word in words)
        assert source[name].shape == expected, (name, source[name].shape, expected)
        assert source[name].dtype == numpy.dtype(dtype.replace("\\", "")), (name, source[name].dtype, dtype)
        listed += 1
assert listed == len(mesh.files) + len(frame.files), (listed, mesh.files, frame.files)
q = frame["face_frames"]
def product(a, b):
    aw, bw, av, bv = a[:, :1], b[:, :1], a[:, 1:], b[:, 1:]
    w = aw * bw - (av * bv).sum(axis=1, keepdims=True)
    return numpy.concatenate([w, aw * bv + bw * av + numpy.cross(av, bv)], axis=1)
def rotated(axis):
    unit = numpy.zeros_like(q)
    unit[:, axis] = 1
    return product(product(q * [1, -1, -1, -1], unit), q)[:, 1:]
p = frame["positions"][t]
normal = numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
normal /= numpy.linalg.norm(normal, axis=1, keepdims=True)
along = p[:, 1] - p[:, 0]
along /= numpy.linalg.norm(along, axis=1, keepdims=True)
cosines = [(rotated(1) * normal).sum(axis=1), (rotated(2) * along).sum(axis=1)]
assert all(numpy.median(c) > 0.99 for c in cosines), [numpy.median(c) for c in cosines]
# Frames of neighbours differ little once one is carried to the other.
sides = {}
for h, (u, v) in enumerate(halfedges.tolist()):
    sides.setdefault((min(u, v), max(u, v)), []).append(h // 3)
pairs = numpy.array(list(sides.values()))
tau = numpy.zeros((len(edges), 4))
tau[:, :2] = frame["transport"]
carried = product(tau, q[pairs[:, 0]])
assert numpy.median((carried * q[pairs[:, 1]]).sum(axis=1)) > 0.9
assert numpy.median(abs(numpy.linalg.norm(frame["transport"], axis=1) - 1)) < 1e-12
print("listed", listed)
"#;

#[test]
fn the_page_on_files_says_what_is_in_them() {
    if !has_numpy("arrays were not read with NumPy") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("hare.toml"), SCENE).expect("a scene");
    immerse(folder.path(), &["simulate", "hare.toml"]);
    let report = fs::read_to_string(folder.path().join("renders/hare/frames/000001.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let read = &blocks("docs/files.md")[0];
    let said = run_python(folder.path(), read);
    let expected = report["report"]["l2_length_error"].as_f64().expect("a number");
    let found = number_after(&said, "L2 length error");
    assert!(expected > 1e-6 && (found / expected - 1.0).abs() < 1e-6, "{found}, the report has {expected}");
    assert!(read.lines().count() <= 10, "ten lines are promised");
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/files.md");
    let said = run_python(folder.path(), &format!("PAGE = r'{}'\n{ARRAYS}", page.display()));
    assert!(number_after(&said, "listed") > 10.0);
}

/// Faces and lengths go in, positions come out that have these lengths.
#[test]
fn the_example_of_nothing_but_lengths_finds_the_cone() {
    if !has_numpy("the purely intrinsic example was not run") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let page = blocks("docs/files.md");
    let example = page.iter().find(|block| block.contains("halfedge_lengths=lengths")).expect("an example");
    let said = run_python(folder.path(), example);
    let error = number_after(&said, "L2 length error");
    assert!(error < 1e-3, "{error}");
    // Its rings are circles as large as the cone says: 300 degrees of a disk.
    let circle = "import numpy\nframe = numpy.load('renders/cone/frames/000001.npz')\n\
        rim = frame['positions'][-30:]\n\
        size = numpy.linalg.norm(rim - rim.mean(axis=0), axis=1)\nprint('radius', size.mean(), 'spread', size.std())\n";
    let said = run_python(folder.path(), circle);
    let (radius, spread) = (number_after(&said, "radius"), number_after(&said, "spread"));
    assert!((radius - 300.0 / 360.0).abs() < 0.01 && spread < 0.02, "{said}");
}

/// Whatever NumPy writes of the same arrays is the same film, and a film is gone on with from its own arrays.
#[test]
fn arrays_that_numpy_writes_are_read_as_they_are() {
    if !has_numpy("arrays that NumPy writes were not read") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let write = r#"
import numpy
F = numpy.array([[0,2,4],[2,1,4],[1,3,4],[3,0,4],[2,0,5],[1,2,5],[3,1,5],[0,3,5]])
V = numpy.array([[1,0,0],[-1,0,0],[0,1.25,0],[0,-1.25,0],[0,0,1.5],[0,0,-1.5]])
u, v = F, numpy.roll(F, -1, axis=1)
H = numpy.linalg.norm(V[u] - V[v], axis=2)
numpy.savez("a.npz", faces=F, positions=V)
numpy.savez_compressed("b.npz", F=numpy.asfortranarray(F.astype(">i2")), V=numpy.asfortranarray(V.astype(">f4")))
numpy.savez("c.npz", triangles=F.astype("u1"), halfedge_lengths=H)
rows = numpy.stack([u, v, H], axis=2).reshape(-1, 3)
numpy.savez_compressed("d.npz", faces=F.astype(numpy.uint64), edge_lengths=rows[rows[:, 0] < rows[:, 1]].astype("f4"))
numpy.savez("e.npz", faces=F, lengths=H, normals=V)
"#;
    run_python(folder.path(), write);
    for name in ["a", "b", "c", "d", "e"] {
        let scene = format!("[mesh]\nfile = '{name}.npz'\n[[phase]]\nlike = 'default'\nmax_steps = 5\n");
        fs::write(folder.path().join(format!("{name}.toml")), scene).expect("a scene");
        immerse(folder.path(), &["simulate", &format!("{name}.toml")]);
    }
    let on = "[mesh]\nfile = 'renders/a/mesh.npz'\n[metric]\nfile = 'changed.npz'\n\
        [start]\nfile = 'renders/a/frames/000001.npz'\n[[phase]]\nlike = 'default'\nmax_steps = 5\n";
    fs::write(folder.path().join("on.toml"), on).expect("a scene");
    let change = "import numpy\nframe = dict(numpy.load('renders/a/frames/000001.npz'))\n\
        frame['edge_lengths'] *= 1.25\nnumpy.savez('changed.npz', **frame)\n";
    run_python(folder.path(), change);
    immerse(folder.path(), &["simulate", "on.toml"]);
    let compare = r#"
import numpy
load = lambda name: numpy.load(f"renders/{name}/frames/000001.npz")["edge_lengths"]
for name in "bcde":
    assert numpy.array_equal(numpy.load("renders/a/mesh.npz")["edges"], numpy.load(f"renders/{name}/mesh.npz")["edges"])
    assert numpy.allclose(load(name), load("a"), rtol=1e-6), name
assert numpy.array_equal(load("on"), 1.25 * load("a"))
print("the same")
"#;
    assert!(run_python(folder.path(), compare).contains("the same"));
}
