//! STL, ascii and binary. Corners with exactly equal coordinates are one vertex.

use std::collections::HashMap;

use glam::DVec3;

use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::mesh::read::words::point;
use crate::text::decode;

pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    // A binary file may begin with "solid". Its length tells, or else a zero among its first bytes: the count of
    // triangles has one, unless there are sixteen millions of them.
    if is_binary(bytes) {
        return binary(bytes);
    }
    let start = decode(&bytes[..bytes.len().min(START)]);
    if start.is_text() {
        return ascii(bytes);
    }
    match claimed_triangles(bytes) {
        Some(count) if count > 0 && bytes.len() as u64 > size(count) => binary(bytes),
        Some(count) => Err(Problem::new(
            format!("{count} triangles are claimed, which takes {} bytes, not {}", size(count), bytes.len()),
            "restore the rest of the file",
        )),
        None => Err(Problem::new("this is neither an ascii nor a binary STL file", "export it again")),
    }
}

/// Whether these bytes are a binary STL file, by their length, which follows from the number of triangles that it claims.
pub(crate) fn is_binary(bytes: &[u8]) -> bool {
    claimed_triangles(bytes).is_some_and(|count| count > 0 && bytes.len() as u64 == size(count))
}

/// The bytes that a binary STL file of so many triangles takes.
fn size(count: u64) -> u64 {
    HEADER as u64 + RECORD as u64 * count
}

/// The number of triangles that a binary STL file says it has.
fn claimed_triangles(bytes: &[u8]) -> Option<u64> {
    let field = bytes.get(80..84)?;
    Some(u32::from_le_bytes(field.try_into().ok()?).into())
}

/// Bytes before the first triangle of a binary file: 80 of any kind, and the count of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle in a binary file.
const RECORD: usize = 50;

/// As much of a file as shows whether it is a text.
const START: usize = 1024;

/// Numbers points in the order in which they first appear.
#[derive(Default)]
struct Merged {
    numbers: HashMap<[u64; 3], u32>,
    positions: Vec<DVec3>,
}

impl Merged {
    fn vertex(&mut self, p: DVec3) -> Result<u32, Problem> {
        // Adding zero turns -0 into +0.
        let key = p.to_array().map(|x| (x + 0.0).to_bits());
        if let Some(&known) = self.numbers.get(&key) {
            return Ok(known);
        }
        let number = u32::try_from(self.positions.len());
        let number =
            number.map_err(|_| Problem::new("the file has too many different points", "use a coarser mesh"))?;
        self.positions.push(p);
        self.numbers.insert(key, number);
        Ok(number)
    }

    fn soup(self, triangles: Vec<[u32; 3]>, lines: Vec<usize>) -> Soup {
        Soup {
            vertex_count: self.positions.len(),
            positions: Some(self.positions),
            triangles,
            lines,
            ..Soup::default()
        }
    }
}

fn binary(bytes: &[u8]) -> Result<Soup, Problem> {
    let mut merged = Merged::default();
    let count = claimed_triangles(bytes).unwrap_or_default() as usize;
    let records = &bytes[HEADER..];
    let mut triangles = Vec::with_capacity(count);
    for (n, record) in records.chunks_exact(RECORD).take(count).enumerate() {
        let mut triangle = [0; 3];
        for (k, corner) in triangle.iter_mut().enumerate() {
            let coordinate = |axis: usize| {
                let at = 12 + 12 * k + 4 * axis;
                f64::from(f32::from_le_bytes([record[at], record[at + 1], record[at + 2], record[at + 3]]))
            };
            let p = DVec3::new(coordinate(0), coordinate(1), coordinate(2));
            if !p.is_finite() {
                return Err(Problem::new(
                    format!("corner {k} of triangle {n} has coordinates {p}, which are not finite"),
                    "every number must be finite",
                ));
            }
            *corner = merged.vertex(p)?;
        }
        triangles.push(triangle);
    }
    let mut soup = merged.soup(triangles, Vec::new());
    let trailing = records.len() - RECORD * count;
    if trailing > 0 {
        let bytes = if trailing == 1 { "byte" } else { "bytes" };
        soup.notes.push(format!("ignored {trailing} {bytes} after the {count} triangles that the file claims to have"));
    }
    Ok(soup)
}

/// Keywords stand in any case, and one or several on a line; some programs write `end loop` for `endloop`.
fn ascii(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = decode(bytes).text;
    let mut merged = Merged::default();
    let (mut triangles, mut face_lines) = (Vec::new(), Vec::new());
    let mut corners = Vec::new();
    let mut facet = None;
    let mut begun = false;
    for (line, content) in (1..).zip(text.lines()) {
        // Comments are a habit from elsewhere, and `1.#IND` a number that is none.
        if content.trim_start().starts_with('#') {
            continue;
        }
        let mut words = content.split_ascii_whitespace();
        while let Some(word) = words.next() {
            let mut keyword = word.to_ascii_lowercase();
            if keyword == "end" {
                keyword.extend(words.next().map(str::to_ascii_lowercase));
            }
            match keyword.as_str() {
                // What follows is a name.
                "solid" | "endsolid" => words.by_ref().for_each(drop),
                "facet" => {
                    if let Some(start) = facet.replace(line) {
                        return Err(unfinished(start));
                    }
                    corners.clear();
                }
                // Whatever it says, normals follow from the corners.
                "normal" => words.by_ref().take(3).for_each(drop),
                "vertex" => corners.push(merged.vertex(point(&mut words, line)?)?),
                "endfacet" => match (corners.as_slice(), facet.take()) {
                    (&[a, b, c], Some(start)) => {
                        triangles.push([a, b, c]);
                        face_lines.push(start);
                    }
                    _ => {
                        return Err(Problem::at(
                            line,
                            format!("a facet with {} vertices ends here", corners.len()),
                            "a facet has exactly three",
                        ));
                    }
                },
                "outer" | "loop" | "endloop" => {}
                _ if !begun => {
                    let reason = format!("this is a text that begins with `{word}`, and an STL file with `solid`");
                    return Err(Problem::at(line, reason, "give an STL file, or correct the file's ending"));
                }
                _ => {
                    return Err(Problem::at(line, format!("`{word}` is no STL keyword"), "correct or remove the line"));
                }
            }
            begun = true;
        }
    }
    match facet {
        Some(line) => Err(unfinished(line)),
        None => Ok(merged.soup(triangles, face_lines)),
    }
}

fn unfinished(line: usize) -> Problem {
    Problem::at(line, "this facet does not end", "restore the rest of the file")
}
