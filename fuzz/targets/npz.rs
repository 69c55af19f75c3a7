//! Archives of NumPy: meshes, and lengths and positions of an octahedron.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| immerse_fuzz::arrays(bytes, "npz"));
