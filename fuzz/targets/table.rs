//! Tables of lengths and of numbers at vertices, of a tetrahedron.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::table(bytes));
