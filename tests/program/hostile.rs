//! What nobody means well: every case is answered with exit code 2 and one sentence, in less than a second and 64 MB.
//!
//! The program runs as a child of `sh`, which limits its memory (`ulimit -d`, the bytes that a process may write to) and
//! tells its processor time (`times`), which does not depend on how busy the machine is. A panic, an abort for want of
//! memory or a signal is another code than 2.
#![cfg(unix)]

use crate::support::npy::{compressed, npy, npz, whole};
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::process::Command;

const MOST_KILOBYTES: usize = 64 << 10;
/// Of processor time. Ten thousand tables take 0.15 s to be parsed as TOML, more on processors that others use, too; what does not grow in
/// proportion takes many seconds at these sizes.
const MOST_SECONDS: f64 = 1.0;

/// Runs the program in a folder, and returns its code, what it says and how many seconds it took.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, f64) {
    let limited = format!(
        "ulimit -d {MOST_KILOBYTES}; ulimit -t 10; ulimit -c 0; \"$0\" \"$@\" > /dev/null; code=$?; times; exit $code"
    );
    let output = Command::new("sh")
        .args(["-c", &limited, env!("CARGO_BIN_EXE_immerse"), "--quiet", "--threads", "2"])
        .args(arguments)
        .current_dir(folder)
        .stdin(std::process::Stdio::null())
        .output()
        .expect("a shell");
    // The second line is that of children: 0m0.012s 0m0.003s.
    let times = String::from_utf8_lossy(&output.stdout).into_owned();
    let seconds = |word: &str| {
        let (minutes, seconds) = word.strip_suffix('s')?.split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.replace(',', ".").parse::<f64>().ok()?)
    };
    let taken = times.lines().nth(1).expect("times of children").split_whitespace().filter_map(seconds);
    let taken: Vec<f64> = taken.collect();
    assert_eq!(taken.len(), 2, "{times}");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned(), taken.iter().sum())
}

/// One mistake, named by these words, and nothing left behind.
#[track_caller]
fn refused(name: &str, folder: &Path, arguments: &[&str], words: &[&str]) {
    let before = fs::read_dir(folder).expect("a folder").count();
    let (code, said, seconds) = run(folder, arguments);
    let unwrapped = said.split_whitespace().collect::<Vec<_>>().join(" ").replace("| ", "");
    let shown = &said[..said.floor_char_boundary(2000.min(said.len()))];
    assert_eq!(code, Some(2), "{name}: {shown}");
    assert!(!said.contains("panicked"), "{name}: {shown}");
    assert!(unwrapped.contains("help: ") || unwrapped.contains("; "), "{name} has no remedy: {shown}");
    for word in words {
        assert!(unwrapped.contains(word), "{name}: no `{word}` in {shown}");
    }
    assert!(seconds < MOST_SECONDS, "{name} takes {seconds} s");
    assert_eq!(fs::read_dir(folder).expect("a folder").count(), before, "{name} wrote something");
}

const BALL: &str = "[mesh]\nshape = 'sphere'\nsubdivisions = 2\n";

/// Scenes by name, with words of the answer.
#[test]
fn scenes() {
    let times = |text: &str, count: usize| text.repeat(count);
    let numbered = |count: usize, line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    let ball = |rest: &str| format!("{BALL}{rest}");
    let hidden = |formula: &str| ball(&format!("[look]\nhide = '{formula}'\n"));
    let implicit = |parts: &str| format!("[mesh]\nshape = 'implicit'\nedge_length = 0.02\n{parts}");
    let part = "[[mesh.parts]]\nsphere = { radius = 1 }\n";
    let film = |rest: &str| ball(&format!("[clock]\nframes = 8\n{rest}"));
    let chain = numbered(2000, &|k| match k {
        0 => "p0 = 't'\n".to_owned(),
        k => format!("p{k} = 'p{} + p{}'\n", k - 1, k / 2),
    });
    let cases: Vec<(&str, String, &[&str])> = vec![
        ("parentheses", hidden(&format!("{}x{}", times("(", 100_000), times(")", 100_000))), &["characters, 5000"]),
        ("terms", hidden(&format!("x{}", times(" + x", 100_000))), &["characters, 5000 are the limit"]),
        ("signs", hidden(&format!("{}x", times("-", 100_000))), &["characters, 5000 are the limit"]),
        ("unclosed", hidden(&times("(", 4999)), &["formula"]),
        ("powers", hidden(&format!("x{}", times("^x", 100_000))), &["characters, 5000 are the limit"]),
        ("chain of parameters", ball(&format!("[parameters]\n{chain}")), &["more than 1000 parameters"]),
        (
            "parameters of t",
            ball(&format!("[parameters]\n{}", numbered(3000, &|k| format!("q{k} = 't'\n")))),
            &["more than 1000 parameters"],
        ),
        ("lists in lists", ball(&format!("a = {}{}", times("[", 100_000), times("]", 100_000))), &["nest"]),
        ("tables in tables", ball(&format!("a = {}1{}", times("{a=", 100_000), times("}", 100_000))), &["nest"]),
        ("dotted key", ball(&format!("a{} = 1", times(".a", 100_000))), &["nest"]),
        ("header", ball(&format!("[a{}]", times(".a", 100_000))), &["nest"]),
        (
            "50 MB of comments",
            ball(&times("#################################################\n", 1_000_000)),
            &["4 MiB"],
        ),
        ("10^7 faces to hide", ball(&format!("[look]\nhide_faces = [{}]", times("1, ", 10_000_000))), &["4 MiB"]),
        ("10^4 unknown keys", ball(&numbered(10_000, &|k| format!("k{k} = 1\n"))), &["there is no", "10000 mistakes"]),
        ("10^4 lines of no TOML", ball(&times("x\n", 10_000)), &["this is not TOML"]),
        ("10^4 wrong phases", ball(&times("[[phase]]\nfoo = 1\n", 10_000)), &["there is no `foo`"]),
        ("a long key", ball(&format!("{} = 1\n", times("k", 100_000))), &["there is no `kkk"]),
        ("a long name", format!("[mesh]\nshape = '{}'", times("s", 100_000)), &["there is no shape"]),
        ("a long class", ball(&format!("[spin]\nclass = '{}'", times("1", 100_000))), &["100000 digits"]),
        ("frames", ball("[clock]\nframes = 1152921504606846976\n"), &["`frames` is"]),
        ("negative frames", ball("[clock]\nframes = -1\n"), &["`frames` is"]),
        ("an endless integer", ball(&format!("[clock]\nframes = {}\n", times("9", 10_000))), &["`frames` is"]),
        ("a large length", ball("[metric]\nlength = 1e154\n"), &["`length` is 1e154"]),
        ("a small length", ball("[metric]\nlength = 1e-154\n"), &["may be from 1e-15 to 1e15"]),
        ("lengths that overflow", ball("[metric]\nformula = 'length * 1e200'\n"), &["may be from 1e-15 to 1e15"]),
        ("lengths that are none", ball("[metric]\nformula = '0/0'\n"), &["has length NaN"]),
        (
            "no lengths at last",
            film("[metric]\nformula = 'length * sqrt(0.5 - t)'\n"),
            &["at time 0.571", "has length NaN"],
        ),
        ("lengths to 0", film("[metric]\nformula = 'length * (1 - t)'\n"), &["at time 1:", "has length 0"]),
        (
            "a tiny strain",
            film("max_strain = 1e-12\n[metric]\nformula = 'length * (1 + t)'\n"),
            &["parts", "max_strain"],
        ),
        (
            "pins that fly off",
            film("[[pin]]\nvertices = [0]\nformula = ['x', 'y', 'z + 1e6*t']\n"),
            &["pinned vertex 0 is led", "1000 are the limit", "more `frames`"],
        ),
        (
            "a pin out of reach",
            ball("[[pin]]\nvertices = [0]\nformula = ['x', 'y', 'z * 1e300']\n"),
            &["vertex 0 is led to"],
        ),
        (
            "a start out of reach",
            film("[start]\nfrom = 'mesh'\nformula = ['1e200*x', 'y', 'z']\n"),
            &["would be moved to", "coordinates must be finite"],
        ),
        ("a far target", ball("[camera]\ntarget = [1e300, 0, 0]\n"), &["is 1e300"]),
        ("a field twice", ball("[output]\nformat = 'exr'\nfields = ['bending_angle', 'bending_angle']\n"), &["twice"]),
        ("a format twice", ball("[output]\nformat = ['png', 'png']\n"), &["twice"]),
        ("a huge picture", ball("[output]\nsize = [2147483648, 2]\n"), &["`size[0]` is"]),
        ("samples", ball("[output]\nsamples = 1152921504606846976\n"), &["`samples` is"]),
        ("a large video", ball("[output]\nanimation = ['mp4']\nsize = [16000, 16000]\n"), &["3840 x 2160"]),
        ("a sheet", ball("[output]\nsheet = 1152921504606846976\n"), &["`sheet` is"]),
        ("stripes", ball("[look.pattern]\nkind = 'stripes'\ncount = 1152921504606846976\n"), &["`count` is"]),
        (
            "sphere",
            "[mesh]\nshape = 'sphere'\nsubdivisions = 1000\n".into(),
            &["20000000 faces, 4000000 are the limit"],
        ),
        ("uv sphere", "[mesh]\nshape = 'uv_sphere'\nmeridians = 10000\nparallels = 10000\n".into(), &["are the limit"]),
        ("torus", "[mesh]\nshape = 'torus'\ncolumns = 10000\nrows = 10000\n".into(), &["are the limit"]),
        ("cylinder", "[mesh]\nshape = 'cylinder'\ncolumns = 10000\nrows = 10000\n".into(), &["are the limit"]),
        ("disk", "[mesh]\nshape = 'disk'\nrings = 1000\n".into(), &["are the limit"]),
        ("hyperbolic disk", "[mesh]\nshape = 'hyperbolic_disk'\nfaces = 1152921504606846976\n".into(), &["`faces` is"]),
        ("polyhedron", "[mesh]\nshape = 'polyhedron'\nname = 'cube'\nsubdivisions = 1000\n".into(), &["are the limit"]),
        (
            "a small sphere",
            "[mesh]\nshape = 'sphere'\nradius = 1e-30\nsubdivisions = 2\n".into(),
            &["may be from 1e-15"],
        ),
        ("a huge blend", implicit(&format!("{part}{part}blend = 1e12\n")), &["are the limit"]),
        ("10^3 solids", implicit(&times(part, 1000)), &["1000 solids", "are the limit"]),
        (
            "groups in groups",
            format!("[mesh]\nshape = 'implicit'\nparts = {}1{}", times("[{group=", 1000), times("}]", 1000)),
            &["nest"],
        ),
        ("fine edges", format!("[mesh]\nshape = 'implicit'\nedge_length = 1e-12\n{part}"), &["are the limit"]),
        (
            "a thousand octaves",
            ball("[start]\nfrom = 'mesh'\nnoise = { amplitude = 1, octaves = 1000 }\n"),
            &["`octaves`"],
        ),
    ];
    assert!(cases.len() > 40);
    for (name, text, words) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("film.toml"), text).expect("a scene");
        refused(name, folder.path(), &["check", "film.toml"], words);
        refused(name, folder.path(), &["run", "film.toml", "--out", "out"], words);
    }
}

/// Mesh files by name, with words of the answer.
#[test]
fn meshes() {
    let ply = |counts: &str| format!("ply\nformat ascii 1.0\n{counts}end_header\n0 0 0\n").into_bytes();
    let vertices =
        |count: &str| format!("element vertex {count}\nproperty float x\nproperty float y\nproperty float z\n");
    let faces = |count: &str| format!("element face {count}\nproperty list uint int vertex_indices\n");
    let mut stl = vec![b' '; 80];
    stl.extend(u32::MAX.to_le_bytes());
    stl.extend([1; 100]);
    let mut list =
        format!("ply\nformat binary_little_endian 1.0\n{}{}end_header\n", vertices("1"), faces("1")).into_bytes();
    list.extend([0; 12]);
    list.extend(0x8000_0000_u32.to_le_bytes());
    let corners = (0..100_000).map(|k| format!(" {}", k % 3 + 1)).collect::<String>();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases: Vec<(&str, &str, Vec<u8>, &[&str])> = vec![
        ("empty", "mesh.obj", Vec::new(), &["empty"]),
        ("gzip", "mesh.obj", b"\x1f\x8b\x08\0\0\0".to_vec(), &["packed by gzip"]),
        ("zip", "mesh.ply", b"PK\x03\x04\x14\0".to_vec(), &["a zip archive"]),
        ("zeros", "mesh.obj", vec![0; 1 << 20], &["mesh.obj"]),
        ("an array of 2^60", "mesh.npy", npy("'<i8'", false, "(1152921504606846976, 3)", &[0; 24]), &["does not fit"]),
        (
            "an array of 2^128",
            "mesh.npy",
            npy("'<i8'", false, &format!("({0}, {0})", u64::MAX), &[0; 24]),
            &["does not fit"],
        ),
        (
            "an endless header",
            "mesh.npy",
            [b"\x93NUMPY\x02\0\xff\xff\xff\x7f".as_slice(), &[b' '; 1000]].concat(),
            &["10000"],
        ),
        (
            "64 MB of zeros in 64 kB",
            "mesh.npz",
            compressed(&[("faces", npy("'|u1'", false, "(21000000, 3)", &vec![0; 63_000_000]))]),
            &["it would take", "numpy.savez"],
        ),
        ("half an archive", "mesh.npz", npz(&[("faces", whole(&[[0, 1, 2]]))])[..80].to_vec(), &["no npz archive"]),
        ("vertex 2^60", "mesh.npz", npz(&[("faces", whole(&[[0, 1, 1 << 60]]))]), &["which is no vertex"]),
        ("vertex 10^9", "mesh.npz", npz(&[("faces", whole(&[[0, 1, 1_000_000_000]]))]), &["without gaps"]),
        (
            "lists in lists of FOLD",
            "mesh.fold",
            "[".repeat(1_000_000).into_bytes(),
            &["mesh.fold:1", "this is not JSON"],
        ),
        ("vertex 10^9 of FOLD", "mesh.fold", b"{\"faces_vertices\": [[0, 1, 1000000000]]}".to_vec(), &["is named"]),
        (
            "a face of 10^5 corners in FOLD",
            "mesh.fold",
            format!(
                "{{\"vertices_coords\": [[0,0],[1,0],[0,1]], \"faces_vertices\": [[0, 1, 2{}]]}}",
                ", 0, 1, 2".repeat(30_000)
            )
            .into_bytes(),
            &["mesh.fold"],
        ),
        ("2^60 corners", "mesh.obj", format!("{triangle}f 1 2 1152921504606846976\n").into_bytes(), &["mesh.obj:4"]),
        ("corner -2^31", "mesh.obj", format!("{triangle}f 1 2 -2147483648\n").into_bytes(), &["mesh.obj:4"]),
        ("a face of 10^5 corners", "mesh.obj", format!("{triangle}f{corners}\n").into_bytes(), &["mesh.obj"]),
        (
            "a far vertex",
            "mesh.obj",
            format!("v 1e200 0 0\n{triangle}f 2 3 4\nf 1 2 3\n").into_bytes(),
            &["too far away"],
        ),
        ("ply of 2^31", "mesh.ply", ply(&vertices("2147483648")), &["2147483648"]),
        ("ply of 2^60", "mesh.ply", ply(&(vertices("1152921504606846976") + &faces("1"))), &["1152921504606846976"]),
        ("ply of 2^64", "mesh.ply", ply(&vertices("18446744073709551616")), &["mesh.ply:3"]),
        ("ply of -1", "mesh.ply", ply(&vertices("-1")), &["mesh.ply:3"]),
        (
            "ply of 2^60 faces",
            "mesh.ply",
            ply(&(vertices("1") + &faces("1152921504606846976"))),
            &["1152921504606846976"],
        ),
        ("ply of a long list", "mesh.ply", list, &["mesh.ply"]),
        ("ply without end", "mesh.ply", format!("ply\n{}", "comment\n".repeat(5000)).into_bytes(), &["end_header"]),
        ("ply of 10^5 elements", "mesh.ply", ply(&vertices("0").repeat(100_000)), &["more than 10000 lines"]),
        ("off of 2^32", "mesh.off", b"OFF\n4294967295 4294967295 0\n0 0 0\n".to_vec(), &["too many for"]),
        ("off of -1", "mesh.off", b"OFF\n-1 1 0\n0 0 0\n".to_vec(), &["mesh.off:2"]),
        ("off of a long face", "mesh.off", b"OFF\n1 1 0\n0 0 0\n2147483648 0 0\n".to_vec(), &["mesh.off"]),
        ("stl of 2^32", "mesh.stl", stl, &["mesh.stl"]),
    ];
    for (name, file, bytes, words) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join(file), bytes).expect("a mesh");
        fs::write(folder.path().join("film.toml"), format!("[mesh]\nfile = '{file}'\n")).expect("a scene");
        refused(name, folder.path(), &["check", "film.toml"], words);
    }
}

/// What is no file where a file belongs, and files without end.
#[test]
fn places_without_a_file() {
    /// What it is, how it is made, and what is said of it.
    type Maker = (&'static str, fn(&Path), &'static str);
    let makers: [Maker; 6] = [
        ("a device", |path| std::os::unix::fs::symlink("/dev/zero", path).expect("a link"), "it is a device"),
        ("a terminal", |path| std::os::unix::fs::symlink("/dev/tty", path).expect("a link"), "it is a device"),
        (
            "a pipe",
            |path| assert!(Command::new("mkfifo").arg(path).status().expect("mkfifo").success()),
            "it is a pipe",
        ),
        ("a socket", |path| drop(std::os::unix::net::UnixListener::bind(path).expect("a socket")), "it is a socket"),
        ("a folder", |path| fs::create_dir(path).expect("a folder"), "it is a folder"),
        (
            "a terabyte",
            |path| File::create(path).and_then(|file| file.set_len(1 << 40)).expect("a file"),
            "larger than",
        ),
    ];
    let scenes = [
        ("mesh.obj", "[mesh]\nfile = 'mesh.obj'\n".to_owned()),
        ("lengths.csv", format!("{BALL}[metric]\ncsv = 'lengths.csv'\n")),
        ("lengths.ply", format!("{BALL}[metric]\nfile = 'lengths.ply'\n")),
        ("start.off", format!("{BALL}[start]\nfile = 'start.off'\n")),
        ("bending.stl", format!("{BALL}[bending]\nfile = 'bending.stl'\n")),
        ("cones.csv", format!("{BALL}[[metric.change]]\nkind = 'ricci'\ncsv = 'cones.csv'\n")),
        ("sphere.png", format!("{BALL}[look]\nmaterial = 'matcap'\nmatcap = 'sphere.png'\n")),
    ];
    for (name, make, words) in makers {
        for (file, scene) in &scenes {
            let folder = tempfile::tempdir().expect("a folder");
            make(&folder.path().join(file));
            fs::write(folder.path().join("film.toml"), scene).expect("a scene");
            refused(&format!("{name} as {file}"), folder.path(), &["check", "film.toml"], &[file, words]);
        }
        let folder = tempfile::tempdir().expect("a folder");
        make(&folder.path().join("film.toml"));
        refused(&format!("{name} as scene"), folder.path(), &["check", "film.toml"], &["film.toml", words]);
    }
}

/// Tables of lengths and of curvatures.
#[test]
fn tables() {
    let cases: [(&str, String, &[&str]); 8] = [
        ("10^6 columns", "0,1".repeat(1_000_000), &["lengths.csv:1"]),
        ("a column of 10^6 digits", format!("0,1,{}\n", "9".repeat(1_000_000)), &["lengths.csv:1"]),
        ("vertex 2^60", "0,1152921504606846976,1\n".into(), &["lengths.csv:1"]),
        ("vertex -1", "0,-1,1\n".into(), &["lengths.csv:1"]),
        ("a length of 0", "0,1,0\n".into(), &["not positive"]),
        ("zeros", "\0".repeat(1 << 20), &["not text"]),
        ("a mistake on every line", "x,y,z\n".repeat(100_000), &["lengths.csv:1", "which column is which"]),
        ("a header of 10^5 names", format!("{}\n0,1,1\n", "u,v,length,".repeat(30_000)), &["lengths.csv:1"]),
    ];
    for (name, table, words) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("lengths.csv"), table).expect("a table");
        fs::write(folder.path().join("film.toml"), format!("{BALL}[metric]\ncsv = 'lengths.csv'\n")).expect("a scene");
        refused(name, folder.path(), &["check", "film.toml"], words);
    }
}

/// Folders of films that say more than they hold, with checksums that are right.
#[test]
fn forged_films() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = format!("{BALL}[clock]\nframes = 2\nsteps_per_frame = 1\n");
    fs::write(folder.path().join("film.toml"), scene).expect("a scene");
    let (code, said, _) = run(folder.path(), &["simulate", "film.toml", "--out", "out"]);
    assert_eq!(code, Some(0), "{said}");
    let path = folder.path().join("out/manifest.json");
    let honest = fs::read_to_string(&path).expect("a manifest");
    for (name, from, to) in [
        ("2^60 frames", "\"frame_count\": 2", "\"frame_count\": 1152921504606846976"),
        ("no frames", "\"frame_count\": 2", "\"frame_count\": 0"),
        ("2^32 vertices", "\"vertices\": 42", "\"vertices\": 4294967294"),
        ("2^60 faces", "\"faces\": 80", "\"faces\": 1152921504606846976"),
    ] {
        let forged = honest.replace(from, to);
        assert_ne!(forged, honest, "{name}");
        // The checksum is the first entry, of all bytes behind it.
        let (start, body) = forged.split_at(forged.find("\",\n").expect("a checksum") + 2);
        let start = &start[..start.len() - 10];
        let sealed = format!("{start}{:08x}\",{body}", crc32fast::hash(body.as_bytes()));
        File::create(&path).and_then(|mut file| file.write_all(sealed.as_bytes())).expect("a manifest");
        for command in [&["inspect", "out"][..], &["render", "film.toml", "--out", "out"]] {
            refused(name, folder.path(), command, &["it is damaged (it says that there are"]);
        }
    }
}
