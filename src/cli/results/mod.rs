//! What a film is worth: tables, curves, checks, and the verdict at the end.

mod checks;
mod curves;
mod findings;
mod inspect;
mod text_table;
mod verdict;

pub(super) use checks::ranges;
pub use checks::{Check, check_of_homotopy, checks_of, step_limit_line};
pub(super) use curves::write_curves;
pub use curves::{curves_csv, curves_svg};
pub(super) use findings::findings;
pub(super) use inspect::Inspection;
pub(super) use text_table::{percent, write_table};
pub use verdict::verdict;
