//! What formulas may use: signs, functions and constants.

use exmex::{BinOp, MakeOperators, Operator};
use std::f64::consts::{E, PI, TAU};

/// The operators that exmex has by default, with the same names and priorities. Its own call the C library, whose last
/// bits differ from machine to machine; these call `libm`, which is the same everywhere.
#[derive(Clone, Debug)]
pub(super) struct Operators;

impl MakeOperators<f64> for Operators {
    fn make<'a>() -> Vec<Operator<'a, f64>> {
        let binary = |apply, prio, is_commutative| BinOp { apply, prio, is_commutative };
        vec![
            Operator::make_bin("^", binary(libm::pow, 4, false)),
            Operator::make_bin("/", binary(|a, b| a / b, 3, false)),
            Operator::make_bin("*", binary(|a, b| a * b, 2, true)),
            Operator::make_bin_unary("-", binary(|a, b| a - b, 1, false), |a| -a),
            Operator::make_bin_unary("+", binary(|a, b| a + b, 0, true), |a| a),
            Operator::make_bin("atan2", binary(libm::atan2, 0, false)),
            Operator::make_bin("min", binary(libm::fmin, 0, false)),
            Operator::make_bin("max", binary(libm::fmax, 0, false)),
            Operator::make_unary("abs", f64::abs),
            Operator::make_unary("signum", f64::signum),
            Operator::make_unary("sin", libm::sin),
            Operator::make_unary("cos", libm::cos),
            Operator::make_unary("tan", libm::tan),
            Operator::make_unary("asin", libm::asin),
            Operator::make_unary("acos", libm::acos),
            Operator::make_unary("atan", libm::atan),
            Operator::make_unary("sinh", libm::sinh),
            Operator::make_unary("cosh", libm::cosh),
            Operator::make_unary("tanh", libm::tanh),
            Operator::make_unary("asinh", libm::asinh),
            Operator::make_unary("acosh", libm::acosh),
            Operator::make_unary("atanh", libm::atanh),
            Operator::make_unary("floor", f64::floor),
            Operator::make_unary("round", f64::round),
            Operator::make_unary("ceil", f64::ceil),
            Operator::make_unary("trunc", f64::trunc),
            Operator::make_unary("fract", f64::fract),
            Operator::make_unary("exp", libm::exp),
            Operator::make_unary("sqrt", f64::sqrt),
            Operator::make_unary("cbrt", libm::cbrt),
            Operator::make_unary("ln", libm::log),
            Operator::make_unary("log2", libm::log2),
            Operator::make_unary("log10", libm::log10),
            Operator::make_unary("log", libm::log),
            Operator::make_constant("PI", PI),
            Operator::make_constant("π", PI),
            Operator::make_constant("E", E),
            Operator::make_constant("e", E),
            Operator::make_constant("TAU", TAU),
            Operator::make_constant("τ", TAU),
        ]
    }
}
