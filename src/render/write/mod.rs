//! Pictures as files.

mod file;
mod metadata;
mod openexr;
mod png;

pub use metadata::Metadata;
pub use png::Png;
