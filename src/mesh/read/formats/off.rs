//! Object File Format: counts, then one vertex per line, then one polygon per line.

use glam::DVec3;

use super::polygons::Polygons;
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::mesh::read::words::{index, lines, number, point};
use crate::text::decode;

pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = decode(bytes);
    let mut lines = lines(&text.text).peekable();
    let (mut line, first) = lines.next().ok_or_else(|| Problem::new("the file is empty", "give an OFF file"))?;
    let (header, mut counts) = Header::parse(first, line)?;
    if !text.is_text() {
        return Err(Problem::new("the file is not text", BINARY));
    }
    if counts.is_empty() {
        (line, counts) =
            lines.next().ok_or_else(|| Problem::at(line, "the counts are missing", "write `vertices faces edges`"))?;
    }
    let mut words = counts.split_ascii_whitespace();
    let vertex_count = index(words.next(), line, "the vertex count")?;
    let face_count = index(words.next(), line, "the face count")?;
    // No vertex takes fewer than six bytes ("0 0 0\n"), no face fewer than two.
    if 6 * u64::from(vertex_count) + 2 * u64::from(face_count) > text.text.len() as u64 + 8 {
        let reason =
            format!("{vertex_count} vertices and {face_count} faces are claimed, too many for {} bytes", bytes.len());
        return Err(Problem::at(line, reason, "correct the counts, or restore the rest of the file"));
    }
    let (vertex_count, face_count) = (vertex_count as usize, face_count as usize);
    let cut_short = |what: &str, n: usize, count: usize| {
        Problem::new(
            format!("the file ends after {n} of {count} {what}"),
            "correct the counts, or restore the rest of the file",
        )
    };
    let mut positions = Vec::with_capacity(vertex_count);
    for n in 0..vertex_count {
        let (line, content) = lines.next().ok_or_else(|| cut_short("vertices", n, vertex_count))?;
        positions.push(header.position(content, line)?);
    }
    let mut polygons = Polygons::default();
    let mut corners = Vec::new();
    for n in 0..face_count {
        let (line, content) = lines.next().ok_or_else(|| cut_short("faces", n, face_count))?;
        let mut words = content.split_ascii_whitespace();
        let sides = index(words.next(), line, "the number of corners")?;
        if sides < 3 {
            return Err(Problem::at(
                line,
                format!("a face with {sides} corners"),
                "give it three or more, or remove it",
            ));
        }
        corners.clear();
        for _ in 0..sides {
            corners.push(index(words.next(), line, "a corner")?);
        }
        polygons.add(&corners, Some(line));
    }
    polygons.cut(vertex_count, Some(positions))
}

const BINARY: &str = "save it as ascii OFF; the binary form is not read";

/// Whether a line begins an OFF file.
pub(in crate::mesh::read) fn is_header(line: &str) -> bool {
    split_header(line).is_some()
}

/// What stands before and after the word `OFF`, which programs write in any case; `None` if it is no such line. Some
/// write the counts right after it, without a blank.
fn split_header(line: &str) -> Option<(&str, &str)> {
    let at = line.to_ascii_uppercase().find("OFF")?;
    let (before, rest) = (line.get(..at)?, line.get(at + 3..)?);
    let ends = rest.starts_with(|c: char| c.is_ascii_whitespace() || c.is_ascii_digit()) || rest.is_empty();
    let known = is_many_dimensional(before) || {
        // Normals, colours and texture coordinates, each once and in any order.
        let mut parts = before.to_ascii_uppercase();
        for part in ["ST", "C", "N", "4"] {
            parts = parts.replacen(part, "", 1);
        }
        parts.is_empty()
    };
    (ends && known).then_some((before, rest.trim()))
}

/// `nOFF`, whose small letter is not that of normals.
fn is_many_dimensional(before: &str) -> bool {
    before.ends_with('n')
        && !before.chars().any(|c| c.is_ascii_lowercase() && c != 'n')
        && before.trim_end_matches('n').chars().all(|c| "STCN4".contains(c))
}

/// What the first word announces of the vertices; normals, colours and texture coordinates follow the position.
struct Header {
    /// There is a fourth coordinate, by which the others are divided.
    homogeneous: bool,
}

impl Header {
    /// The header and what follows it on its line.
    fn parse(first: &str, line: usize) -> Result<(Header, &str), Problem> {
        let Some((before, rest)) = split_header(first) else {
            // The keyword may be left out; then the counts come first.
            return match first.split_ascii_whitespace().all(|word| word.parse::<u32>().is_ok()) {
                true => Ok((Header { homogeneous: false }, first)),
                false => Err(Problem::at(line, format!("`{first}` is not an OFF header"), "begin the file with `OFF`")),
            };
        };
        if is_many_dimensional(before) {
            let reason = format!("`{before}OFF` has vertices in a space of any dimension");
            return Err(Problem::at(line, reason, "export the surface in space, as `OFF`"));
        }
        if rest.to_ascii_uppercase().starts_with("BINARY") {
            return Err(Problem::at(line, "the file is in the binary form of OFF", BINARY));
        }
        Ok((Header { homogeneous: before.contains('4') }, rest))
    }

    fn position(&self, content: &str, line: usize) -> Result<DVec3, Problem> {
        let mut words = content.split_ascii_whitespace();
        let p = point(&mut words, line)?;
        if !self.homogeneous {
            return Ok(p);
        }
        let w = number(words.next(), line, "the fourth coordinate")?;
        match p / w {
            p if p.is_finite() => Ok(p),
            _ => Err(Problem::at(line, "the fourth coordinate is 0, so the vertex is infinitely far", "give another")),
        }
    }
}
