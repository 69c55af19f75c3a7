//! Arrays as NumPy keeps them: one in a file (`.npy`), or several with names in a zip archive (`.npz`).
//!
//! What this program writes has one form, which [`ArrayReader`] knows to the byte. What others write has many, and
//! [`Array`] reads those that are tables of numbers.

mod array;
mod exact;
mod fault;
mod header;

pub(crate) use array::{Archive, Array, Numbers, is_archive, is_array};
pub(crate) use exact::{ArrayReader, ArrayWriter};
pub(crate) use fault::Fault;
