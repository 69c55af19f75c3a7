//! The page of a film: whole in one file, the same bytes each time, and as exact as it says. `tests/clients/run report` opens it
//! in a browser.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::time::SystemTime;

use crate::support::program;
use base64::Engine;
use serde_json::Value as Json;
use tempfile::TempDir;

/// A film whose metric changes, with a boundary and a generator.
const SCENE: &str = "# <script> of a film & more\n[mesh]\nshape = 'cylinder'\ncolumns = 12\nrows = 5\n\
                     [metric]\nformula = 'length * (1 + 0.3 * t * z)'\n[clock]\nframes = 5\n\
                     [output]\nsize = [48, 36]\nsamples = 1\nOUTPUT\n[checks]\nmax_rims = 0\nCHECKS";

fn write_scene(folder: &Path, output: &str, checks: &str) {
    fs::write(folder.join("film.toml"), SCENE.replace("OUTPUT", output).replace("CHECKS", checks)).unwrap();
}

/// What a command writes to standard output and standard error.
fn run(folder: &Path, arguments: &[&str], wanted: i32) -> (String, String) {
    let (code, out, err) = program(folder, arguments);
    assert_eq!(code, wanted, "{arguments:?}: {out}{err}");
    (out, err)
}

/// A film in the folder `out`, with its page.
fn film() -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    write_scene(folder.path(), "", "");
    let (out, _) = run(folder.path(), &["run", "film.toml", "--out", "out"], 0);
    assert!(out.contains("out: report.html written"), "{out}");
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    (folder, page)
}

/// What is between two texts.
fn between<'a>(page: &'a str, before: &str, after: &str) -> &'a str {
    let rest = page.split_once(before).unwrap_or_else(|| panic!("no {before}")).1;
    rest.split_once(after).unwrap().0
}

fn facts(page: &str) -> Json {
    serde_json::from_str(between(page, "<script type=\"application/json\" id=\"facts\">", "</script>")).unwrap()
}

fn stream(page: &str, name: &str) -> Vec<u8> {
    let text = between(page, &format!("<script type=\"text/plain\" id=\"data-{name}\">"), "</script>");
    let packed = base64::engine::general_purpose::STANDARD.decode(text).unwrap();
    miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap()
}

fn numbers(page: &str, name: &str) -> Vec<u32> {
    let bytes = stream(page, name);
    let count = bytes.len() / 4;
    (0..count).map(|k| u32::from_le_bytes([0, 1, 2, 3].map(|plane| bytes[plane * count + k]))).collect()
}

/// An array of numbers of a file that `numpy.load` opens.
fn array(path: &Path, name: &str) -> Vec<f64> {
    let mut file = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut bytes = Vec::new();
    file.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (header, entries) = (String::from_utf8_lossy(&bytes[..start]).into_owned(), &bytes[start..]);
    match &header[header.find('<').unwrap() + 1..][..2] {
        "f8" => entries.chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect(),
        "f4" => entries.chunks(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect(),
        "u4" => entries.chunks(4).map(|b| f64::from(u32::from_le_bytes(b.try_into().unwrap()))).collect(),
        other => panic!("{other}"),
    }
}

/// For each vertex, breadth first, itself and those of its neighbours that come before it.
fn order(vertices: usize, triangles: &[u32]) -> Vec<(usize, Vec<usize>)> {
    let mut all = vec![Vec::new(); vertices];
    for face in triangles.chunks(3) {
        (0..3).for_each(|k| all[face[k] as usize].extend([1, 2].map(|next| face[(k + next) % 3] as usize)));
    }
    let mut order: Vec<usize> = Vec::new();
    for first in 0..vertices {
        let mut next = order.len();
        order.extend((!order.contains(&first)).then_some(first));
        while next < order.len() {
            all[order[next]].iter().for_each(|u| order.extend((!order.contains(u)).then_some(*u)));
            next += 1;
        }
    }
    let rank = |v: usize| order.iter().position(|&u| u == v);
    order.iter().map(|&v| (v, all[v].iter().copied().filter(|&u| rank(u) < rank(v)).collect())).collect()
}

/// Coordinates of all frames on the grid of the page, as its script finds them: x of all vertices, then y, then z.
fn places(page: &str, vertices: usize, frames: usize) -> Vec<Vec<u16>> {
    let (bytes, size) = (stream(page, "positions"), 3 * vertices);
    let order = order(vertices, &numbers(page, "triangles"));
    let mut all: Vec<Vec<u16>> = Vec::new();
    assert_eq!(bytes.len(), frames * (2 * size + 1));
    for frame in bytes.chunks(2 * size + 1) {
        let mut now = vec![0_u16; size];
        for axis in 0..3 {
            let mut far = vec![0_i16; vertices];
            for (v, neighbours) in &order {
                let k = axis * vertices + v;
                let folded = u16::from_le_bytes([frame[1 + k], frame[1 + size + k]]);
                let error = (folded >> 1) ^ if folded & 1 == 1 { u16::MAX } else { 0 };
                let sum: i32 = neighbours.iter().map(|&u| i32::from(far[u])).sum();
                let mean = sum / (neighbours.len() as i32).max(1);
                far[*v] = (mean as i16).wrapping_add(error as i16);
                let guess = match frame[0] {
                    0 => 1 << 15,
                    1 => all[all.len() - 1][k],
                    2 => all[all.len() - 1][k].wrapping_mul(2).wrapping_sub(all[all.len() - 2][k]),
                    other => panic!("guess {other}"),
                };
                now[k] = guess.wrapping_add(far[*v] as u16);
            }
        }
        all.push(now);
    }
    all
}

#[test]
fn a_run_ends_with_a_page_that_needs_nothing_else() {
    let (_folder, page) = film();
    assert!(page.starts_with("<!doctype html>") && page.trim_end().ends_with("</html>"));
    // A name of an XML namespace is all that may look like an address.
    let others = page.replace("http://www.w3.org/2000/svg", "");
    for load in
        ["http:", "https:", "src=", "@import", "url(", "import(", "fetch(", "XMLHttpRequest", "<link", "WebSocket"]
    {
        assert!(!others.contains(load), "{load}");
    }
    // The scene is in it, and nothing of it ends a script.
    let facts = facts(&page);
    assert!(facts["text"].as_str().unwrap().starts_with("# <script> of a film & more"));
    assert_eq!(facts["findings"]["command"], "immerse run film.toml");
    assert_eq!(facts["frames"], serde_json::json!([1, 2, 3, 4, 5]));
    assert_eq!(facts["generators"].as_array().unwrap().len(), 1);
    for curve in
        ["mean", "p95", "max", "rims", "pinchPoints", "bending", "rotation", "torsion", "steps", "iterations", "bend"]
    {
        assert_eq!(facts["curves"][curve].as_array().map(Vec::len), Some(5), "{curve}");
    }
    assert!(facts["curves"]["iterations"][4].as_u64() > Some(0), "the linear solver worked");
    assert_eq!(page.matches("<script").count(), 1 + page.matches("type=\"text/plain\"").count() + 1);
}

#[test]
fn positions_and_fields_are_as_exact_as_the_page_says() {
    let (folder, page) = film();
    let facts = facts(&page);
    let read = |file: &str, name: &str| array(&folder.path().join("out").join(file), name);
    let vertices = facts["origin"]["mesh"]["vertices"].as_u64().unwrap() as usize;
    let step = facts["grid"]["step"].as_f64().unwrap();
    let origin: Vec<f64> = facts["grid"]["origin"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let mut farthest = 0.0_f64;
    for (k, places) in places(&page, vertices, 5).iter().enumerate() {
        let positions = read(&format!("frames/{:06}.npz", k + 1), "positions");
        for (v, axis) in (0..vertices).flat_map(|v| (0..3).map(move |axis| (v, axis))) {
            let found = origin[axis] + step * f64::from(places[axis * vertices + v]);
            farthest = farthest.max((found - positions[3 * v + axis]).abs());
        }
    }
    assert!(farthest <= 0.5 * step * (1.0 + 1e-9), "{farthest} of {step}");
    assert!(farthest > 0.4 * step, "it is no more exact than it says, or the step is not that of the data");
    assert!(step < 2e-5 * facts["diagonal"].as_f64().unwrap());
    let triangles: Vec<f64> = numbers(&page, "triangles").into_iter().map(f64::from).collect();
    assert_eq!(triangles, read("mesh.npz", "triangles"));

    // Against the field as it is exported.
    run(folder.path(), &["export", "out", "--format", "npz"], 0);
    let faces = triangles.len() / 3;
    let field = facts["fields"].as_array().unwrap().iter().find(|field| field["name"] == "length_error").unwrap();
    let range: Vec<f64> = field["range"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap() / 100.0).collect();
    let mut now = vec![0_u8; faces];
    for (k, errors) in stream(&page, "length_error").chunks(faces).enumerate() {
        now.iter_mut().zip(errors).for_each(|(now, error)| *now = now.wrapping_add(*error));
        let values = read(&format!("export/film.{:06}.npz", k + 1), "length_error");
        for (byte, value) in now.iter().zip(values) {
            let wanted = value.clamp(range[0], range[1]);
            let found = range[0] + (range[1] - range[0]) * f64::from(*byte) / 254.0;
            assert!((found - wanted).abs() <= 0.501 * (range[1] - range[0]) / 254.0, "frame {k}: {found}, {wanted}");
        }
    }
    assert_eq!(stream(&page, "sky").len(), 5 * 2 * vertices);
}

#[test]
fn the_same_film_has_the_same_page_and_a_page_that_is_there_is_kept() {
    let (folder, page) = film();
    let path = folder.path().join("out/report.html");
    let time = || fs::metadata(&path).unwrap().modified().unwrap();
    let of = |more: &[&str]| run(folder.path(), &[&["report", "out"], more].concat(), 0).0;
    let before: SystemTime = time();
    assert_eq!(of(&[]), "out: report.html was there\n");
    assert_eq!(time(), before);
    for threads in ["1", "2", "5"] {
        assert_eq!(of(&["--restart", "--threads", threads]), "out: report.html written\n");
        assert!(fs::read_to_string(&path).unwrap() == page, "{threads} threads");
    }
    // A film computed and told in two goes.
    let again = TempDir::new().unwrap();
    write_scene(again.path(), "", "");
    run(again.path(), &["simulate", "film.toml", "--out", "out", "--threads", "1"], 0);
    assert!(!again.path().join("out/report.html").exists());
    run(again.path(), &["report", "out"], 0);
    assert!(fs::read_to_string(again.path().join("out/report.html")).unwrap() == page);
    // Damaged, it is written again; of another film, it goes.
    fs::write(&path, page.replace("</html>", "</htm>")).unwrap();
    assert_eq!(of(&[]), "out: report.html written\n");
    assert!(fs::read_to_string(&path).unwrap() == page);
    let text = fs::read_to_string(folder.path().join("film.toml")).unwrap();
    fs::write(folder.path().join("film.toml"), text.replace("0.3", "0.2")).unwrap();
    let (_, err) = run(folder.path(), &["simulate", "film.toml", "--out", "out"], 0);
    assert!(err.contains("report.html") && !path.exists(), "{err}");
}

#[test]
fn a_scene_may_ask_for_none() {
    let folder = TempDir::new().unwrap();
    write_scene(folder.path(), "report = false", "");
    let (out, _) = run(folder.path(), &["run", "film.toml", "--out", "out"], 0);
    assert!(!out.contains("report"), "{out}");
    assert!(!folder.path().join("out/report.html").exists());
    write_scene(folder.path(), "report = 3", "");
    let (_, err) = run(folder.path(), &["check", "film.toml"], 2);
    assert!(err.contains("`report`") && err.contains("true or false"), "{err}");
    // Asked for by hand, it is there.
    write_scene(folder.path(), "report = false", "");
    run(folder.path(), &["report", "out"], 0);
    let (_, err) = run(folder.path(), &["run", "film.toml", "--out", "out"], 0);
    assert!(err.contains("left from an earlier run, not made anew (1 files): report.html"), "{err}");
}

#[test]
fn failed_checks_come_first_in_sentences() {
    let folder = TempDir::new().unwrap();
    write_scene(folder.path(), "", "max_l2_length_error = 1e-9\nfilm = { max_jump = 1e-3 }");
    run(folder.path(), &["run", "film.toml", "--out", "out"], 1);
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    let faults = facts(&page)["findings"]["faults"].clone();
    let faults: Vec<&str> = faults.as_array().unwrap().iter().map(|fault| fault.as_str().unwrap()).collect();
    assert!(faults[0].starts_with("The length error (root mean square) in the last frame is "), "{faults:?}");
    assert!(faults[0].ends_with(", and the scene asks for at most 1.0e-7 %."), "{faults:?}");
    assert!(faults[1].starts_with("The largest move between two frames, over the usual one,"), "{faults:?}");
    assert!(faults.iter().any(|fault| fault.starts_with("The last frame is not what was asked for")), "{faults:?}");
}

/// 240 frames of 6 000 faces are 1 440 000 faces in all, for which a page has 10 MB. A film of a fifteenth as many, which moves as
/// wildly as one can, may take a fifteenth, and what every page has.
#[test]
fn a_page_is_as_small_as_it_has_to_be() {
    let folder = TempDir::new().unwrap();
    let scene = "[mesh]\nshape = 'torus'\nmajor_radius = 1\nminor_radius = 0.4\ncolumns = 40\nrows = 20\n\
                 [start]\nrandom = 1\n[clock]\nframes = 60\nsteps_per_frame = 1\n[output]\nsize = [64, 48]\n";
    fs::write(folder.path().join("film.toml"), scene).unwrap();
    run(folder.path(), &["simulate", "film.toml", "--out", "out"], 0);
    run(folder.path(), &["report", "out"], 0);
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    let facts = facts(&page);
    let faces = facts["origin"]["mesh"]["faces"].as_u64().unwrap() as usize;
    assert_eq!((faces, facts["frames"].as_array().unwrap().len()), (1600, 60));
    let per_face_and_frame = (page.len() - 120_000) as f64 / (1600.0 * 60.0);
    println!("{} bytes, {per_face_and_frame:.2} a face and frame", page.len());
    assert!(per_face_and_frame < 10e6 / (240.0 * 6000.0), "{per_face_and_frame}");
}

#[test]
fn a_film_that_is_not_done_has_a_page_of_what_is_there() {
    let (folder, _) = film();
    fs::remove_file(folder.path().join("out/frames/000004.json")).unwrap();
    run(folder.path(), &["report", "out"], 0);
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert_eq!(facts(&page)["frames"], serde_json::json!([1, 2, 3]));
    assert_eq!(facts(&page)["origin"]["frames"], 5);
    let (_, err) = run(folder.path(), &["report", "nowhere"], 2);
    assert!(err.contains("nowhere"), "{err}");
    for k in 1..=5 {
        let _ = fs::remove_file(folder.path().join(format!("out/frames/{k:06}.json")));
    }
    let (_, err) = run(folder.path(), &["report", "out"], 2);
    assert!(err.contains("frame 1 has not been computed"), "{err}");
}
