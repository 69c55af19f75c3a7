//! Named arrays in one file that `numpy.load` opens: a zip archive, without compression, of `.npy` files
//! (NumPy's format version 1.0).

use std::io::{self, Cursor, Read, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// A number as NumPy stores it, least significant byte first.
pub(crate) trait Element: Sized {
    /// NumPy's name of the type.
    const TYPE: &'static str;
    fn put(self, bytes: &mut Vec<u8>);
    /// From exactly as many bytes as [`Element::put`] adds.
    fn get(bytes: &[u8]) -> Option<Self>;
}

macro_rules! element {
    ($type:ty, $name:literal) => {
        impl Element for $type {
            const TYPE: &'static str = $name;
            fn put(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
            fn get(bytes: &[u8]) -> Option<Self> {
                bytes.try_into().ok().map(<$type>::from_le_bytes)
            }
        }
    };
}

element!(f64, "<f8");
element!(f32, "<f4");
element!(u64, "<u8");
element!(u32, "<u4");
element!(u8, "|u1");

/// What stands before the entries of an array in row-major order.
fn header<T: Element>(shape: &[u64]) -> Vec<u8> {
    let sides: String = shape.iter().map(|side| format!("{side}, ")).collect();
    let mut text = format!("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", T::TYPE, sides.trim_end());
    // Entries begin at a multiple of 64 bytes; ten bytes and a line end are not counted in the text.
    let padding = 63 - (text.len() + 10) % 64;
    text.push_str(&" ".repeat(padding));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.into_bytes());
    bytes
}

/// Arrays on their way into a file.
pub(crate) struct ArrayWriter(ZipWriter<Cursor<Vec<u8>>>);

impl ArrayWriter {
    pub fn new() -> Self {
        ArrayWriter(ZipWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds an array in row-major order. Nothing of the machine or the hour goes into the file.
    pub fn array<T: Element>(
        &mut self,
        name: &str,
        shape: &[u64],
        entries: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default())
            .unix_permissions(0o644)
            .large_file(true);
        let mut bytes = header::<T>(shape);
        entries.into_iter().for_each(|entry| entry.put(&mut bytes));
        self.0.start_file(format!("{name}.npy"), options)?;
        self.0.write_all(&bytes)
    }

    pub fn finish(self) -> io::Result<Vec<u8>> {
        Ok(self.0.finish()?.into_inner())
    }
}

/// Arrays of a file.
pub(crate) struct ArrayReader<'b>(ZipArchive<Cursor<&'b [u8]>>);

impl<'b> ArrayReader<'b> {
    pub fn new(bytes: &'b [u8]) -> Result<Self, String> {
        ZipArchive::new(Cursor::new(bytes)).map(ArrayReader).map_err(|error| error.to_string())
    }

    /// Whether there is an array of that name.
    pub fn has(&self, name: &str) -> bool {
        self.0.index_for_name(&format!("{name}.npy")).is_some()
    }

    /// The entries of an array that must have this shape.
    pub fn array<T: Element>(&mut self, name: &str, shape: &[u64]) -> Result<Vec<T>, String> {
        let size = size_of::<T>();
        let count = shape.iter().fold(1_u64, |count, side| count.saturating_mul(*side));
        let mut bytes = Vec::new();
        let file = self.0.by_name(&format!("{name}.npy")).map_err(|error| format!("array `{name}`: {error}"))?;
        let header = header::<T>(shape);
        // Never more than what belongs there, whatever the archive claims.
        file.take((header.len() as u64).saturating_add(count.saturating_mul(size as u64)).saturating_add(1))
            .read_to_end(&mut bytes)
            .map_err(|error| format!("array `{name}`: {error}"))?;
        let entries = bytes
            .strip_prefix(&header[..])
            .filter(|entries| entries.len() as u64 == count.saturating_mul(size as u64))
            .ok_or_else(|| format!("array `{name}` is not one of type {} and shape {shape:?}", T::TYPE))?;
        entries.chunks_exact(size).map(|entry| T::get(entry).ok_or_else(|| format!("array `{name}`"))).collect()
    }
}
