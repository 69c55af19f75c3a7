//! Stanford PLY: ascii, binary little endian, binary big endian.
//!
//! Reads `x`, `y`, `z` of element `vertex` and the list `vertex_indices` (or `vertex_index`) of element
//! `face`; everything else is skipped.

use glam::DVec3;

use super::{Problem, Soup};

const CUT_SHORT: &str = "correct the header's counts, or restore the rest of the file";

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, PartialEq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(word: &str) -> Option<Scalar> {
        Some(match word {
            "char" | "int8" => Scalar::I8,
            "uchar" | "uint8" => Scalar::U8,
            "short" | "int16" => Scalar::I16,
            "ushort" | "uint16" => Scalar::U16,
            "int" | "int32" => Scalar::I32,
            "uint" | "uint32" => Scalar::U32,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }
}

struct Property {
    name: String,
    /// The type of the length that precedes a list; `None` for a single value.
    list: Option<Scalar>,
    scalar: Scalar,
}

struct Element {
    name: String,
    count: u64,
    line: usize,
    properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes one of these can take: lists may be empty, ascii words have a digit and a space.
    fn least_size(&self, format: Format) -> u64 {
        let size = |p: &Property| if format == Format::Ascii { 2 } else { p.list.unwrap_or(p.scalar).size() as u64 };
        self.properties.iter().map(size).sum()
    }
}

pub(super) fn parse(bytes: &[u8]) -> Result<Soup, Problem> {
    let (format, elements, mut body) = header(bytes)?;
    let mut soup = Soup::default();
    let mut values = Vec::new();
    let (mut has_vertices, mut has_faces) = (false, false);
    for element in &elements {
        let least = element.least_size(format).max(1);
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
        let find = |names: &[&str], list: bool| {
            element.properties.iter().position(|p| names.contains(&p.name.as_str()) && p.list.is_some() == list)
        };
        let missing = |what: &str| {
            Problem::at(element.line, format!("element `{}` has no property {what}", element.name), "export it again")
        };
        match element.name.as_str() {
            "vertex" if !has_vertices => {
                has_vertices = true;
                let axis = |name: &'static str| find(&[name], false).ok_or_else(|| missing(name));
                let (x, y, z) = (axis("x")?, axis("y")?, axis("z")?);
                let mut positions = Vec::with_capacity(element.count as usize);
                for n in 0..element.count {
                    let mut p = DVec3::ZERO;
                    for (k, property) in element.properties.iter().enumerate() {
                        body.property(property, &mut values)?;
                        for (axis, at) in [x, y, z].into_iter().enumerate() {
                            if k == at {
                                p[axis] = values[0];
                            }
                        }
                    }
                    if !p.is_finite() {
                        return Err(body.problem(format!("vertex {n} has coordinates {p}, which are not finite")));
                    }
                    positions.push(p);
                }
                soup.vertex_count = positions.len();
                soup.positions = Some(positions);
            }
            "face" if !has_faces => {
                has_faces = true;
                let at = find(&["vertex_indices", "vertex_index"], true)
                    .ok_or_else(|| missing("`list … vertex_indices`"))?;
                let mut corners = Vec::new();
                for n in 0..element.count {
                    for (k, property) in element.properties.iter().enumerate() {
                        body.property(property, &mut values)?;
                        if k != at {
                            continue;
                        }
                        corners.clear();
                        for &v in &values {
                            if v.fract() != 0.0 || !(0.0..4294967295.0).contains(&v) {
                                return Err(body.problem(format!("face {n} names vertex {v}, which cannot be")));
                            }
                            corners.push(v as u32);
                        }
                        if corners.len() < 3 {
                            return Err(body.problem(format!("face {n} has {} corners", corners.len())));
                        }
                    }
                    soup.add_polygon(&corners, body.line());
                }
            }
            _ => {
                for _ in 0..element.count {
                    for property in &element.properties {
                        body.property(property, &mut values)?;
                    }
                }
            }
        }
    }
    match (has_vertices, has_faces) {
        (true, true) => Ok(soup),
        (false, _) => Err(Problem::new("the header names no element `vertex`", "export it again")),
        _ => Err(Problem::new("the header names no element `face`", "export it again with faces")),
    }
}

fn header(bytes: &[u8]) -> Result<(Format, Vec<Element>, Body<'_>), Problem> {
    let mut format = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut rest = bytes;
    let mut line = 0;
    loop {
        line += 1;
        let Some(end) = rest.iter().position(|&b| b == b'\n') else {
            return Err(Problem::at(line, "the header has no `end_header`", "give a PLY file"));
        };
        let content = String::from_utf8_lossy(&rest[..end]);
        rest = &rest[end + 1..];
        let words: Vec<&str> = content.split_ascii_whitespace().collect();
        let malformed = || Problem::at(line, format!("`{}` is not understood", content.trim()), "export it again");
        match words.as_slice() {
            ["ply"] if line == 1 => {}
            _ if line == 1 => return Err(Problem::at(1, "the file does not begin with `ply`", "give a PLY file")),
            [] | ["comment" | "obj_info", ..] => {}
            ["format", "ascii", _] => format = Some(Format::Ascii),
            ["format", "binary_little_endian", _] => format = Some(Format::LittleEndian),
            ["format", "binary_big_endian", _] => format = Some(Format::BigEndian),
            ["element", name, count] => elements.push(Element {
                name: (*name).into(),
                count: count.parse().map_err(|_| malformed())?,
                line,
                properties: Vec::new(),
            }),
            ["property", kind @ .., name] => {
                let scalar = |word: &str| Scalar::named(word).ok_or_else(malformed);
                let (list, scalar) = match kind {
                    [kind] => (None, scalar(kind)?),
                    ["list", length, kind] => (Some(scalar(length)?), scalar(kind)?),
                    _ => return Err(malformed()),
                };
                let element = elements.last_mut().ok_or_else(malformed)?;
                element.properties.push(Property { name: (*name).into(), list, scalar });
            }
            ["end_header"] => break,
            _ => return Err(malformed()),
        }
    }
    let format = format.ok_or_else(|| Problem::new("the header has no `format` line", "export it again"))?;
    Ok((format, elements, Body { format, bytes: rest, line: line + 1 }))
}

/// What follows the header; values are taken off its front.
struct Body<'a> {
    format: Format,
    bytes: &'a [u8],
    line: usize,
}

impl Body<'_> {
    fn line(&self) -> Option<usize> {
        (self.format == Format::Ascii).then_some(self.line)
    }

    fn problem(&self, reason: String) -> Problem {
        Problem { line: self.line(), reason, remedy: "correct it, or export the file again" }
    }

    fn cut_short(&self) -> Problem {
        Problem { line: self.line(), reason: "the file ends too early".into(), remedy: CUT_SHORT }
    }

    /// Reads one property into `values`: a single number, or all of a list.
    fn property(&mut self, property: &Property, values: &mut Vec<f64>) -> Result<(), Problem> {
        values.clear();
        let length = match property.list {
            None => 1,
            Some(kind) => {
                let length = self.value(kind)?;
                let least = if self.format == Format::Ascii { 2 } else { property.scalar.size() };
                let most = ((self.bytes.len() + 1) / least) as f64;
                if length.fract() != 0.0 || !(0.0..=most).contains(&length) {
                    return Err(
                        self.problem(format!("a list claims {length} values, but the file ends before that many"))
                    );
                }
                length as usize
            }
        };
        for _ in 0..length {
            values.push(self.value(property.scalar)?);
        }
        Ok(())
    }

    fn value(&mut self, kind: Scalar) -> Result<f64, Problem> {
        if self.format == Format::Ascii {
            return self.word();
        }
        let size = kind.size();
        let Some((taken, rest)) = self.bytes.split_at_checked(size) else {
            return Err(self.cut_short());
        };
        self.bytes = rest;
        let mut b = [0; 8];
        b[..size].copy_from_slice(taken);
        if self.format == Format::BigEndian {
            b[..size].reverse();
        }
        Ok(match kind {
            Scalar::I8 => f64::from(b[0] as i8),
            Scalar::U8 => f64::from(b[0]),
            Scalar::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Scalar::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Scalar::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Scalar::F64 => f64::from_le_bytes(b),
        })
    }

    fn word(&mut self) -> Result<f64, Problem> {
        let blanks = self.bytes.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.line += self.bytes[..blanks].iter().filter(|&&b| b == b'\n').count();
        self.bytes = &self.bytes[blanks..];
        let end = self.bytes.iter().position(|b| b.is_ascii_whitespace()).unwrap_or(self.bytes.len());
        let (word, rest) = self.bytes.split_at(end);
        if word.is_empty() {
            return Err(self.cut_short());
        }
        self.bytes = rest;
        let word = String::from_utf8_lossy(word);
        word.parse().map_err(|_| self.problem(format!("`{word}` is not a number")))
    }
}
