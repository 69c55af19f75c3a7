//! Wavefront OBJ: `v` and `f` lines; all others are skipped.

use std::borrow::Cow;

use super::polygons::Polygons;
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::mesh::read::words::{lines, point};
use crate::text::decode;

pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    // Names in material lines may be in any encoding and do not matter.
    let text = decode(bytes).text;
    let mut positions = Vec::new();
    let mut polygons = Polygons::counted_from(1);
    let mut corners = Vec::new();
    let mut largest = (0, 0);
    let mut unread: Option<(usize, &str)> = None;
    let mut lines = lines(&text);
    while let Some((line, content)) = lines.next() {
        let keyword = content.split(|c: char| c.is_ascii_whitespace() || c == '\\').next().unwrap_or_default();
        let is_vertex = keyword.eq_ignore_ascii_case("v");
        // `fo` is the face of the first version of the format.
        if !is_vertex && !["f", "fo"].iter().any(|face| keyword.eq_ignore_ascii_case(face)) {
            if ["l", "p", "curv", "curv2", "surf"].contains(&keyword) {
                unread = unread.or(Some((line, keyword)));
            }
            continue;
        }
        // The break is a blank: `f 1 2\` and `3` are three corners. Lines of other kinds are not continued: a path of
        // Windows may end with a backslash.
        let mut content = Cow::Borrowed(content);
        while let Some(start) = content.strip_suffix('\\') {
            let next = lines.next().map_or("", |(_, next)| next);
            content = format!("{start} {next}").into();
        }
        let mut words = content.split_ascii_whitespace().skip(1);
        if is_vertex {
            positions.push(point(&mut words, line)?);
            continue;
        }
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
        polygons.add(&corners, Some(line));
    }
    if polygons.len() == 0 {
        return Err(without_faces(positions.len(), unread));
    }
    if positions.is_empty() {
        // Faces alone: a purely intrinsic mesh. So many vertices no set of faces this small can use.
        let (count, line) = largest;
        let triangles = polygons.triangle_count();
        if count > 3 * triangles {
            return Err(Problem::at(
                line,
                format!("vertex {count} is named, but {triangles} triangles have fewer corners"),
                "number the vertices from 1 without gaps, or give `v` lines",
            ));
        }
        return polygons.cut(count, None);
    }
    polygons.cut(positions.len(), Some(positions))
}

fn without_faces(vertices: usize, unread: Option<(usize, &str)>) -> Problem {
    const REMEDY: &str = "give at least one triangle, as a line `f 1 2 3`";
    let reason = "the mesh has no faces";
    match (unread, vertices) {
        (Some((line, "l" | "p")), _) => Problem::at(line, format!("{reason}, only lines or points"), REMEDY),
        (Some((line, _)), _) => {
            Problem::at(line, format!("{reason}, only free-form curves or surfaces"), "export it as polygons")
        }
        (None, 0) => Problem::new(format!("{reason}: no line begins with `v` or `f`"), REMEDY),
        (None, _) => Problem::new(format!("{reason}, only {vertices} vertices"), REMEDY),
    }
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
