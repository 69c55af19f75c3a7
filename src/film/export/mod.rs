//! From the frames of a film to files that other programs open.
//!
//! A [`Subject`](subject::Subject) is what is the same in all frames, a [`Moment`](subject::Moment) one of them, with what the format
//! wants of it and no more. Frames are read a few at a time and written in order, so that a film of any length takes the memory of a
//! few frames. A format that has all frames in one file gives each in pieces, one for every part of the file in which all frames follow
//! each other; the pieces wait in temporary files (`spool`), and the file is put together at the end.

mod camera;
mod colors;
mod fold;
mod format;
mod gltf;
mod layout;
mod npz;
mod obj;
mod pc2;
mod ply;
mod spool;
mod subject;
mod usd;
mod view;
mod vtk;
mod work;

pub use work::{EXPORTER, Exported, export};
