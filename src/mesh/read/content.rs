//! What a file is by its content, so that a wrong ending or a packed file is told in one sentence.

use std::borrow::Cow;

use super::{Problem, off};
use crate::text::{decode, without_mark};

/// # Errors
/// [`Problem`] if the file is empty or plainly something else than its ending says.
pub(super) fn check(bytes: &[u8], ending: &str) -> Result<(), Problem> {
    if without_mark(bytes).trim_ascii().is_empty() {
        return Err(Problem::new(
            "the file is empty, there is no surface in it",
            "give a file with vertices and faces",
        ));
    }
    if let Some((what, remedy)) = no_mesh(bytes) {
        return Err(Problem::new(format!("this is {what}, not a mesh"), remedy));
    }
    match format(bytes) {
        Some((found, name, remedy)) if found != ending => {
            let reason = format!("the file ends in .{ending}, but what is in it is {name}");
            Err(Problem::new(reason, remedy))
        }
        _ => Ok(()),
    }
}

/// What else people give, and what to do with it.
fn no_mesh(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const UNPACK: &str = "unpack it and name the file that is in it";
    const EXPORT: &str = "export the surface as OBJ, PLY, OFF or STL";
    const DOWNLOAD: &str = "download the file itself (the raw file)";
    let start = without_mark(bytes).trim_ascii_start();
    let starts: [(&[u8], _, _); 11] = [
        (b"\x1f\x8b", "a file packed by gzip", UNPACK),
        (b"PK\x03\x04", "a zip archive", UNPACK),
        (b"BZh", "a file packed by bzip2", UNPACK),
        (b"\xfd7zXZ\0", "a file packed by xz", UNPACK),
        (b"\x28\xb5\x2f\xfd", "a file packed by zstd", UNPACK),
        (b"7z\xbc\xaf", "a 7z archive", UNPACK),
        (b"glTF", "a binary glTF file", EXPORT),
        (b"version https://git-lfs", "the place holder that Git LFS leaves for a large file", "run `git lfs pull`"),
        (b"<!DOCTYPE", "a web page", DOWNLOAD),
        (b"<html", "a web page", DOWNLOAD),
        (b"<?xml", "an XML file", EXPORT),
    ];
    starts.into_iter().find(|(word, ..)| start.starts_with(word)).map(|(_, what, remedy)| (what, remedy))
}

/// The format that the content shows beyond doubt: the ending it should have, what it is called, and what to do.
fn format(bytes: &[u8]) -> Option<(&'static str, &'static str, &'static str)> {
    const START: usize = 4096;
    if is_binary_stl(bytes) {
        return Some(("stl", "a binary STL file", "rename it so that it ends in .stl"));
    }
    let text = beginning(&bytes[..bytes.len().min(START)]);
    let mut lines = super::lines(&text).map(|(_, line)| line);
    let first = lines.next()?;
    let word = |line: &str| line.split_ascii_whitespace().next().unwrap_or_default().to_ascii_lowercase();
    if first == "ply" {
        return Some(("ply", "a PLY file", "rename it so that it ends in .ply"));
    }
    if off::is_header(first) {
        return Some(("off", "an OFF file", "rename it so that it ends in .off"));
    }
    let second = lines.next().unwrap_or_default();
    if word(first) == "solid" && ["facet", "endsolid", "end"].contains(&&*word(second)) {
        return Some(("stl", "an STL file", "rename it so that it ends in .stl"));
    }
    let has_point = |line: &str| word(line) == "v" && line.split_ascii_whitespace().nth(3).is_some();
    if has_point(first) || has_point(second) || lines.any(has_point) {
        return Some(("obj", "an OBJ file", "rename it so that it ends in .obj"));
    }
    None
}

fn beginning(bytes: &[u8]) -> Cow<'_, str> {
    decode(bytes).text
}

/// By its length, which follows from the number of triangles that it claims.
pub(super) fn is_binary_stl(bytes: &[u8]) -> bool {
    claimed_triangles(bytes).is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * count)
}

/// The number of triangles that a binary STL file says it has.
pub(super) fn claimed_triangles(bytes: &[u8]) -> Option<u64> {
    let field = bytes.get(80..84)?;
    Some(u32::from_le_bytes(field.try_into().ok()?).into())
}
