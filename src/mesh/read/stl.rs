//! STL, ascii and binary. Corners with exactly equal coordinates are one vertex.

use std::collections::HashMap;

use glam::DVec3;

use super::{Problem, Soup, lines, point};

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    // The length tells binary from ascii; the first word does not, since binary headers may say "solid".
    match claimed_triangles(bytes) {
        Some(count) if bytes.len() as u64 == 84 + 50 * count => binary(&bytes[84..]),
        _ if bytes.trim_ascii_start().starts_with(b"solid") => ascii(bytes),
        Some(count) => Err(Problem::new(
            format!("{count} triangles are claimed, which takes {} bytes, not {}", 84 + 50 * count, bytes.len()),
            "restore the rest of the file",
        )),
        None => Err(Problem::new("this is neither an ascii nor a binary STL file", "export it again")),
    }
}

fn claimed_triangles(bytes: &[u8]) -> Option<u64> {
    let field = bytes.get(80..84)?;
    Some(u32::from_le_bytes(field.try_into().ok()?).into())
}

/// Numbers points in the order in which they first appear.
#[derive(Default)]
struct Merged {
    numbers: HashMap<[u64; 3], u32>,
    positions: Vec<DVec3>,
}

impl Merged {
    fn vertex(&mut self, p: DVec3) -> u32 {
        // Adding zero turns -0 into +0.
        let key = p.to_array().map(|x| (x + 0.0).to_bits());
        *self.numbers.entry(key).or_insert_with(|| {
            self.positions.push(p);
            self.positions.len() as u32 - 1
        })
    }

    fn soup(self, triangles: Vec<[u32; 3]>, lines: Vec<usize>) -> Soup {
        Soup {
            vertex_count: self.positions.len(),
            positions: Some(self.positions),
            triangles,
            lines,
            polygons: Vec::new(),
        }
    }
}

fn binary(records: &[u8]) -> Result<Soup, Problem> {
    let mut merged = Merged::default();
    let mut triangles = Vec::with_capacity(records.len() / 50);
    for (n, record) in records.chunks_exact(50).enumerate() {
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
            *corner = merged.vertex(p);
        }
        triangles.push(triangle);
    }
    Ok(merged.soup(triangles, Vec::new()))
}

fn ascii(bytes: &[u8]) -> Result<Soup, Problem> {
    let text = String::from_utf8_lossy(bytes);
    let mut merged = Merged::default();
    let (mut triangles, mut face_lines) = (Vec::new(), Vec::new());
    let mut corners = Vec::new();
    let mut facet = None;
    for (line, content) in lines(&text) {
        let mut words = content.split_ascii_whitespace();
        match words.next() {
            Some("facet") => {
                facet = Some(line);
                corners.clear();
            }
            Some("vertex") => corners.push(merged.vertex(point(&mut words, line)?)),
            Some("endfacet") => match (corners.as_slice(), facet.take()) {
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
            Some("solid" | "outer" | "endloop" | "endsolid") => {}
            Some(word) => {
                return Err(Problem::at(line, format!("`{word}` is no STL keyword"), "correct or remove the line"));
            }
            None => {}
        }
    }
    match facet {
        Some(line) => Err(Problem::at(line, "this facet does not end", "restore the rest of the file")),
        None => Ok(merged.soup(triangles, face_lines)),
    }
}
