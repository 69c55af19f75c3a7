//! The texts that a scene is put together of: its file, the files that it extends, and what is set beside them.

mod as_text;
mod chain;
mod merge;
mod read;
mod setting;
mod syntax;
mod text;

pub(super) use as_text::as_text;
pub(super) use chain::{Link, chain};
pub(super) use merge::{lay_over, move_paths, take_extends, without};
pub(super) use read::read_text;
pub(super) use setting::Setting;
pub(crate) use setting::split_setting;
pub(super) use text::{Texts, padding};
