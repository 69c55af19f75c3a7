//! Functions in formulas are those of `libm`, to the last bit, so that a scene has the same bits on every machine.

use immerse::timeline::Formula;
use std::f64::consts::{E, PI, TAU};
use std::sync::Arc;

/// With `x` and `y` as variables.
fn value(text: &str, x: f64, y: f64) -> f64 {
    Formula::parse(text, &["x", "y"], &Arc::default()).expect(text).at(0.0).value(&[x, y])
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Beside limits and signs, for every function one where glibc's has other bits (0.117 for the sine, 0.24 for the
/// cosine, …).
const ARGUMENTS: [f64; 33] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    1.5,
    2.5,
    -2.5,
    7.0,
    1e-9,
    -1e-300,
    1e9,
    700.0,
    1e300,
    f64::INFINITY,
    f64::NAN,
    0.117,
    0.24,
    0.082,
    0.32,
    0.05,
    0.044,
    0.099,
    0.353,
    0.155,
    0.055,
    1.001,
    0.022,
    0.019,
    0.01,
    0.165,
    0.054,
];

type Function = fn(f64) -> f64;
type FunctionOfTwo = fn(f64, f64) -> f64;

#[test]
fn functions_of_one_variable_are_those_of_libm() {
    let functions: [(&str, Function); 27] = [
        ("abs", libm::fabs),
        ("signum", f64::signum),
        ("sin", libm::sin),
        ("cos", libm::cos),
        ("tan", libm::tan),
        ("asin", libm::asin),
        ("acos", libm::acos),
        ("atan", libm::atan),
        ("sinh", libm::sinh),
        ("cosh", libm::cosh),
        ("tanh", libm::tanh),
        ("asinh", libm::asinh),
        ("acosh", libm::acosh),
        ("atanh", libm::atanh),
        ("floor", libm::floor),
        ("round", libm::round),
        ("ceil", libm::ceil),
        ("trunc", libm::trunc),
        ("fract", |x| x - libm::trunc(x)),
        ("exp", libm::exp),
        ("sqrt", libm::sqrt),
        ("cbrt", libm::cbrt),
        ("ln", libm::log),
        ("log", libm::log),
        ("log2", libm::log2),
        ("log10", libm::log10),
        ("-", |x| -x),
    ];
    for (name, function) in functions {
        for x in ARGUMENTS {
            // Of a variable, of a number that is folded when the formula is read, and without parentheses.
            let mut texts = vec![format!("{name}(x)"), format!("{name} x")];
            if x.is_finite() && !x.is_sign_negative() {
                texts.push(format!("{name}({x:e})"));
            }
            for text in texts {
                let (found, wanted) = (value(&text, x, 0.0), function(x));
                assert!(same(found, wanted), "{text} at x = {x:e}: {found:e} instead of {wanted:e}");
            }
        }
    }
}

#[test]
fn functions_of_two_variables_are_those_of_libm() {
    let functions: [(&str, FunctionOfTwo); 9] = [
        ("x ^ y", libm::pow),
        ("x atan2 y", libm::atan2),
        ("atan2(x, y)", libm::atan2),
        ("min(x, y)", libm::fmin),
        ("x max y", libm::fmax),
        ("x * y", |x, y| x * y),
        ("x / y", |x, y| x / y),
        ("x + y", |x, y| x + y),
        ("x - y", |x, y| x - y),
    ];
    for (text, function) in functions {
        for x in ARGUMENTS {
            for y in ARGUMENTS {
                let (found, wanted) = (value(text, x, y), function(x, y));
                assert!(same(found, wanted), "{text} at x = {x:e}, y = {y:e}: {found:e} instead of {wanted:e}");
            }
        }
    }
    for x in ARGUMENTS {
        assert!(same(value("x^2", x, 0.0), x * x), "a square is not the product at {x:e}");
        assert!(same(value("x^1", x, 0.0), x) && value("x^0", x, 0.0) == 1.0, "{x:e}");
    }
}

/// `min`, `max` and `atan2` bind like sums; `/` closer than `*`, so that it comes first.
#[test]
fn constants_and_priorities_are_as_they_were() {
    for (text, wanted) in [
        ("PI", PI),
        ("π", PI),
        ("TAU", TAU),
        ("τ", TAU),
        ("E", E),
        ("e", E),
        ("2 * 3 ^ 2 + 1", 19.0),
        ("7 - 2 - 1", 4.0),
        ("2 * 6 / 4 * 3", 9.0),
        ("2 ^ 3 ^ 2", 64.0),
        ("1 + 2 max 1 * 2", 3.0),
        ("-3 ^ 2", -9.0),
    ] {
        assert!(same(value(text, 0.0, 0.0), wanted), "{text}: {}", value(text, 0.0, 0.0));
    }
}
