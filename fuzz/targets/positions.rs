//! Other files of the same connectivity.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::positions(bytes));
