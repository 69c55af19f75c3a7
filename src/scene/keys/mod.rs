//! How the keys of a scene are read: tables and the kinds of values they hold, each described as it is read.

mod choice;
mod files;
mod names;
mod number;
mod problems;
mod spelling;
mod table;
mod value;

pub(super) use files::files;
pub(super) use names::Boundary;
pub(super) use number::{ease, extrapolation, one_per_time, times};
pub(super) use problems::{LISTED, Problem, Problems};
pub(crate) use spelling::{nearest, suggestion};
pub(super) use table::{Table, declared};
pub(super) use value::{Bounds, Color, Field, Kind, PATHS, Variant};
