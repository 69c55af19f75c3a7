//! Tables of numbers from whatever NumPy writes: any width, byte order and order of indices, packed or not.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::fault::Fault;
use super::header::{Header, Kind, MAGIC};

/// Numbers in rows, in order of their indices, the last of which runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Array {
    /// None for a single number, one side for a list, two for a table.
    pub shape: Vec<usize>,
    pub numbers: Numbers,
}

/// The entries of an array.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Numbers {
    /// Integers.
    Whole(Vec<i64>),
    /// Floating-point numbers, of single precision too.
    Real(Vec<f64>),
}

impl Numbers {
    /// The same as floating-point numbers.
    pub fn into_real(self) -> Vec<f64> {
        match self {
            Numbers::Whole(numbers) => numbers.into_iter().map(|number| number as f64).collect(),
            Numbers::Real(numbers) => numbers,
        }
    }
}

/// Whether bytes begin as an array does.
pub(crate) fn is_array(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Whether bytes begin as an archive does; one of nothing begins otherwise.
pub(crate) fn is_archive(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

impl Array {
    /// The array in the bytes of an `.npy` file. Nothing may follow it.
    pub fn parse(bytes: &[u8]) -> Result<Array, Fault> {
        let (Header { kind, is_big_endian, is_fortran, shape }, entries) = Header::parse(bytes)?;
        if shape.len() > 2 {
            let reason = format!("it has {} indices, shape {shape:?}", shape.len());
            return Err(Fault::new(reason, "save a table, which has two"));
        }
        let size = kind.size();
        let wanted = shape.iter().try_fold(size, |bytes, side| bytes.checked_mul(*side));
        if wanted != Some(entries.len()) {
            let reason =
                format!("its shape {shape:?} of {size} bytes each does not fit the {} that follow", entries.len());
            return Err(Fault::new(reason, "save the array again; part of it may be missing"));
        }
        let order = |entry: &[u8]| {
            let mut bytes = [0; 8];
            bytes[..size].copy_from_slice(entry);
            if is_big_endian {
                bytes[..size].reverse();
            }
            bytes
        };
        let entries = entries.chunks_exact(size);
        let numbers = match kind {
            Kind::Float(4) => {
                let single = |[a, b, c, d, ..]: [u8; 8]| f64::from(f32::from_le_bytes([a, b, c, d]));
                Numbers::Real(entries.map(|entry| single(order(entry))).collect())
            }
            Kind::Float(_) => Numbers::Real(entries.map(|entry| f64::from_le_bytes(order(entry))).collect()),
            Kind::Unsigned(_) => {
                let whole: Option<Vec<i64>> =
                    entries.map(|entry| i64::try_from(u64::from_le_bytes(order(entry))).ok()).collect();
                Numbers::Whole(whole.ok_or_else(|| {
                    Fault::new("it has a number above 2^63", "vertices are counted from 0; save a smaller integer type")
                })?)
            }
            Kind::Signed(_) => {
                // The sign is spread over the bytes in front.
                let shift = 64 - 8 * size as u32;
                Numbers::Whole(entries.map(|entry| (i64::from_le_bytes(order(entry)) << shift) >> shift).collect())
            }
        };
        let numbers = match shape.as_slice() {
            &[rows, columns] if is_fortran => match numbers {
                Numbers::Whole(numbers) => Numbers::Whole(transposed(&numbers, rows, columns)),
                Numbers::Real(numbers) => Numbers::Real(transposed(&numbers, rows, columns)),
            },
            _ => numbers,
        };
        Ok(Array { shape, numbers })
    }
}

/// Numbers by rows that stand by columns.
fn transposed<T: Copy>(numbers: &[T], rows: usize, columns: usize) -> Vec<T> {
    (0..rows).flat_map(|row| (0..columns).map(move |column| numbers[column * rows + row])).collect()
}

/// The arrays of an `.npz` file.
pub(crate) struct Archive<'b> {
    zip: ZipArchive<Cursor<&'b [u8]>>,
    /// The most bytes that an array of it may have.
    most: u64,
}

/// What is packed into less than a hundredth of its bytes is hardly a mesh, and would cost memory that nobody had to send. A
/// little may be packed as well as it likes: lengths that are all the same are.
const PACKED: u64 = 100;
const LITTLE: u64 = 4 << 20;

impl<'b> Archive<'b> {
    pub fn new(bytes: &'b [u8]) -> Result<Archive<'b>, Fault> {
        let broken = |error| Fault::new(format!("it is no npz archive ({error})"), "write it with numpy.savez");
        let most = (bytes.len() as u64).saturating_mul(PACKED).max(LITTLE);
        Ok(Archive { zip: ZipArchive::new(Cursor::new(bytes)).map_err(broken)?, most })
    }

    /// The names of all arrays.
    pub fn names(&self) -> Vec<String> {
        self.zip.file_names().filter_map(|name| name.ok()?.strip_suffix(".npy").map(str::to_owned)).collect()
    }

    /// An array by its name; `None` if there is none.
    pub fn array(&mut self, name: &str) -> Result<Option<Array>, Fault> {
        let in_array = |fault: Fault| Fault { reason: format!("array `{name}`: {}", fault.reason), ..fault };
        let unreadable =
            |error: String| in_array(Fault::new(error, "write the file with numpy.savez or numpy.savez_compressed"));
        let Some(index) = self.zip.index_for_name(&format!("{name}.npy")) else { return Ok(None) };
        let file = self.zip.by_index(index).map_err(|error| unreadable(error.to_string()))?;
        if file.size() > self.most {
            let reason = format!("it would take {} bytes, {} are the limit for this file", file.size(), self.most);
            return Err(in_array(Fault::new(reason, "write it with numpy.savez, which does not pack")));
        }
        let mut bytes = Vec::new();
        file.take(self.most).read_to_end(&mut bytes).map_err(|error| unreadable(error.to_string()))?;
        Array::parse(&bytes).map(Some).map_err(in_array)
    }
}
