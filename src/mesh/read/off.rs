//! Object File Format: counts, then one vertex per line, then one polygon per line.

use super::{Problem, Soup, index, lines, point};

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = std::str::from_utf8(bytes)
        .map_err(|_| Problem::new("the file is not text", "save it as ascii OFF; the binary form is not read"))?;
    let mut lines = lines(text).peekable();
    let (line, header) = lines.next().ok_or_else(|| Problem::new("the file is empty", "give an OFF file"))?;
    // Prefixes announce normals, colours and texture coordinates, which follow the position on its line.
    let counts = match header.split_once("OFF") {
        Some(("" | "C" | "N" | "CN" | "ST" | "STC" | "STN" | "STCN", rest)) => rest.trim(),
        _ => return Err(Problem::at(line, format!("`{header}` is not an OFF header"), "begin the file with `OFF`")),
    };
    let (line, counts) = match counts {
        "" => {
            lines.next().ok_or_else(|| Problem::at(line, "the counts are missing", "write `vertices faces edges`"))?
        }
        same_line => (line, same_line),
    };
    let mut words = counts.split_ascii_whitespace();
    let vertex_count = index(words.next(), line, "the vertex count")? as usize;
    let face_count = index(words.next(), line, "the face count")? as usize;
    // No vertex takes fewer than six bytes ("0 0 0\n"), no face fewer than two.
    if 6 * vertex_count + 2 * face_count > bytes.len() + 8 {
        return Err(Problem::at(
            line,
            format!("{vertex_count} vertices and {face_count} faces are claimed, too many for {} bytes", bytes.len()),
            "correct the counts, or restore the rest of the file",
        ));
    }
    let cut_short = |what: &str, n: usize, count: usize| {
        Problem::new(
            format!("the file ends after {n} of {count} {what}"),
            "correct the counts, or restore the rest of the file",
        )
    };
    let mut positions = Vec::with_capacity(vertex_count);
    for n in 0..vertex_count {
        let (line, content) = lines.next().ok_or_else(|| cut_short("vertices", n, vertex_count))?;
        positions.push(point(&mut content.split_ascii_whitespace(), line)?);
    }
    let mut soup = Soup { vertex_count, positions: Some(positions), ..Soup::default() };
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
        soup.add_polygon(&corners, Some(line));
    }
    Ok(soup)
}
