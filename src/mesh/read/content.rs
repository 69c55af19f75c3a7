//! What a file is by its content, so that a wrong ending or a packed file is told in one sentence.

use super::format::FileFormat;
use super::formats::{off, stl};
use super::problem::Problem;
use super::words::lines;
use crate::npy::{is_archive, is_array};
use crate::text::{decode, without_mark};

/// # Errors
/// [`Problem`] if the file is empty or plainly something else than its ending says.
pub(super) fn check(bytes: &[u8], expected: FileFormat) -> Result<(), Problem> {
    if without_mark(bytes).trim_ascii().is_empty() {
        return Err(Problem::new(
            "the file is empty, there is no surface in it",
            "give a file with vertices and faces",
        ));
    }
    if let Some((what, remedy)) = no_mesh(bytes).filter(|_| expected != FileFormat::Npz || !is_archive(bytes)) {
        return Err(Problem::new(format!("this is {what}, not a mesh"), remedy));
    }
    match format(bytes) {
        Some((found, name)) if found != expected => {
            let reason = format!("the file ends in .{}, but what is in it is {name}", expected.ending());
            Err(Problem::new(reason, format!("rename it so that it ends in .{}", found.ending())))
        }
        _ => Ok(()),
    }
}

/// What else people give, and what to do with it.
fn no_mesh(bytes: &[u8]) -> Option<(&'static str, String)> {
    const UNPACK: &str = "unpack it and name the file that is in it";
    const DOWNLOAD: &str = "download the file itself (the raw file)";
    let export = format!("export the surface as {}", FileFormat::names());
    let start = without_mark(bytes).trim_ascii_start();
    let starts: [(&[u8], &str, &str); 11] = [
        (b"\x1f\x8b", "a file packed by gzip", UNPACK),
        (b"PK\x03\x04", "a zip archive", UNPACK),
        (b"BZh", "a file packed by bzip2", UNPACK),
        (b"\xfd7zXZ\0", "a file packed by xz", UNPACK),
        (b"\x28\xb5\x2f\xfd", "a file packed by zstd", UNPACK),
        (b"7z\xbc\xaf", "a 7z archive", UNPACK),
        (b"glTF", "a binary glTF file", &*export),
        (b"version https://git-lfs", "the place holder that Git LFS leaves for a large file", "run `git lfs pull`"),
        (b"<!DOCTYPE", "a web page", DOWNLOAD),
        (b"<html", "a web page", DOWNLOAD),
        (b"<?xml", "an XML file", &*export),
    ];
    starts.into_iter().find(|(word, ..)| start.starts_with(word)).map(|(_, what, remedy)| (what, remedy.to_owned()))
}

/// The format that the content shows beyond doubt, and what it is called.
fn format(bytes: &[u8]) -> Option<(FileFormat, &'static str)> {
    const START: usize = 4096;
    if is_array(bytes) {
        return Some((FileFormat::Npy, "an array of NumPy"));
    }
    if stl::is_binary(bytes) {
        return Some((FileFormat::Stl, "a binary STL file"));
    }
    let text = decode(&bytes[..bytes.len().min(START)]).text;
    let mut lines = lines(&text).map(|(_, line)| line);
    let first = lines.next()?;
    let word = |line: &str| line.split_ascii_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    if first == "ply" {
        return Some((FileFormat::Ply, "a PLY file"));
    }
    if first.starts_with('{') && text.contains("_vertices\"") {
        return Some((FileFormat::Fold, "a FOLD file"));
    }
    if off::is_header(first) {
        return Some((FileFormat::Off, "an OFF file"));
    }
    let second = lines.next().unwrap_or_default();
    if word(first) == "solid" && ["facet", "endsolid", "end"].contains(&&*word(second)) {
        return Some((FileFormat::Stl, "an STL file"));
    }
    let has_point = |line: &str| word(line) == "v" && line.split_ascii_whitespace().nth(3).is_some();
    if has_point(first) || has_point(second) || lines.any(has_point) {
        return Some((FileFormat::Obj, "an OBJ file"));
    }
    None
}
