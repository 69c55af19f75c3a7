//! The kinds of values a key can have: how they are read, bounded, described and shown.

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::problems::Problem;
use crate::text::clipped;

/// What a number may be: a limit and whether the limit itself is excluded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::scene) struct Bounds {
    pub low: Option<(f64, bool)>,
    pub high: Option<(f64, bool)>,
}

impl Bounds {
    fn contains(self, x: f64) -> bool {
        self.low.is_none_or(|(low, open)| if open { x > low } else { x >= low })
            && self.high.is_none_or(|(high, open)| if open { x < high } else { x <= high })
    }

    fn sentence(self) -> String {
        match (self.low, self.high) {
            (None, None) => String::new(),
            (Some((low, false)), Some((high, false))) => format!(" from {low} to {high}"),
            (low, high) => {
                let low = low.map(|(low, open)| format!(" {} {low}", if open { "greater than" } else { "at least" }));
                let high = high.map(|(high, open)| format!(" {} {high}", if open { "less than" } else { "at most" }));
                low.into_iter().chain(high).collect::<Vec<_>>().join(" and")
            }
        }
    }
}

/// What a key takes, for messages and for the schema.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) enum Kind {
    Number(Bounds),
    Integer(Bounds),
    Flag,
    Text,
    Color,
    Choice(Vec<&'static str>),
    OneOrMore(Vec<&'static str>),
    Array {
        item: Box<Kind>,
        length: Option<usize>,
    },
    /// A number, a formula or keyframes.
    ChangingNumber(Bounds, Vec<Field>),
    /// A table whose keys are up to the file.
    Map(Box<Kind>),
    Table(Vec<Field>),
    Tables(Vec<Field>),
    /// Either of these.
    Either(Box<Kind>, Box<Kind>),
    /// Tables of the kind of the key named here, for trees.
    TablesLike(&'static str),
    /// A name that decides which further keys there are.
    Variants(Vec<Variant>),
}

/// A key that a table can have.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct Field {
    pub name: &'static str,
    pub doc: &'static str,
    pub kind: Kind,
    pub default: Option<Json>,
    pub required: bool,
}

/// One of the names of [`Kind::Variants`] and its keys.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) struct Variant {
    pub name: &'static str,
    pub doc: &'static str,
    pub fields: Vec<Field>,
}

impl Kind {
    /// In words, with an article.
    pub fn sentence(&self) -> String {
        match self {
            Kind::Number(bounds) => format!("a number{}", bounds.sentence()),
            Kind::Integer(bounds) => format!("an integer{}", bounds.sentence()),
            Kind::Flag => "true or false".into(),
            Kind::Text => "a string".into(),
            Kind::Color => "a colour such as \"#E0823D\"".into(),
            Kind::Choice(names) => format!("one of the strings {}", names.join(", ")),
            Kind::OneOrMore(names) => format!("one or several of the strings {}", names.join(", ")),
            Kind::Array { length: Some(length), item } => {
                format!("a list of {length} entries, each {}", item.sentence())
            }
            Kind::Array { length: None, item } => format!("a list, each entry {}", item.sentence()),
            Kind::ChangingNumber(bounds, _) => {
                format!("a number{}, a formula in quotes or {{ times = […], values = […] }}", bounds.sentence())
            }
            Kind::Either(one, other) => format!("{} or {}", one.sentence(), other.sentence()),
            Kind::Map(_) | Kind::Table(_) => "a table".into(),
            Kind::Tables(_) | Kind::TablesLike(_) => "a list of tables".into(),
            Kind::Variants(_) => "a name".into(),
        }
    }
}

/// What stands there, in words, for "`x` is …".
pub(in crate::scene) fn shown(value: &DeValue) -> String {
    match value {
        DeValue::String(text) => format!("the string {:?}", clipped(text)),
        DeValue::Integer(integer) => clipped(&integer.to_string()).into_owned(),
        DeValue::Float(float) => clipped(&float.to_string()).into_owned(),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(_) => "a list".into(),
        DeValue::Table(_) => "a table".into(),
    }
}

/// A type that can be read from one TOML value.
pub(in crate::scene) trait Value: Sized {
    fn kind(bounds: Bounds) -> Kind;
    /// `name` is used in messages; `example` is valid TOML that may be written there.
    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Self, Problem>;
    fn json(&self) -> Json;
}

fn mismatch<T: Value>(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Problem {
    let without_quotes = match (value.get_ref(), T::kind(bounds)) {
        (DeValue::String(text), Kind::Number(_)) if text.parse::<f64>().is_ok() => Some(text),
        (DeValue::String(text), Kind::Integer(_)) if text.parse::<u64>().is_ok() => Some(text),
        _ => None,
    };
    Problem {
        span: value.span(),
        reason: format!("`{name}` is {}, it must be {}", shown(value.get_ref()), T::kind(bounds).sentence()),
        remedy: match without_quotes {
            Some(text) => format!("remove the quotes around {text}"),
            None => format!("write for example {example}"),
        },
    }
}

/// How far from 0 the numbers of a scene may be: as far as coordinates and lengths.
const LARGEST_NUMBER: f64 = 1e15;

impl Value for f64 {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Number(bounds)
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<f64, Problem> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(integer) => {
                i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|integer| integer as f64)
            }
            _ => None,
        };
        match number {
            Some(x) if !x.is_finite() => Err(Problem {
                span: value.span(),
                reason: format!("`{name}` is {}, it must be finite", shown(value.get_ref())),
                remedy: format!("write for example {example}"),
            }),
            Some(x) if x.abs() > LARGEST_NUMBER => Err(Problem {
                span: value.span(),
                reason: format!("`{name}` is {x:e}, and no number of a scene is above {LARGEST_NUMBER:e}"),
                remedy: "use another unit, or leave the key out".into(),
            }),
            Some(x) if bounds.contains(x) => Ok(x),
            _ => Err(mismatch::<f64>(name, value, bounds, example)),
        }
    }

    fn json(&self) -> Json {
        (*self).into()
    }
}

impl Value for u64 {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Integer(Bounds { low: bounds.low.or(Some((0.0, false))), ..bounds })
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<u64, Problem> {
        let integer = match value.get_ref() {
            DeValue::Integer(integer) => u64::from_str_radix(integer.as_str(), integer.radix()).ok(),
            _ => None,
        };
        integer
            .filter(|&integer| bounds.contains(integer as f64))
            .ok_or_else(|| mismatch::<u64>(name, value, bounds, example))
    }

    fn json(&self) -> Json {
        (*self).into()
    }
}

impl Value for usize {
    fn kind(bounds: Bounds) -> Kind {
        u64::kind(bounds)
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<usize, Problem> {
        let integer = u64::read(name, value, bounds, example)?;
        usize::try_from(integer).map_err(|_| mismatch::<usize>(name, value, bounds, example))
    }

    fn json(&self) -> Json {
        (*self as u64).into()
    }
}

impl Value for bool {
    fn kind(_: Bounds) -> Kind {
        Kind::Flag
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<bool, Problem> {
        value.get_ref().as_bool().ok_or_else(|| mismatch::<bool>(name, value, bounds, example))
    }

    fn json(&self) -> Json {
        (*self).into()
    }
}

/// Keys that name files.
pub(in crate::scene) const PATHS: [&str; 4] = ["file", "files", "csv", "matcap"];

/// A text as it stood in double quotes before backslashes were taken for escapes.
fn with_backslashes(text: &str) -> String {
    let escape = |c: char| match c {
        '\u{8}' => Some('b'),
        '\t' => Some('t'),
        '\n' => Some('n'),
        '\u{c}' => Some('f'),
        '\r' => Some('r'),
        '\u{1b}' => Some('e'),
        _ => None,
    };
    text.chars().fold(String::new(), |mut path, c| {
        match escape(c) {
            Some(letter) => path.extend(['\\', letter]),
            None => path.push(c),
        }
        path
    })
}

impl Value for String {
    fn kind(_: Bounds) -> Kind {
        Kind::Text
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<String, Problem> {
        let text = value.get_ref().as_str().ok_or_else(|| mismatch::<String>(name, value, bounds, example))?;
        if (PATHS.contains(&name) || name == "extends") && text.contains(char::is_control) {
            let escaped = with_backslashes(text);
            return Err(Problem {
                span: value.span(),
                reason: format!(
                    "`{name}` has a line break, a tab or the like in it, because in double quotes a backslash and the \
                     letter after it stand for one"
                ),
                remedy: format!("put the path in single quotes: {name} = '{escaped}'"),
            });
        }
        Ok(text.to_owned())
    }

    fn json(&self) -> Json {
        self.as_str().into()
    }
}

/// An sRGB colour written `"#RRGGBB"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) struct Color(pub [u8; 3]);

impl Value for Color {
    fn kind(_: Bounds) -> Kind {
        Kind::Color
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Color, Problem> {
        let digits = value.get_ref().as_str().and_then(|text| text.strip_prefix('#'));
        let digits = digits.filter(|digits| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()));
        let rgb = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let [_, red, green, blue] = rgb.ok_or_else(|| mismatch::<Color>(name, value, bounds, example))?.to_be_bytes();
        Ok(Color([red, green, blue]))
    }

    fn json(&self) -> Json {
        let [red, green, blue] = self.0;
        format!("#{red:02X}{green:02X}{blue:02X}").into()
    }
}

impl<T: Value, const N: usize> Value for [T; N] {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Array { item: Box::new(T::kind(bounds)), length: Some(N) }
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<[T; N], Problem> {
        if !value.get_ref().is_array() {
            return Err(mismatch::<[T; N]>(name, value, bounds, example));
        }
        let entries: Vec<T> = Vec::read(name, value, bounds, example)?;
        let length = entries.len();
        entries.try_into().map_err(|_| Problem {
            span: value.span(),
            reason: format!("`{name}` has {length} entries, it must have {N}"),
            remedy: format!("write for example {example}"),
        })
    }

    fn json(&self) -> Json {
        self.iter().map(T::json).collect::<Vec<_>>().into()
    }
}

impl<T: Value> Value for Vec<T> {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Array { item: Box::new(T::kind(bounds)), length: None }
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Vec<T>, Problem> {
        let Some(list) = value.get_ref().as_array() else {
            return Err(mismatch::<Vec<T>>(name, value, bounds, example));
        };
        list.iter().enumerate().map(|(i, entry)| T::read(&format!("{name}[{i}]"), entry, bounds, example)).collect()
    }

    fn json(&self) -> Json {
        self.iter().map(T::json).collect::<Vec<_>>().into()
    }
}
