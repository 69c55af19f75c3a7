//! Named arrays in one file that `numpy.load` opens.

use std::io::{self, Cursor};

use npyz::npz::{NpzArchive, NpzWriter};
use npyz::{AutoSerialize, Deserialize, WriterBuilder};
use zip::write::FileOptions;

/// Arrays on their way into a file.
pub(super) struct ArrayWriter(NpzWriter<Cursor<Vec<u8>>>);

impl ArrayWriter {
    pub fn new() -> Self {
        ArrayWriter(NpzWriter::new(Cursor::new(Vec::new())))
    }

    /// Adds an array in row-major order. Nothing of the machine or the hour goes into the file.
    pub fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[u64],
        entries: impl IntoIterator<Item = T>,
    ) -> io::Result<()> {
        let options = FileOptions::default()
            .compression_method(zip::CompressionMethod::Stored)
            .last_modified_time(zip::DateTime::default())
            .unix_permissions(0o644)
            .large_file(true);
        let mut writer = self.0.array::<T>(name, options)?.default_dtype().shape(shape).begin_nd()?;
        writer.extend(entries)?;
        writer.finish()
    }

    pub fn finish(mut self) -> io::Result<Vec<u8>> {
        let cursor = self.0.zip_writer().finish()?;
        Ok(cursor.into_inner())
    }
}

/// Arrays of a file.
pub(super) struct ArrayReader<'b>(NpzArchive<Cursor<&'b [u8]>>);

impl<'b> ArrayReader<'b> {
    pub fn new(bytes: &'b [u8]) -> Result<Self, String> {
        NpzArchive::new(Cursor::new(bytes)).map(ArrayReader).map_err(|error| error.to_string())
    }

    /// The entries of an array that must have this shape.
    pub fn array<T: Deserialize>(&mut self, name: &str, shape: &[u64]) -> Result<Vec<T>, String> {
        let array = self.0.by_name(name).map_err(|error| format!("array `{name}`: {error}"))?;
        let array = array.ok_or_else(|| format!("there is no array `{name}`"))?;
        if array.shape() != shape || array.order() != npyz::Order::C {
            return Err(format!("array `{name}` has shape {:?}, it must have {shape:?}", array.shape()));
        }
        array.into_vec().map_err(|error| format!("array `{name}`: {error}"))
    }
}
