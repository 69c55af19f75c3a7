//! Moving pictures of a whole film: GIF, animated PNG and MP4.

mod apng;
mod begin;
mod draft;
mod gif;
#[cfg(feature = "mp4")]
mod mp4;
mod palette;
mod reeling;

pub(super) use begin::{begin, file_name};
pub(super) use gif::note as gif_note;
pub(super) use palette::Palette;
pub(super) use reeling::{Animation, Reeling};
