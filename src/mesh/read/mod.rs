//! Reads triangle meshes from files. What is not a triangle is cut into triangles, what can be
//! repaired is, and everything else is an error with its place in the file.

mod content;
mod csv;
mod obj;
mod off;
mod ply;
mod ply_header;
mod polygons;
mod stl;
mod table;

use std::path::Path;

use glam::DVec3;

use super::{Mesh, MeshError, Surface, repair};

pub use csv::{read_edge_lengths, read_vertex_numbers};

/// Reads an OBJ, PLY (ascii or binary), OFF or STL (ascii or binary) file, chosen by the file's ending.
///
/// Polygons are cut into triangles, also concave ones (see `polygon.rs`). The result is oriented and compacted by [`repair`]; what that changed is in
/// [`Surface::repairs`]. A file whose vertices all lie in one point, or an OBJ that lists faces but no
/// vertices, is purely intrinsic: it has no positions.
///
/// # Errors
/// [`MeshError::File`] and [`MeshError::FileLine`] for files that cannot be read or parsed,
/// [`MeshError::InFile`] for faces that do not form an oriented surface.
pub fn read(path: &Path) -> Result<Surface, MeshError> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let parse = match ending.as_deref() {
        Some("obj") => obj::parse,
        Some("ply") => ply::parse,
        Some("off") => off::parse,
        Some("stl") => stl::parse,
        _ => {
            return Err(MeshError::File {
                path: path.into(),
                reason: "the file's ending names no known mesh format".into(),
                remedy: "use a file that ends in .obj, .ply, .off or .stl".into(),
            });
        }
    };
    let bytes = read_bytes(path)?;
    let soup = content::check(&bytes, ending.as_deref().unwrap_or_default())
        .and_then(|()| parse(&bytes))
        .map_err(|problem| problem.in_file(path))?;
    let repaired = repair(soup.vertex_count, &soup.triangles).map_err(|error| {
        let lines: Vec<String> =
            error.faces().iter().filter_map(|&f| soup.lines.get(f)).map(|line| line.to_string()).collect();
        let lines = match lines.len() {
            0 => String::new(),
            1 => format!(", line {}", lines[0]),
            _ => format!(", lines {}", lines.join(", ")),
        };
        MeshError::InFile { path: path.into(), lines, error: Box::new(error) }
    })?;
    let positions = soup
        .positions
        .filter(|all| all.iter().any(|p| *p != all[0]))
        .map(|all| repaired.input_vertices.iter().map(|&v| all[v]).collect());
    let repairs = soup.notes.into_iter().chain(repaired.repairs).collect();
    Ok(Surface { mesh: repaired.mesh, positions, coordinates: None, edge_lengths: None, repairs })
}

/// Reads the vertex positions of a file whose faces are those of the mesh, in the same order; |V| values.
///
/// # Errors
/// As [`read`], and [`MeshError::File`] if the faces are others or there are no positions.
pub fn read_positions(path: &Path, mesh: &Mesh) -> Result<Vec<DVec3>, MeshError> {
    let surface = read(path)?;
    let fail = |reason: String, remedy: &str| MeshError::File { path: path.into(), reason, remedy: remedy.into() };
    let [here, there] = [mesh, &surface.mesh].map(Mesh::triangles);
    if here != there {
        let reason = match here.iter().zip(&there).position(|(a, b)| a != b) {
            Some(face) if here.len() == there.len() => {
                format!("face {face} has vertices {:?}, in the mesh of the scene {:?}", there[face], here[face])
            }
            _ => format!("it has {} faces, the mesh of the scene has {}", there.len(), here.len()),
        };
        return Err(fail(reason, "use a mesh with the same faces in the same order, only its positions may differ"));
    }
    surface.positions.ok_or_else(|| fail("it has no positions".into(), "use a file that has them"))
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    std::fs::read(path).map_err(|error| MeshError::File {
        path: path.into(),
        reason: format!("cannot be read: {error}"),
        remedy: "check the path (relative ones start at the scene file) and the permissions".into(),
    })
}

/// What a file says, before any of it is checked against the rest.
#[derive(Default)]
struct Soup {
    vertex_count: usize,
    /// One per vertex, all finite; `None` where the format leaves them out.
    positions: Option<Vec<DVec3>>,
    triangles: Vec<[u32; 3]>,
    /// Per triangle its line in the file; empty for binary files.
    lines: Vec<usize>,
    /// What the reader left out or changed, in sentences.
    notes: Vec<String>,
}

/// What is wrong with a file, and where.
struct Problem {
    line: Option<usize>,
    reason: String,
    remedy: &'static str,
}

impl Problem {
    fn new(reason: impl Into<String>, remedy: &'static str) -> Self {
        Self { line: None, reason: reason.into(), remedy }
    }

    fn at(line: usize, reason: impl Into<String>, remedy: &'static str) -> Self {
        Self { line: Some(line), reason: reason.into(), remedy }
    }

    fn in_file(self, path: &Path) -> MeshError {
        let Problem { line, reason, remedy } = self;
        let (path, remedy) = (path.to_path_buf(), remedy.to_string());
        match line {
            Some(line) => MeshError::FileLine { path, line, reason, remedy },
            None => MeshError::File { path, reason, remedy },
        }
    }
}

/// The lines of a text, counted from 1, without comments, blank ones left out.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(k, line)| (k + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// A number as programs write it, also with the exponent of Fortran, as in `1.5D-3`.
fn parse_number(word: &str) -> Option<f64> {
    word.parse().ok().or_else(|| word.replace(['d', 'D'], "e").parse().ok())
}

/// A finite number.
fn number(word: Option<&str>, line: usize, what: &str) -> Result<f64, Problem> {
    let word = word.ok_or_else(|| Problem::at(line, format!("{what} is missing"), "write a number"))?;
    match parse_number(word) {
        Some(x) if x.is_finite() => Ok(x),
        Some(_) => Err(Problem::at(line, format!("{what} `{word}` is not finite"), "every number must be finite")),
        None if parse_number(&word.replace(',', ".")).is_some() => {
            Err(Problem::at(line, format!("{what} `{word}` is not a number"), "write a decimal point, as in 0.25"))
        }
        None => Err(Problem::at(line, format!("{what} `{word}` is not a number"), "write a number such as 0.25")),
    }
}

/// The first three words as a point.
fn point<'a>(words: &mut impl Iterator<Item = &'a str>, line: usize) -> Result<DVec3, Problem> {
    Ok(DVec3::new(
        number(words.next(), line, "coordinate x")?,
        number(words.next(), line, "coordinate y")?,
        number(words.next(), line, "coordinate z")?,
    ))
}

/// A count or an index that counts from 0.
fn index(word: Option<&str>, line: usize, what: &str) -> Result<u32, Problem> {
    let word = word.ok_or_else(|| Problem::at(line, format!("{what} is missing"), "write a whole number"))?;
    word.parse().map_err(|_| {
        Problem::at(line, format!("{what} `{word}` is not a number from 0 to {}", u32::MAX), "write a whole number")
    })
}
