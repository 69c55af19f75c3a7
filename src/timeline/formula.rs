//! Formulas in variables of their place, time and named parameters, which may be formulas themselves.

use super::error::TimelineError;
use super::expression::{Expression, parse};
use super::keyframes::Keyframes;
use crate::text::clipped;
use exmex::Express;
use std::collections::HashMap;
use std::sync::Arc;

/// The most characters of a formula. Its parts can be named among the parameters.
pub const LONGEST_FORMULA: usize = 5000;

/// The most parameters.
pub const MOST_PARAMETERS: usize = 1000;

/// A formula that is known to use nothing but its own variables, `t` and parameters.
#[derive(Clone, Debug)]
pub struct Formula {
    rule: Rule,
    parameters: Arc<Parameters>,
}

/// A formula apart from the values of parameters, which whoever evaluates it knows.
#[derive(Clone, Debug)]
struct Rule {
    text: String,
    /// Boxed, for it is large.
    expression: Box<Expression>,
    /// Per variable of the expression: which of own variables, then `t`, then parameters it is.
    slots: Vec<usize>,
    own: usize,
}

impl Formula {
    /// Parses an expression; `own` are the names of the variables that are given at each evaluation.
    ///
    /// # Errors
    /// [`TimelineError::TooLong`] if it has more than [`LONGEST_FORMULA`] characters, [`TimelineError::Formula`] if it is
    /// no expression, or uses another name.
    pub fn parse(text: &str, own: &[&str], parameters: &Arc<Parameters>) -> Result<Formula, TimelineError> {
        let characters = text.chars().count();
        if characters > LONGEST_FORMULA {
            return Err(TimelineError::TooLong { characters, most: LONGEST_FORMULA });
        }
        // Long formulas stand on several lines.
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let fail = |reason: String| TimelineError::Formula {
            formula: clipped(&text).into_owned(),
            // The parser repeats what it was given.
            reason: clipped(&reason).into_owned(),
            known: format!("{} and the usual functions", known(own, parameters)),
        };
        let expression = parse(&text).map_err(&fail)?;
        let slot = |name: &String| {
            let among_own = own.iter().copied().chain(["t"]).position(|known| known == name);
            let slot = among_own.or_else(|| Some(own.len() + 1 + parameters.index(name)?));
            slot.ok_or_else(|| fail(format!("there is no `{name}`")))
        };
        let slots = expression.var_names().iter().map(slot).collect::<Result<_, _>>()?;
        let rule = Rule { text, expression: Box::new(expression), slots, own: own.len() };
        Ok(Formula { rule, parameters: Arc::clone(parameters) })
    }

    /// The formula at a time, to be evaluated at many places.
    pub fn at(&self, time: f64) -> FormulaAt<'_> {
        FormulaAt { rule: &self.rule, shared: self.parameters.shared(time, self.rule.parameters()) }
    }

    /// Whether its value can depend on time.
    pub fn changes(&self) -> bool {
        self.rule.changes(&self.parameters)
    }

    /// Whether it uses the own variable of this index.
    pub fn uses(&self, own: usize) -> bool {
        self.rule.slots.contains(&own)
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.rule.text
    }
}

impl Rule {
    /// How many of the parameters, from the first one, have to be known.
    fn parameters(&self) -> usize {
        self.slots.iter().map(|slot| slot.saturating_sub(self.own)).max().unwrap_or(0)
    }

    fn changes(&self, parameters: &Parameters) -> bool {
        let changes = |slot: usize| slot == self.own || (slot > self.own && parameters.changes(slot - self.own - 1));
        self.slots.iter().any(|&slot| changes(slot))
    }

    /// Its value; `shared` are time and parameters. Not a number where it has none.
    fn value(&self, own: &[f64], shared: &[f64]) -> f64 {
        debug_assert_eq!(own.len(), self.own);
        let value = |&slot: &usize| own.get(slot).copied().unwrap_or_else(|| shared[slot - own.len()]);
        let values: Vec<f64> = self.slots.iter().map(value).collect();
        self.expression.eval(&values).unwrap_or(f64::NAN)
    }
}

/// The names that formulas may use, as in a sentence.
fn known(own: &[&str], parameters: &Parameters) -> String {
    const LISTED: usize = 20;
    let more = parameters.named.len().saturating_sub(LISTED);
    let names: Vec<&str> = own.iter().copied().chain(["t"]).chain(parameters.names().take(LISTED)).collect();
    let names = names.join(", ");
    if more > 0 { format!("{names}, {more} more parameters") } else { names }
}

/// A formula at one time.
#[derive(Clone, Debug)]
pub struct FormulaAt<'a> {
    rule: &'a Rule,
    /// Time, then parameters.
    shared: Vec<f64>,
}

impl FormulaAt<'_> {
    /// Its value where the own variables have these values; not a number where it has none.
    pub fn value(&self, own: &[f64]) -> f64 {
        self.rule.value(own, &self.shared)
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
    named: Vec<Parameter>,
    indices: HashMap<String, usize>,
}

#[derive(Clone, Debug)]
struct Parameter {
    name: String,
    number: Value,
    /// Whether it can depend on time.
    changes: bool,
}

/// A [`Number`] whose formula does not hold the parameters, of which it is one.
#[derive(Clone, Debug)]
enum Value {
    Constant(f64),
    Keyframes(Keyframes<f64>),
    Formula(Rule),
}

impl Parameters {
    /// Adds one, which may use those that are there.
    ///
    /// # Errors
    /// [`TimelineError::Name`] if the name means something in formulas already, or is none,
    /// [`TimelineError::TooManyParameters`] beyond [`MOST_PARAMETERS`].
    pub fn add(parameters: &mut Arc<Parameters>, name: &str, number: Number) -> Result<(), TimelineError> {
        parameters.check_name(name)?;
        let changes = number.changes();
        let number = match number {
            Number::Constant(value) => Value::Constant(value),
            Number::Keyframes(keyframes) => Value::Keyframes(keyframes),
            Number::Formula(formula) => Value::Formula(formula.rule),
        };
        // Copied only where somebody else holds them.
        let all = Arc::make_mut(parameters);
        all.indices.insert(name.to_owned(), all.named.len());
        all.named.push(Parameter { name: name.to_owned(), number, changes });
        Ok(())
    }

    /// Whether there may be one more of this name.
    ///
    /// # Errors
    /// As [`Parameters::add`].
    pub fn check_name(&self, name: &str) -> Result<(), TimelineError> {
        let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        // What does not parse as a variable of its own is a function, an operator or a constant.
        let is_free = || Formula::parse(name, &[name], &Arc::default()).is_ok_and(|formula| formula.uses(0));
        if !is_name || RESERVED.contains(&name) || self.indices.contains_key(name) || !is_free() {
            return Err(TimelineError::Name { name: name.to_owned() });
        }
        if self.named.len() >= MOST_PARAMETERS {
            return Err(TimelineError::TooManyParameters { most: MOST_PARAMETERS });
        }
        Ok(())
    }

    /// Their names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.named.iter().map(|parameter| parameter.name.as_str())
    }

    fn index(&self, name: &str) -> Option<usize> {
        self.indices.get(name).copied()
    }

    /// A time, and the values of so many of them at it, in order.
    fn shared(&self, time: f64, count: usize) -> Vec<f64> {
        let mut shared = vec![time];
        for parameter in self.named.iter().take(count) {
            shared.push(match &parameter.number {
                Value::Constant(value) => *value,
                Value::Keyframes(keyframes) => keyframes.at(time),
                Value::Formula(rule) => rule.value(&[], &shared),
            });
        }
        shared
    }

    /// Their values at a time, in order.
    pub fn at(&self, time: f64) -> Vec<f64> {
        self.shared(time, self.named.len()).split_off(1)
    }

    /// Whether the parameter of this index can depend on time.
    pub fn changes(&self, index: usize) -> bool {
        self.named.get(index).is_some_and(|parameter| parameter.changes)
    }
}

/// Variables of formulas in one place or another, and what looks like a constant.
const RESERVED: [&str; 9] = ["t", "x", "y", "z", "dx", "dy", "dz", "length", "pi"];
