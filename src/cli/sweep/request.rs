//! What is asked of a sweep.

use std::path::Path;

/// What is asked for, as it was typed.
pub(in crate::cli) struct Request<'a> {
    pub scene: &'a Path,
    pub mesh: Option<&'a Path>,
    pub set: &'a [String],
    pub out: Option<&'a Path>,
    pub restart: bool,
}
