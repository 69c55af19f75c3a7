//! The surface of a film.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::film(|film| film.put_mesh(bytes)));
