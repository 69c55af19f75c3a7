//! One file per format, each from bytes to what they say.

pub(super) mod arrays;
pub(super) mod fold;
mod fold_frames;
pub(super) mod obj;
pub(super) mod off;
pub(super) mod ply;
mod ply_header;
mod polygons;
pub(super) mod stl;
