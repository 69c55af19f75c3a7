//! Scenes, and all that `check` makes of them before anything is simulated.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| immerse_fuzz::build(text));
