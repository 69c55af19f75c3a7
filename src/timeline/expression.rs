//! Expressions as they are written in scenes.

use super::operators::Operators;
use exmex::{Express, FlatEx, MatchLiteral};

/// A parsed expression in named variables.
pub(super) type Expression = FlatEx<f64, Operators, Decimal>;

/// Parses an expression.
///
/// # Errors
/// Why it is none, in words.
pub(super) fn parse(text: &str) -> Result<Expression, String> {
    FlatEx::parse(&with_loose_signs(text)).map_err(|error| error.to_string())
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
pub(super) struct Decimal;

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
