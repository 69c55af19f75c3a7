//! Arrays of NumPy: faces, and lengths of an octahedron.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::arrays(bytes, "npy"));
