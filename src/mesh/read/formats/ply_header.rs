//! The header of a PLY file.

use crate::mesh::read::problem::Problem;

/// The most lines of a header, of which even those with many comments have some hundred.
const MOST_LINES: usize = 10_000;

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
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
            "long" | "int64" => Scalar::I64,
            "ulong" | "uint64" => Scalar::U64,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }

    pub fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::I64 | Scalar::U64 | Scalar::F64 => 8,
        }
    }
}

pub(super) struct Property {
    pub name: String,
    /// The type of the length that precedes a list; `None` for a single value.
    pub list: Option<Scalar>,
    pub scalar: Scalar,
}

pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub line: usize,
    pub properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes one of these can take: lists may be empty, ascii words have a digit and a space.
    pub fn least_size(&self, encoding: Encoding) -> u64 {
        let size =
            |p: &Property| if encoding == Encoding::Ascii { 2 } else { p.list.unwrap_or(p.scalar).size() as u64 };
        self.properties.iter().map(size).sum()
    }

    /// The place among the properties of a list or a single value of one of these names.
    pub fn find(&self, names: &[&str], list: bool, what: &str) -> Result<usize, Problem> {
        let at = self.properties.iter().position(|p| names.contains(&p.name.as_str()) && p.list.is_some() == list);
        let missing = || format!("element `{}` has no property {what}", self.name);
        at.ok_or_else(|| Problem::at(self.line, missing(), "export it again"))
    }
}

pub(super) struct Header<'a> {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// What follows, and the number of its first line.
    pub body: &'a [u8],
    pub body_line: usize,
}

impl Header<'_> {
    pub fn parse(bytes: &[u8]) -> Result<Header<'_>, Problem> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut rest = bytes;
        // A byte of the body that looks like the second half of a line's end belongs to it only if all lines end so.
        let old_mac = bytes.iter().position(|b| b"\r\n".contains(b)).is_some_and(|at| is_lone_return(&bytes[at..]));
        let mut line = 0;
        loop {
            line += 1;
            if line > MOST_LINES {
                let reason = format!("the header has more than {MOST_LINES} lines");
                return Err(Problem::at(line, reason, "remove what is not about vertices and faces"));
            }
            let Some(end) = rest.iter().position(|&b| b == b'\n' || (old_mac && b == b'\r')) else {
                return Err(Problem::at(line, "the header has no `end_header`", "give a PLY file"));
            };
            let content = String::from_utf8_lossy(&rest[..end]);
            rest = &rest[end + 1..];
            let words: Vec<&str> = content.split_ascii_whitespace().collect();
            let malformed = || Problem::at(line, format!("`{}` is not understood", content.trim()), "export it again");
            match words.as_slice() {
                ["ply"] if line == 1 => {}
                _ if line == 1 => {
                    return Err(Problem::at(1, "the file does not begin with `ply`", "give a PLY file"));
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["format", "ascii", _] => encoding = Some(Encoding::Ascii),
                ["format", "binary_little_endian", _] => encoding = Some(Encoding::LittleEndian),
                ["format", "binary_big_endian", _] => encoding = Some(Encoding::BigEndian),
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
        let encoding = encoding.ok_or_else(|| Problem::new("the header has no `format` line", "export it again"))?;
        Ok(Header { encoding, elements, body: rest, body_line: line + 1 })
    }
}

fn is_lone_return(end: &[u8]) -> bool {
    end.first() == Some(&b'\r') && end.get(1) != Some(&b'\n')
}
