//! What is drawn over a finished picture: labels, legends, and marks around places.
//!
//! The font is Inter (SIL Open Font License, `Inter-LICENSE.txt`), cut down with fontTools to Latin and Greek letters,
//! digits, signs, superscripts and subscripts. Its digits are the tabular ones, so that numbers that change from frame
//! to frame stand still, and its kerning pairs have been copied from `GPOS` to a `kern` table.

mod canvas;
mod draw;
mod layout;
mod legend;
mod marks;
mod overlay;
mod sizes;
mod template;
mod ticks;

pub use draw::{Anchor, TextStyle};
pub use layout::text_width;
pub use legend::Legend;
pub use overlay::{Corner, Overlay};
pub use template::fill_in;
