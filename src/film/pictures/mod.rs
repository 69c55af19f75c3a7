//! From the frames of a film to its pictures.
//!
//! A [`Plan`] is what a scene asks of its pictures, validated before anything is computed. A survey passes over the frames
//! once for their extents, so that one camera holds for the whole film whichever of its frames are wanted. Then shots are
//! taken, several at a time as memory allows, written as they are done, and handed in order to moving pictures. The files are
//! the same bytes for any number of threads, and whether or not frames are still being computed meanwhile ([`Arrivals`]).

mod films;
mod keys;
mod labels;
mod loops;
mod passes;
mod plan;
mod quantities;
mod sheet;
mod sheets;
mod shoot;
mod shots;
mod single;
mod stills;
mod subject;
mod trial;
mod views;

pub use films::{Tile, make_sheet_of_films};
pub use keys::RENDERER;
pub use passes::{Arrivals, Event, Watch};
pub(super) use passes::{at_a_time, in_order};
pub use plan::Plan;
pub use sheets::{make_look_sheet, make_poster};
pub(super) use single::{PREVIEW, small_picture};
pub use single::{make_preview, take_picture};
pub(super) use stills::SHEET;
pub use stills::{Pictured, make_pictures, make_pictures_of_arrivals, make_stills_beside_others};
pub use trial::{PictureCost, try_a_picture};
pub(super) use views::Views;
