//! Formulas in variables of their place, time and named parameters, which may be formulas themselves.

use super::error::TimelineError;
use super::expression::{Expression, parse};
use super::keyframes::Keyframes;
use exmex::Express;
use std::sync::Arc;

/// A formula that is known to use nothing but its own variables, `t` and parameters.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    /// Boxed, for it is large.
    expression: Box<Expression>,
    /// Per variable of the expression: which of own variables, then `t`, then parameters it is.
    slots: Vec<usize>,
    own: usize,
    parameters: Arc<Parameters>,
}

impl Formula {
    /// Parses an expression; `own` are the names of the variables that are given at each evaluation.
    ///
    /// # Errors
    /// [`TimelineError::Formula`] if it is none, or uses another name.
    pub fn parse(text: &str, own: &[&str], parameters: &Arc<Parameters>) -> Result<Formula, TimelineError> {
        // Long formulas stand on several lines.
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let known: Vec<&str> = own.iter().copied().chain(["t"]).chain(parameters.names()).collect();
        let fail = |reason: String| TimelineError::Formula {
            formula: text.clone(),
            reason,
            known: format!("{} and the usual functions", known.join(", ")),
        };
        let expression = parse(&text).map_err(&fail)?;
        let slot = |name: &String| {
            known.iter().position(|known| known == name).ok_or_else(|| fail(format!("there is no `{name}`")))
        };
        let slots = expression.var_names().iter().map(slot).collect::<Result<_, _>>()?;
        let expression = Box::new(expression);
        Ok(Formula { text, expression, slots, own: own.len(), parameters: Arc::clone(parameters) })
    }

    /// The formula at a time, to be evaluated at many places.
    pub fn at(&self, time: f64) -> FormulaAt<'_> {
        let shared = std::iter::once(time).chain(self.parameters.at(time)).collect();
        FormulaAt { formula: self, shared }
    }

    /// Whether its value can depend on time.
    pub fn changes(&self) -> bool {
        self.slots
            .iter()
            .any(|&slot| slot == self.own || (slot > self.own && self.parameters.changes(slot - self.own - 1)))
    }

    /// Whether it uses the own variable of this index.
    pub fn uses(&self, own: usize) -> bool {
        self.slots.contains(&own)
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// A formula at one time.
#[derive(Clone, Debug)]
pub struct FormulaAt<'a> {
    formula: &'a Formula,
    /// Time, then parameters.
    shared: Vec<f64>,
}

impl FormulaAt<'_> {
    /// Its value where the own variables have these values; not a number where it has none.
    pub fn value(&self, own: &[f64]) -> f64 {
        debug_assert_eq!(own.len(), self.formula.own);
        let value = |&slot: &usize| own.get(slot).copied().unwrap_or_else(|| self.shared[slot - own.len()]);
        let values: Vec<f64> = self.formula.slots.iter().map(value).collect();
        self.formula.expression.eval(&values).unwrap_or(f64::NAN)
    }
}

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
