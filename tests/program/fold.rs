//! `[clock] fold = "refuse"`: a film that folds otherwise and then does not, to the same bytes however it is made; and films that end.

use super::support::program;
use std::fs;
use std::path::Path;

/// A flat strip of 24 × 2 cells, 4 long.
fn write_strip(folder: &Path) {
    let vertices = (0..=24)
        .flat_map(|i| (0..=2).map(move |j| format!("v {} {} 0\n", f64::from(i) / 6.0 - 2.0, f64::from(j) / 4.0)));
    let corner = |i: i32, j: i32| 3 * i + j + 1;
    let faces = (0..24).flat_map(|i| (0..2).map(move |j| [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]));
    let faces = faces.map(|cell| {
        let [a, b, c, d] = cell.map(|[i, j]| corner(i, j));
        format!("f {a} {b} {c}\nf {a} {c} {d}\n")
    });
    fs::write(folder.join("strip.obj"), vertices.chain(faces).collect::<String>()).expect("a file");
}

/// The strip begins rolled up, nearly twice around, and a few long steps unroll it.
const UNROLLS: &str = "mesh.file = 'strip.obj'\n[start]\nfrom = 'mesh'\nformula = ['sin(3*x)/3', 'y', '(1-cos(3*x))/3']\n\
                       [clock]\nframes = 6\nsteps_per_frame = 1\n[[phase]]\nepsilon = [1, 1, 1, 1]\ndt = 3000\n";

fn frames(folder: &Path, count: usize) -> Vec<Vec<u8>> {
    (1..=count).map(|k| fs::read(folder.join(format!("frames/{k:06}.npz"))).expect("a frame")).collect()
}

#[test]
fn a_strip_unrolls_without_a_fold_if_folds_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    write_strip(here);
    fs::write(here.join("unroll.toml"), UNROLLS).expect("a file");
    let film = here.join("renders/unroll");
    let simulate = |more: &[&str]| {
        let (code, out, err) = program(here, &[&["simulate", "unroll.toml"], more].concat());
        assert_eq!(code, 0, "{out}{err}");
    };
    let certified = || program(here, &["certify", "renders/unroll"]);
    simulate(&[]);
    let (code, out, _) = certified();
    assert!(code == 1 && out.contains("not a regular homotopy"), "{out}");
    let allowed = frames(&film, 6);
    // The curves of a film with a certificate have its events.
    let (code, _, err) = program(here, &["inspect", "renders/unroll", "--curves"]);
    let table = fs::read_to_string(film.join("curves.csv")).expect("a table");
    let events = |line: &str| line.rsplit(',').next().map(str::to_owned).expect("a column");
    let column: Vec<String> = table.lines().map(events).collect();
    assert!(code == 0 && column[0] == "events" && column[1] == "0", "{err}{column:?}");
    assert!(column[2..].iter().any(|count| count != "0"), "{column:?}");
    // Marks are drawn on the frames on both sides of an interval with events, and on no other.
    let pictures = |events: &str| {
        let size = ["--set", "output.size=[160,120]", "--set", "output.samples=1", "--set", events];
        let (code, out, err) = program(here, &[&["render", "unroll.toml"][..], &size].concat());
        assert_eq!(code, 0, "{out}{err}");
        (1..=6).map(|k| fs::read(film.join(format!("{k:06}.png"))).expect("a picture")).collect::<Vec<_>>()
    };
    let (plain, marked) = (pictures("look.events=false"), pictures("look.events=true"));
    for k in 0..6 {
        let has_events = column.get(k + 1..).is_some_and(|rest| rest.iter().take(2).any(|count| count != "0"));
        assert_eq!(plain[k] != marked[k], has_events, "frame {}: {column:?}", k + 1);
    }

    let refuse = ["--set", "clock.fold='refuse'"];
    simulate(&refuse);
    let (code, out, err) = certified();
    assert!(code == 0 && out.contains("regular homotopy: no hinge folds"), "{out}{err}");
    let refused = frames(&film, 6);
    assert!(allowed[0] == refused[0] && allowed[1..] != refused[1..]);
    // On one thread, and after an interruption.
    simulate(&[&refuse[..], &["--restart", "--threads", "1"]].concat());
    assert!(frames(&film, 6) == refused);
    for k in 4..=6 {
        fs::remove_file(film.join(format!("frames/{k:06}.npz"))).expect("a frame");
    }
    simulate(&refuse);
    assert!(frames(&film, 6) == refused);
}

/// Where no part of a step helps, and where frames are what they are, the film ends with the frame, the edge and a remedy.
#[test]
fn a_film_that_has_to_fold_ends() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    let noisy = "mesh = { shape = 'sphere', subdivisions = 6 }\n[start]\nfrom = 'mesh'\nnoise = { amplitude = 0.09, wavelength = 0.5, seed = 1 }\n\
                 [clock]\nframes = 12\nfold = 'refuse'\n[[phase]]\nepsilon = [1, 0.05, 1, 0.1]\n";
    let classes = "mesh = { shape = 'torus' }\n[spin]\nclass = 'all'\n[clock]\nfold = 'refuse'\n";
    // Where it settles is where its target angles say, whichever way it comes there.
    write_strip(here);
    let settles = UNROLLS.split("[clock]").next().map(|start| {
        format!(
            "{start}[clock]\nframes = 2\nfold = 'refuse'\n[bending]\nfrom = 'start'\nbending_stiffness = 1\n\
             amount = {{ times = [0, 1], values = [1, 0] }}\n"
        )
    });
    let settles = settles.expect("a start");
    for (name, scene, says) in [
        ("settles", &*settles, "on the way to frame 2, at time 1, the edge between vertices ["),
        ("noisy", noisy, "folds over, near ("),
        ("classes", classes, "no regular homotopy leads from one to the next"),
    ] {
        fs::write(here.join(format!("{name}.toml")), scene).expect("a file");
        let (code, out, err) = program(here, &["simulate", &format!("{name}.toml")]);
        assert!(code == 2 && err.contains(says) && err.contains("fold = 'refuse'"), "{name}: {code} {out}{err}");
    }
}

/// A film that begins with rims and ends without: loops stand for them on those frames alone, in any colour.
#[test]
fn rims_are_drawn_as_loops() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    let noisy = "mesh = { shape = 'sphere', subdivisions = 6 }\n[start]\nfrom = 'mesh'\nnoise = { amplitude = 0.09, wavelength = 0.5, seed = 1 }\n\
                 [clock]\nframes = 8\n[[phase]]\nepsilon = [1, 0.05, 1, 0.1]\n[output]\nsize = [160, 120]\nsamples = 1\n";
    fs::write(here.join("noisy.toml"), noisy).expect("a file");
    let film = here.join("renders/noisy");
    let (code, out, err) = program(here, &["simulate", "noisy.toml"]);
    assert_eq!(code, 0, "{out}{err}");
    let pictures = |more: &[&str]| {
        let (code, out, err) = program(here, &[&["render", "noisy.toml"], more].concat());
        assert_eq!(code, 0, "{out}{err}");
        (1..=8).map(|k| fs::read(film.join(format!("{k:06}.png"))).expect("a picture")).collect::<Vec<_>>()
    };
    let loops = ["--set", "look.rim_loops=0.6"];
    let (plain, open) = (pictures(&[]), pictures(&loops));
    let differ: Vec<bool> = plain.iter().zip(&open).map(|(a, b)| a != b).collect();
    assert!(differ[0] && !differ[7], "{differ:?}");
    // A field of faces, one of vertices, a pattern, a shutter that is open to the next frame and layers take the loops along.
    for field in ["length_error", "mean_curvature"] {
        let field = format!("look.color.field='{field}'");
        let more = [
            "--set",
            &field,
            "--set",
            "camera.shutter=0.5",
            "--set",
            "look.pattern.kind='grid'",
            "--set",
            "output.format=['png', 'exr']",
        ];
        pictures(&[&loops[..], &more[..]].concat());
    }
}
