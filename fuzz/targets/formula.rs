//! Formulas, read and evaluated.
#![no_main]

use immerse::timeline::{Formula, Parameters};

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Ok(formula) = Formula::parse(text, &["length", "x", "y", "z"], &Parameters::default().into()) {
        for time in [0.0, 0.5, f64::NAN] {
            let at = formula.at(time);
            let _ = (at.value(&[0.1, 1.0, -2.0, 0.0]), at.value(&[f64::MAX, f64::INFINITY, 1e-320, -0.0]));
        }
    }
});
