//! FOLD files: meshes, and lengths and angles of an octahedron.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::arrays(bytes, "fold"));
