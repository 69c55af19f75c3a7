//! Writes meshes to files.

mod error;
mod obj;

pub use error::WriteError;
pub use obj::write_obj;
