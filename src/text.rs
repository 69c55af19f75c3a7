//! From bytes to text, for everything that people write and save with other programs: scenes, tables and meshes. And
//! from numbers to text, as people read them.

use std::borrow::Cow;

/// The text of a file.
pub struct Text<'a> {
    /// Without byte order mark; every line ends with `\n`, whatever it ended with. What is no text is U+FFFD.
    pub text: Cow<'a, str>,
    /// The first line, counted from 1, that holds something that is no text.
    pub first_broken_line: Option<usize>,
}

impl Text<'_> {
    /// Whether it may be read as a text; bytes of another kind have zeros in them.
    pub fn is_text(&self) -> bool {
        !self.text.contains('\0')
    }
}

/// Decodes UTF-8 and UTF-16, with a byte order mark or without. Lines may end as on Unix, on Windows (`\r\n`) or as on
/// old Macs (`\r`).
pub fn decode(bytes: &[u8]) -> Text<'_> {
    let text = match Encoding::of(bytes) {
        Encoding::Utf8 => String::from_utf8_lossy(without_mark(bytes)),
        Encoding::Utf16(unit) => {
            let units = bytes.chunks(2).map(|pair| unit([pair[0], *pair.get(1).unwrap_or(&0)]));
            let text: String = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
            match text.strip_prefix(MARK) {
                Some(rest) => rest.to_owned().into(),
                None => text.into(),
            }
        }
    };
    let text = with_unix_lines(text);
    // A file may hold the replacement character itself, which is a text as any other.
    let broken = text.find(char::REPLACEMENT_CHARACTER).filter(|_| std::str::from_utf8(bytes).is_err());
    let first_broken_line = broken.map(|at| text[..at].matches('\n').count() + 1);
    Text { text, first_broken_line }
}

/// A text without the byte order mark that it may begin with.
pub fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes)
}

const MARK: char = '\u{feff}';

enum Encoding {
    Utf8,
    Utf16(fn([u8; 2]) -> u16),
}

impl Encoding {
    /// By the mark, or by the zeros that Western text has in every other byte.
    fn of(bytes: &[u8]) -> Encoding {
        match *bytes {
            [0xff, 0xfe, ..] => Encoding::Utf16(u16::from_le_bytes),
            [0xfe, 0xff, ..] => Encoding::Utf16(u16::from_be_bytes),
            [a, 0, b, 0, ..] if a != 0 && b != 0 => Encoding::Utf16(u16::from_le_bytes),
            [0, a, 0, b, ..] if a != 0 && b != 0 => Encoding::Utf16(u16::from_be_bytes),
            _ => Encoding::Utf8,
        }
    }
}

fn with_unix_lines(text: Cow<'_, str>) -> Cow<'_, str> {
    if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text }
}

/// A text as far as a message shows it.
pub fn clipped(text: &str) -> Cow<'_, str> {
    const SHOWN: usize = 80;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]).into(),
        None => text.into(),
    }
}

/// Four significant digits, without zeros at the end.
pub fn four_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3.0 - libm::log10(x.abs()).floor()).clamp(0.0, 12.0);
    let text = format!("{x:.*}", decimals as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
