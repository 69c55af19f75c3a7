//! Writes meshes to files.

mod error;
mod obj;
mod whole_file;

pub use error::WriteError;
pub use obj::write_obj;
