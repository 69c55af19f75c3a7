//! What stands before the entries of an array: a line of Python that names type, order and shape.

use super::fault::Fault;

/// The header of an array.
pub(super) struct Header {
    pub kind: Kind,
    pub is_big_endian: bool,
    /// Whether the first index runs fastest.
    pub is_fortran: bool,
    pub shape: Vec<usize>,
}

/// Numbers that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// With a sign, of so many bytes.
    Signed(usize),
    /// Without one.
    Unsigned(usize),
    /// Floating-point numbers.
    Float(usize),
}

impl Kind {
    pub fn size(self) -> usize {
        match self {
            Kind::Signed(size) | Kind::Unsigned(size) | Kind::Float(size) => size,
        }
    }
}

pub(super) const MAGIC: &[u8] = b"\x93NUMPY";
/// Longer headers than NumPy itself reads say nothing that can be used here.
const LONGEST: usize = 10_000;

impl Header {
    /// The header of an array, and the bytes behind it.
    pub fn parse(bytes: &[u8]) -> Result<(Header, &[u8]), Fault> {
        let cut_short = || Fault::new("the file ends within its header", "save the array again");
        let rest = bytes
            .strip_prefix(MAGIC)
            .ok_or_else(|| Fault::new("it does not begin as an array of NumPy does", "write it with numpy.save"))?;
        let (version, rest) = rest.split_first_chunk::<2>().ok_or_else(cut_short)?;
        let (length, rest) = match version[0] {
            1 => {
                let (length, rest) = rest.split_first_chunk::<2>().ok_or_else(cut_short)?;
                (usize::from(u16::from_le_bytes(*length)), rest)
            }
            2 | 3 => {
                let (length, rest) = rest.split_first_chunk::<4>().ok_or_else(cut_short)?;
                (u32::from_le_bytes(*length) as usize, rest)
            }
            version => {
                let reason = format!("it has version {version} of the format, and 1 to 3 are known");
                return Err(Fault::new(reason, "write it with numpy.save"));
            }
        };
        if length > LONGEST {
            let reason = format!("its header has {length} bytes, {LONGEST} are the limit");
            return Err(Fault::new(reason, "save a plain array of numbers"));
        }
        let (text, entries) = rest.split_at_checked(length).ok_or_else(cut_short)?;
        let text = str::from_utf8(text).map_err(|_| Fault::new("its header is no text", "save the array again"))?;
        let broken = || {
            let shown: String = text.trim().chars().take(80).collect();
            Fault::new(format!("its header `{shown}` cannot be read"), "write it with numpy.save")
        };
        let descr = value_of(text, "descr").ok_or_else(broken)?;
        let order = value_of(text, "fortran_order").ok_or_else(broken)?;
        let shape = value_of(text, "shape").and_then(shape).ok_or_else(broken)?;
        let (kind, is_big_endian) = kind(descr)?;
        let is_fortran = if order.starts_with("True") {
            true
        } else if order.starts_with("False") {
            false
        } else {
            return Err(broken());
        };
        Ok((Header { kind, is_big_endian, is_fortran, shape }, entries))
    }
}

/// What follows a key of the line.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let named = ['\'', '"'].into_iter().find_map(|quote| text.split_once(&format!("{quote}{key}{quote}")));
    Some(named?.1.trim_start().strip_prefix(':')?.trim_start())
}

/// A tuple of whole numbers; old versions of Python write an L behind them.
fn shape(text: &str) -> Option<Vec<usize>> {
    let (inside, _) = text.strip_prefix('(')?.split_once(')')?;
    let sides = inside.split(',').map(|side| side.trim().trim_end_matches('L')).filter(|side| !side.is_empty());
    sides.map(|side| side.parse().ok()).collect()
}

/// The type of the entries, and whether their first byte is the most significant.
fn kind(descr: &str) -> Result<(Kind, bool), Fault> {
    let quote = descr.chars().next().filter(|c| ['\'', '"'].contains(c));
    let name = quote.and_then(|quote| descr[1..].split_once(quote)).map(|(name, _)| name);
    let Some(name) = name else {
        return Err(Fault::new("its entries are records", "save a plain array of numbers, one for each column"));
    };
    let (order, rest) = match name.split_at_checked(1) {
        Some((order @ ("<" | ">" | "|" | "="), rest)) => (order, rest),
        _ => ("=", name),
    };
    let is_big = order == ">" || (order == "=" && cfg!(target_endian = "big"));
    let kind = match rest {
        "i1" | "i2" | "i4" | "i8" => Kind::Signed,
        "u1" | "u2" | "u4" | "u8" => Kind::Unsigned,
        "f4" | "f8" => Kind::Float,
        _ => {
            let (what, remedy) = match rest.chars().next() {
                Some('b' | '?') => ("truth values", "save numbers"),
                Some('O') => ("Python objects", "save a plain array of numbers, with rows of equal length"),
                Some('c') => ("complex numbers", "save real numbers"),
                Some('f') => ("floating-point numbers of an unusual size", "save it with .astype(float)"),
                Some('U' | 'S' | 'a') => ("texts", "save numbers"),
                Some('M' | 'm') => ("times", "save numbers"),
                _ => ("of a type that is not known here", "save whole numbers or floating-point numbers"),
            };
            return Err(Fault::new(format!("its entries are {what} (`{}`)", short(name)), remedy));
        }
    };
    let size = rest[1..].parse().unwrap_or(8);
    Ok((kind(size), is_big))
}

fn short(name: &str) -> String {
    name.chars().take(20).collect()
}
