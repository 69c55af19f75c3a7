//! Reads triangle meshes from files. What is not a triangle is cut into triangles, what can be
//! repaired is, and everything else is an error with its place in the file.

mod connectivity;
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

use super::repair::Unrepairable;
use super::{MeshError, Surface};
use crate::scene::Weld;

use connectivity::Format;
pub use connectivity::read_positions;
pub use csv::{read_edge_lengths, read_vertex_numbers};

/// Reads an OBJ, PLY (ascii or binary), OFF or STL (ascii or binary) file, chosen by the file's ending.
///
/// Polygons are cut into triangles, also concave ones (see `polygon.rs`). Seams are welded: exactly, and in STL files
/// within the rounding of single precision. The result is oriented and compacted by [`super::repair`]; what all that
/// changed is in [`Surface::repairs`], and [`super::Mesh::file_vertex`] says what the file calls each vertex. A file whose
/// vertices all lie in one point, or an OBJ that lists faces but no
/// vertices, is purely intrinsic: it has no positions.
///
/// # Errors
/// [`MeshError::File`] and [`MeshError::FileLine`] for files that cannot be read or parsed,
/// [`MeshError::InFile`] for faces that do not form an oriented surface.
pub fn read(path: &Path) -> Result<Surface, MeshError> {
    read_welded(path, None)
}

/// As [`read`], with seams welded as the scene says instead of as is usual for the format.
///
/// # Errors
/// As [`read`].
pub fn read_welded(path: &Path, weld: Option<Weld>) -> Result<Surface, MeshError> {
    let (soup, format) = read_soup(path)?;
    soup.surface(format, weld).map_err(|unrepairable| match unrepairable {
        Unrepairable::Size(error) => soup.in_file(path, format, error, &[]),
        Unrepairable::Faults(mut faults) => {
            for fault in &mut faults.listed {
                fault.lines = soup.lines_of(&fault.faces);
                fault.error = fault
                    .error
                    .clone()
                    .renumbered(|f| soup.polygon(f) + format.counts_from() as usize, format.counts_from());
            }
            let lines = if let [only] = &*faults.listed { only.lines.clone() } else { Vec::new() };
            soup.in_file(path, format, faults.into_error(), &lines)
        }
    })
}

fn read_soup(path: &Path) -> Result<(Soup, Format), MeshError> {
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
    let ending = ending.unwrap_or_default();
    let soup = content::check(&bytes, &ending).and_then(|()| parse(&bytes)).map_err(|problem| problem.in_file(path))?;
    Ok((soup, Format::of(&ending)))
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
pub(super) struct Soup {
    vertex_count: usize,
    /// One per vertex, all finite; `None` where the format leaves them out.
    positions: Option<Vec<DVec3>>,
    triangles: Vec<[u32; 3]>,
    /// Per triangle its line in the file; empty for binary files.
    lines: Vec<usize>,
    /// Per triangle the polygon of the file that it is of; empty where there are only triangles.
    polygons: Vec<u32>,
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
