//! Expressions in variables of their place, time and the parameters of the scene.

use super::operators::Operators;
use super::{Parameters, TimelineError};
use exmex::{Express, FlatEx, MatchLiteral};
use std::sync::Arc;

/// A formula that is known to use nothing but its own variables, `t` and parameters.
#[derive(Clone, Debug)]
pub struct Formula {
    text: String,
    /// Boxed, for it is large.
    expression: Box<FlatEx<f64, Operators, Decimal>>,
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
        let expression = FlatEx::parse(&with_loose_signs(&text)).map_err(|error| fail(error.to_string()))?;
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

/// The parser binds signs closest of all. They are to bind like products, so that `-x^2` is `-(x^2)`; only behind `/`
/// and `^` they stay.
fn with_loose_signs(text: &str) -> String {
    let mut loose = String::with_capacity(text.len());
    let mut before = '(';
    for c in text.chars() {
        loose.push(c);
        if c == '-' && matches!(before, '(' | ',' | '+' | '-' | '*') {
            loose.push_str("1*");
        }
        if c != ' ' {
            before = c;
        }
    }
    loose
}

/// Numbers as in TOML: `2`, `0.5`, `1e-3`.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Decimal;

impl MatchLiteral for Decimal {
    fn is_literal(text: &str) -> Option<&str> {
        let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
        let whole = digits(0);
        let fraction = if text[whole..].starts_with('.') { 1 + digits(whole + 1) } else { 0 };
        if whole == 0 && fraction < 2 {
            return None;
        }
        let mut end = whole + fraction;
        if text[end..].starts_with(['e', 'E']) {
            let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
            match digits(end + 1 + sign) {
                0 => {}
                exponent => end += 1 + sign + exponent,
            }
        }
        Some(&text[..end])
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
