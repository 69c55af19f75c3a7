//! Pictures as files.

mod file;
mod metadata;
mod openexr;
mod png;

pub(crate) use file::temporary_beside;
pub use metadata::Metadata;
pub use png::Png;
