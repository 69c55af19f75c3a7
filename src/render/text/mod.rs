//! Labels on pictures.
//!
//! The font is Inter (SIL Open Font License, `Inter-LICENSE.txt`), cut down with fontTools to Latin and Greek letters,
//! digits, signs, superscripts and subscripts. Its digits are the tabular ones, so that numbers that change from frame
//! to frame stand still, and its kerning pairs have been copied from `GPOS` to a `kern` table.

mod draw;
mod layout;
mod template;

pub(super) use draw::MIDDLE_GREY;
pub use draw::{Anchor, TextStyle};
pub use layout::text_width;
pub use template::fill_in;

/// Height of capitals and digits in units of the size of a text.
pub(super) const CAPITAL_HEIGHT: f32 = 0.7275;
