//! Stanford PLY: ascii, binary little endian, binary big endian.
//!
//! Reads `x`, `y`, `z` of element `vertex`, and the list `vertex_indices` (or `vertex_index`) of element `face` or of
//! element `tristrips`; everything else is skipped.

use glam::DVec3;

use super::ply_header::{Element, Encoding, Header, Property, Scalar};
use super::polygons::Polygons;
use crate::mesh::read::problem::Problem;
use crate::mesh::read::soup::Soup;
use crate::mesh::read::words::parse_number;
use crate::text::{decode, without_mark};

const CUT_SHORT: &str = "correct the header's counts, or restore the rest of the file";

pub(in crate::mesh::read) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let bytes = without_mark(bytes);
    // Numbers that are written out are a text like any other, in any encoding; a binary file is none.
    let text;
    let header = match Header::parse(bytes) {
        Ok(header) if header.encoding != Encoding::Ascii => header,
        otherwise => {
            text = decode(bytes);
            if !text.is_text() {
                return otherwise.and(Err(Problem::new("the file is not text, as its header says", "export it again")));
            }
            Header::parse(text.text.as_bytes())?
        }
    };
    let mut body = Body { encoding: header.encoding, bytes: header.body, line: header.body_line };
    let mut positions = None;
    let mut polygons = None;
    for element in &header.elements {
        let least = element.least_size(body.encoding).max(1);
        // One byte of grace for a last line without its end.
        if element.count > (body.bytes.len() as u64 + 1) / least {
            return Err(Problem::at(
                element.line,
                format!(
                    "{} of element `{}` are claimed, too many for the {} bytes that are left",
                    element.count,
                    element.name,
                    body.bytes.len()
                ),
                CUT_SHORT,
            ));
        }
        match element.name.as_str() {
            "vertex" if positions.is_none() => positions = Some(vertices(element, &mut body)?),
            "face" => faces(element, &mut body, polygons.get_or_insert_default())?,
            "tristrips" => strips(element, &mut body, polygons.get_or_insert_default())?,
            _ => {
                for _ in 0..element.count {
                    element.properties.iter().try_for_each(|property| body.skip(property))?;
                }
            }
        }
    }
    let positions = positions.ok_or_else(|| Problem::new("the header names no element `vertex`", "export it again"))?;
    let polygons: Polygons =
        polygons.ok_or_else(|| Problem::new("the header names no element `face`", "export it again with faces"))?;
    polygons.cut(positions.len(), Some(positions))
}

fn vertices(element: &Element, body: &mut Body) -> Result<Vec<DVec3>, Problem> {
    let axis = |name: &'static str| element.find(&[name], false, name);
    let axes = [axis("x")?, axis("y")?, axis("z")?];
    let mut positions = Vec::with_capacity(element.count as usize);
    for n in 0..element.count {
        let mut p = DVec3::ZERO;
        for (k, property) in element.properties.iter().enumerate() {
            match axes.iter().position(|&axis| axis == k) {
                Some(axis) => p[axis] = body.value(property.scalar)?,
                None => body.skip(property)?,
            }
        }
        if !p.is_finite() {
            return Err(body.problem(format!("vertex {n} has coordinates {p}, which are not finite")));
        }
        positions.push(p);
    }
    Ok(positions)
}

fn faces(element: &Element, body: &mut Body, polygons: &mut Polygons) -> Result<(), Problem> {
    let mut corners = Vec::new();
    for_each_list(element, body, |body, n, line, values| {
        corners.clear();
        for &v in values {
            corners.push(body.corner(v, || format!("face {n}"))?);
        }
        if corners.len() < 3 {
            return Err(body.problem(format!("face {n} has {} corners", corners.len())));
        }
        polygons.add(&corners, line);
        Ok(())
    })
}

/// Strips of triangles: every number after the first two is one with the two numbers before it, every other one turned
/// round. A negative number ends a strip; two equal numbers make no triangle and lead on to the next.
fn strips(element: &Element, body: &mut Body, polygons: &mut Polygons) -> Result<(), Problem> {
    for_each_list(element, body, |body, n, line, values| {
        for strip in values.split(|&v| v < 0.0) {
            for (k, triple) in strip.windows(3).enumerate() {
                let mut triangle = [0; 3];
                for (corner, &v) in triangle.iter_mut().zip(triple) {
                    *corner = body.corner(v, || format!("strip {n}"))?;
                }
                let [a, b, c] = triangle;
                if a != b && b != c && c != a {
                    polygons.add(&if k % 2 == 0 { [a, b, c] } else { [b, a, c] }, line);
                }
            }
        }
        Ok(())
    })
}

/// Reads the list of corners of every item of an element, and passes over its other properties. What is done with a
/// list is told the number of the item and the line on which the item begins.
fn for_each_list(
    element: &Element,
    body: &mut Body,
    mut with: impl FnMut(&Body, u64, Option<usize>, &[f64]) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let at = element.find(&["vertex_indices", "vertex_index"], true, "`list … vertex_indices`")?;
    let mut values = Vec::new();
    for n in 0..element.count {
        let line = body.next_line();
        for (k, property) in element.properties.iter().enumerate() {
            if k == at {
                body.list(property, &mut values)?;
                with(body, n, line, &values)?;
            } else {
                body.skip(property)?;
            }
        }
    }
    Ok(())
}

/// What follows the header; values are taken off its front.
struct Body<'a> {
    encoding: Encoding,
    bytes: &'a [u8],
    line: usize,
}

impl<'a> Body<'a> {
    fn line(&self) -> Option<usize> {
        (self.encoding == Encoding::Ascii).then_some(self.line)
    }

    fn problem(&self, reason: String) -> Problem {
        Problem { line: self.line(), reason, remedy: "correct it, or export the file again".into() }
    }

    fn cut_short(&self) -> Problem {
        Problem { line: self.line(), reason: "the file ends too early".into(), remedy: CUT_SHORT.into() }
    }

    /// A number as that of a vertex.
    fn corner(&self, v: f64, of: impl Fn() -> String) -> Result<u32, Problem> {
        if v.fract() == 0.0 && (0.0..4294967295.0).contains(&v) {
            Ok(v as u32)
        } else {
            Err(self.problem(format!("{} names vertex {v}, which cannot be", of())))
        }
    }

    /// How many values a property has.
    fn length(&mut self, property: &Property) -> Result<usize, Problem> {
        let Some(kind) = property.list else { return Ok(1) };
        let length = self.value(kind)?;
        let least = if self.encoding == Encoding::Ascii { 2 } else { property.scalar.size() };
        let most = ((self.bytes.len() + 1) / least) as f64;
        if length.fract() != 0.0 || !(0.0..=most).contains(&length) {
            return Err(self.problem(format!("a list claims {length} values, but the file ends before that many")));
        }
        Ok(length as usize)
    }

    fn list(&mut self, property: &Property, values: &mut Vec<f64>) -> Result<(), Problem> {
        values.clear();
        for _ in 0..self.length(property)? {
            values.push(self.value(property.scalar)?);
        }
        Ok(())
    }

    /// Passes over a property; what its words say does not matter.
    fn skip(&mut self, property: &Property) -> Result<(), Problem> {
        for _ in 0..self.length(property)? {
            match self.encoding {
                Encoding::Ascii => drop(self.word()?),
                _ => drop(self.value(property.scalar)?),
            }
        }
        Ok(())
    }

    fn value(&mut self, kind: Scalar) -> Result<f64, Problem> {
        if self.encoding == Encoding::Ascii {
            let word = self.word()?;
            return parse_number(word).ok_or_else(|| self.problem(format!("`{word}` is not a number")));
        }
        let size = kind.size();
        let Some((taken, rest)) = self.bytes.split_at_checked(size) else {
            return Err(self.cut_short());
        };
        self.bytes = rest;
        let mut b = [0; 8];
        b[..size].copy_from_slice(taken);
        if self.encoding == Encoding::BigEndian {
            b[..size].reverse();
        }
        Ok(match kind {
            Scalar::I8 => f64::from(b[0] as i8),
            Scalar::U8 => f64::from(b[0]),
            Scalar::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Scalar::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Scalar::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::I64 => i64::from_le_bytes(b) as f64,
            Scalar::U64 => u64::from_le_bytes(b) as f64,
            Scalar::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::F64 => f64::from_le_bytes(b),
        })
    }

    fn word(&mut self) -> Result<&'a str, Problem> {
        self.pass_blanks();
        let end = self.bytes.iter().position(|b| b.is_ascii_whitespace()).unwrap_or(self.bytes.len());
        let (word, rest) = self.bytes.split_at(end);
        if word.is_empty() {
            return Err(self.cut_short());
        }
        self.bytes = rest;
        std::str::from_utf8(word).map_err(|_| self.problem("this is not text".into()))
    }

    fn pass_blanks(&mut self) {
        let blanks = self.bytes.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.line += self.bytes[..blanks].iter().filter(|&&b| b == b'\n').count();
        self.bytes = &self.bytes[blanks..];
    }

    /// The line of the next word, where there are lines.
    fn next_line(&mut self) -> Option<usize> {
        (self.encoding == Encoding::Ascii).then(|| {
            self.pass_blanks();
            self.line
        })
    }
}
