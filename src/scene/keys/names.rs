//! Values that are a name, or else something of another kind.

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::problems::Problem;
use super::spelling::suggestion;
use super::value::{Bounds, Kind, Value, shown};
use crate::evolve::Polishing;
use crate::mesh::{Selection, Weld};
use crate::text::clipped;

const WELDS: [(&str, Weld); 2] = [("exact", Weld::Exact), ("none", Weld::None)];

/// Boundary loops by number or by what they are.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::scene) enum Boundary {
    Loops(Vec<usize>),
    Outer,
    Longest,
}

impl From<Boundary> for Selection {
    fn from(boundary: Boundary) -> Self {
        match boundary {
            Boundary::Loops(loops) => Selection::Boundary(loops),
            Boundary::Outer => Selection::OuterBoundary,
            Boundary::Longest => Selection::LongestBoundary,
        }
    }
}

const BOUNDARIES: [(&str, Boundary); 2] = [("outer", Boundary::Outer), ("longest", Boundary::Longest)];

/// What a name stands for; `None` where the value is no text.
fn named<T: Clone>(name: &str, value: &Spanned<DeValue>, of: &[(&'static str, T)]) -> Option<Result<T, Problem>> {
    let text = value.get_ref().as_str()?;
    let names: Vec<&str> = of.iter().map(|(name, _)| *name).collect();
    let found = of.iter().find(|(candidate, _)| *candidate == text).map(|(_, value)| value.clone());
    Some(found.ok_or_else(|| Problem {
        span: value.span(),
        reason: format!("there is no {name} `{}`", clipped(text)),
        remedy: suggestion("names", text, &names),
    }))
}

/// Says all that might be there.
fn either<T: Value>(name: &str, value: &Spanned<DeValue>, bounds: Bounds, remedy: String) -> Problem {
    let reason = format!("`{name}` is {}, it must be {}", shown(value.get_ref()), T::kind(bounds).sentence());
    Problem { span: value.span(), reason, remedy }
}

fn choice<T>(of: &[(&'static str, T)]) -> Kind {
    Kind::Choice(of.iter().map(|(name, _)| *name).collect())
}

impl Value for Weld {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Either(Box::new(choice(&WELDS)), Box::new(f64::kind(bounds)))
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Weld, Problem> {
        named(name, value, &WELDS).unwrap_or_else(|| {
            let number = f64::read(name, value, bounds, example).map(Weld::Within);
            number.map_err(|problem| either::<Weld>(name, value, bounds, problem.remedy))
        })
    }

    fn json(&self) -> Json {
        match self {
            Weld::Exact => "exact".into(),
            Weld::None => "none".into(),
            Weld::Within(distance) => (*distance).into(),
        }
    }
}

impl Value for Boundary {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Either(Box::new(choice(&BOUNDARIES)), Box::new(Vec::<usize>::kind(bounds)))
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Boundary, Problem> {
        named(name, value, &BOUNDARIES).unwrap_or_else(|| match value.get_ref().is_array() {
            true => Vec::read(name, value, bounds, example).map(Boundary::Loops),
            false => Err(either::<Boundary>(name, value, bounds, format!("write for example {example}"))),
        })
    }

    fn json(&self) -> Json {
        match self {
            Boundary::Outer => "outer".into(),
            Boundary::Longest => "longest".into(),
            Boundary::Loops(loops) => loops.json(),
        }
    }
}

const POLISHED: [(&str, Polishing); 1] = [("last", Polishing::Last)];

impl Value for Polishing {
    fn kind(bounds: Bounds) -> Kind {
        Kind::Either(Box::new(choice(&POLISHED)), Box::new(bool::kind(bounds)))
    }

    fn read(name: &str, value: &Spanned<DeValue>, bounds: Bounds, example: &str) -> Result<Polishing, Problem> {
        named(name, value, &POLISHED).unwrap_or_else(|| match value.get_ref().as_bool() {
            Some(true) => Ok(Polishing::Every),
            Some(false) => Ok(Polishing::Off),
            None => Err(either::<Polishing>(name, value, bounds, format!("write for example {example}"))),
        })
    }

    fn json(&self) -> Json {
        match self {
            Polishing::Last => "last".into(),
            Polishing::Every => true.into(),
            Polishing::Off => false.into(),
        }
    }
}
