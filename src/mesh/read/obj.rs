//! Wavefront OBJ: `v` and `f` lines; all others are skipped.

use super::{Problem, Soup, lines, point};

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    // Names in material lines may be in any encoding and do not matter.
    let text = String::from_utf8_lossy(bytes);
    let mut positions = Vec::new();
    let mut soup = Soup::default();
    let mut corners = Vec::new();
    let mut largest = (0, 0);
    for (line, content) in lines(&text) {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("v") => positions.push(point(&mut words, line)?),
            Some("f") => {
                corners.clear();
                for word in words {
                    let vertex = corner(word, line, positions.len())?;
                    largest = largest.max((vertex as usize + 1, line));
                    corners.push(vertex);
                }
                if corners.len() < 3 {
                    return Err(Problem::at(
                        line,
                        format!("a face with {} corners", corners.len()),
                        "give it three or more, or remove it",
                    ));
                }
                soup.add_polygon(&corners, Some(line));
            }
            _ => {}
        }
    }
    if positions.is_empty() {
        // Faces alone: a purely intrinsic mesh. So many vertices no set of faces this small can use.
        let (count, line) = largest;
        if count > 3 * soup.triangles.len() {
            return Err(Problem::at(
                line,
                format!("vertex {count} is named, but {} triangles have fewer corners", soup.triangles.len()),
                "number the vertices from 1 without gaps, or give `v` lines",
            ));
        }
        soup.vertex_count = count;
    } else {
        soup.vertex_count = positions.len();
        soup.positions = Some(positions);
    }
    Ok(soup)
}

/// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0. Negative numbers count back
/// from the last vertex before this line.
fn corner(word: &str, line: usize, vertices_so_far: usize) -> Result<u32, Problem> {
    let vertex = word.split('/').next().unwrap_or("");
    let wrong = |why: &str| {
        Problem::at(
            line,
            format!("vertex `{word}` {why}"),
            "indices count from 1, or from -1 backwards through the vertices above the line",
        )
    };
    let number: i64 = vertex.parse().map_err(|_| wrong("is not a whole number"))?;
    let index = match number {
        0 => return Err(wrong("does not exist")),
        1.. => number - 1,
        _ => vertices_so_far as i64 + number,
    };
    u32::try_from(index).map_err(|_| wrong("does not exist"))
}
