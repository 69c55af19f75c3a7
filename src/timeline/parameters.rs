//! Named numbers that formulas share.

use super::{Formula, Keyframes, TimelineError};
use std::sync::Arc;

/// A number that may change with time.
#[derive(Clone, Debug)]
pub enum Number {
    /// The same at all times.
    Constant(f64),
    /// Given at some times.
    Keyframes(Keyframes<f64>),
    /// By a formula in `t` and parameters.
    Formula(Formula),
}

impl Number {
    /// Its value at a time.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Number::Constant(value) => *value,
            Number::Keyframes(keyframes) => keyframes.at(time),
            Number::Formula(formula) => formula.at(time).value(&[]),
        }
    }

    /// Whether it can depend on time.
    pub fn changes(&self) -> bool {
        match self {
            Number::Constant(_) => false,
            Number::Keyframes(keyframes) => keyframes.values().array_windows().any(|[a, b]| a != b),
            Number::Formula(formula) => formula.changes(),
        }
    }
}

/// Named numbers. A formula among them may use those before it.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    named: Vec<(String, Number)>,
}

impl Parameters {
    /// With one more, which may use those that are there.
    ///
    /// # Errors
    /// [`TimelineError::Name`] if the name means something in formulas already, or is none.
    pub fn with(&self, name: &str, number: Number) -> Result<Parameters, TimelineError> {
        let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        // What does not parse as a variable of its own is a function, an operator or a constant.
        let is_free = Formula::parse(name, &[name], &Arc::default()).is_ok_and(|formula| formula.uses(0));
        if !is_name || !is_free || RESERVED.contains(&name) || self.names().any(|known| known == name) {
            return Err(TimelineError::Name { name: name.to_owned() });
        }
        let mut named = self.named.clone();
        named.push((name.to_owned(), number));
        Ok(Parameters { named })
    }

    /// Their names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.named.iter().map(|(name, _)| name.as_str())
    }

    /// Their values at a time, in order.
    pub fn at(&self, time: f64) -> impl Iterator<Item = f64> {
        self.named.iter().map(move |(_, number)| number.at(time))
    }

    /// Whether the parameter of this index can depend on time.
    pub fn changes(&self, index: usize) -> bool {
        self.named.get(index).is_some_and(|(_, number)| number.changes())
    }
}

/// Variables of formulas in one place or another, and what looks like a constant.
const RESERVED: [&str; 9] = ["t", "x", "y", "z", "dx", "dy", "dz", "length", "pi"];
