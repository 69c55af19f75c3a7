//! The report of a frame, with a checksum that is right.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::film(|film| film.put_report(bytes)));
