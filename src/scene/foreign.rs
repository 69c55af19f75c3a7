//! Files that are given where a scene belongs: what they are, by ending and by content, and what to do with them.

use crate::mesh::{FileFormat, is_binary_stl};
use crate::text::decode;
use std::path::Path;

const OTHER_MODELS: [&str; 24] = [
    "gltf", "glb", "fbx", "dae", "3ds", "3mf", "blend", "usd", "usda", "usdc", "usdz", "vtk", "vtp", "vtu", "msh",
    "mesh", "step", "stp", "iges", "igs", "abc", "x3d", "wrl", "ma",
];
const PICTURES: [&str; 14] =
    ["png", "apng", "jpg", "jpeg", "gif", "exr", "tif", "tiff", "bmp", "webp", "svg", "hdr", "mp4", "mov"];
const TABLES: [&str; 2] = ["csv", "tsv"];
const ARRAYS: [&str; 2] = ["npz", "npy"];

/// Reason and remedy.
type Sentence = (String, String);

/// What a file with this ending is, if that is no scene.
pub(super) fn foreign_ending(path: &Path) -> Option<Sentence> {
    let ending = path.extension()?.to_string_lossy().to_lowercase();
    let is_one_of = |endings: &[&str]| endings.contains(&ending.as_str());
    if is_one_of(&ARRAYS) {
        Some(arrays())
    } else if FileFormat::of(path).is_some() {
        Some(a_mesh(path))
    } else if is_one_of(&OTHER_MODELS) {
        Some(another_model())
    } else if is_one_of(&PICTURES) {
        Some(a_picture())
    } else if is_one_of(&TABLES) {
        Some((
            "it is a table, not a scene".into(),
            "name a scene file (TOML), which may name it as csv = '…' under [metric]".into(),
        ))
    } else if ending == "json" {
        Some(json())
    } else {
        None
    }
}

/// What these bytes are, if that is no scene.
pub(super) fn foreign_content(path: &Path, bytes: &[u8]) -> Option<Sentence> {
    let begins = |magic: &[u8]| bytes.starts_with(magic);
    if begins(b"\x89PNG") || begins(b"\xff\xd8\xff") || begins(b"GIF8") || begins(b"\x76\x2f\x31\x01") {
        Some(a_picture())
    } else if begins(b"glTF") || begins(b"Kaydara FBX") || begins(b"BLENDER") {
        Some(another_model())
    } else if begins(b"ply\n") || begins(b"ply\r") || is_binary_stl(bytes) {
        Some(a_mesh(path))
    } else if begins(b"PK\x03\x04") || begins(b"\x93NUMPY") {
        Some(arrays())
    } else {
        let head = decode(&bytes[..bytes.len().min(LOOKED_AT)]);
        match head.is_text() {
            true => foreign_text(path, &head.text),
            false => Some(("it is binary, not a scene".into(), "name a scene file, which is a text (TOML)".into())),
        }
    }
}

/// Bytes from the start of a file that tell what it is.
const LOOKED_AT: usize = 8192;

fn foreign_text(path: &Path, text: &str) -> Option<Sentence> {
    let text = text.trim_start_matches('\u{feff}');
    if text.starts_with("# vtk DataFile") {
        return Some(another_model());
    }
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next()?;
    // Every line of TOML has an equals sign, is the header of a table, or belongs to a text of several lines.
    if first.starts_with('{') {
        return Some(json());
    }
    if first.starts_with('<') {
        return Some(("it is XML or HTML, not a scene".into(), "name a scene file (TOML)".into()));
    }
    if first.contains('=') || first.starts_with('[') {
        return None;
    }
    let mut words = first.split_whitespace();
    let word = words.next()?;
    let numbers = words.clone().filter(|word| word.parse::<f64>().is_ok()).count();
    let is_obj = match word.to_lowercase().as_str() {
        "v" | "vn" | "vt" | "f" => words.next().is_some(),
        "o" | "g" | "s" | "mtllib" | "usemtl" => lines.any(|line| line.starts_with("v ")),
        _ => false,
    };
    let is_off = word.ends_with("OFF") && word.bytes().all(|b| b.is_ascii_uppercase() || b == b'4');
    let is_stl =
        word.eq_ignore_ascii_case("solid") && lines.clone().any(|line| line.to_lowercase().starts_with("facet"));
    let is_table = first.parse::<f64>().is_ok() || (word.parse::<f64>().is_ok() && numbers > 0) || is_row(first);
    if is_obj || is_off || is_stl || word == "ply" {
        Some(a_mesh(path))
    } else if is_table {
        Some(("it is a table of numbers, not a scene".into(), "name a scene file (TOML)".into()))
    } else {
        None
    }
}

/// Numbers between commas or semicolons.
fn is_row(line: &str) -> bool {
    let cells: Vec<&str> = line.split([',', ';', '\t']).collect();
    cells.len() > 1 && cells.iter().all(|cell| cell.trim().parse::<f64>().is_ok())
}

/// What to name in place of a folder.
pub(super) fn folder_that_is_no_scene(path: &Path) -> Sentence {
    if path.join("manifest.json").is_file() {
        let remedy =
            format!("name the scene file, or see what the film is worth with immerse inspect {}", path.display());
        return ("it is the folder of a film, not a scene".into(), remedy);
    }
    let mut scenes: Vec<String> = std::fs::read_dir(path)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .map(|path| path.display().to_string())
        .collect();
    scenes.sort();
    let remedy = match scenes.as_slice() {
        [] => "name a scene file; `immerse new NAME` writes one to start from".to_owned(),
        [only] => format!("name the scene file in it: {only}"),
        [first, ..] => format!("name one of the {} scene files in it, such as {first}", scenes.len()),
    };
    ("it cannot be read: it is a folder, not a scene".into(), remedy)
}

fn a_mesh(path: &Path) -> Sentence {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if FileFormat::of(path).is_none() {
        let remedy = format!(
            "give {name} the ending of its format ({}), and name it in a scene file (TOML) as file = '…' under [mesh]",
            FileFormat::endings()
        );
        return ("it is a mesh, not a scene".into(), remedy);
    }
    let remedy = format!(
        "name a scene file (TOML) with [mesh] and below it file = '{name}', or give the mesh to a scene with --mesh {}",
        path.display()
    );
    ("it is a mesh, not a scene".into(), remedy)
}

fn another_model() -> Sentence {
    let formats = FileFormat::names();
    let remedy = format!("export it as {formats}, and name a scene file (TOML) with [mesh] and file = '…'");
    ("it is a model, not a scene, in a format that is not read".into(), remedy)
}

fn a_picture() -> Sentence {
    ("it is a picture, not a scene".into(), "name the scene file (TOML) that it is of".into())
}

fn arrays() -> Sentence {
    (
        "it is an archive or arrays, not a scene".into(),
        "name a scene file (TOML), which may name arrays of faces as file = '…' under [mesh]".into(),
    )
}

fn json() -> Sentence {
    ("it is JSON, not a scene".into(), "name a scene file, which is TOML; `immerse new NAME` writes one".into())
}
