//! Arrays that `numpy.load` opens.

use std::{fs, io, path::Path};

/// Writes an array in row-major order; `kind` is NumPy's name of the type and `bytes` its little-endian entries.
pub fn write(folder: &Path, name: &str, kind: &str, shape: &[usize], bytes: &[u8]) -> io::Result<()> {
    let sides: String = shape.iter().map(|side| format!("{side}, ")).collect();
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({}), }}", sides.trim_end());
    // Entries begin at a multiple of 64 bytes; ten bytes and a line end are not counted in the text.
    header.push_str(&" ".repeat(63 - (header.len() + 10) % 64));
    header.push('\n');
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((header.len() as u16).to_le_bytes());
    file.extend(header.into_bytes());
    file.extend(bytes);
    fs::write(folder.join(format!("{name}.npy")), file)
}

pub fn doubles(folder: &Path, name: &str, shape: &[usize], entries: impl Iterator<Item = f64>) -> io::Result<()> {
    let bytes: Vec<u8> = entries.flat_map(f64::to_le_bytes).collect();
    write(folder, name, "<f8", shape, &bytes)
}

pub fn integers(folder: &Path, name: &str, shape: &[usize], entries: impl Iterator<Item = i64>) -> io::Result<()> {
    let bytes: Vec<u8> = entries.flat_map(i64::to_le_bytes).collect();
    write(folder, name, "<i8", shape, &bytes)
}
