//! From a film on disk to pictures: stills, moving pictures and contact sheets.
//!
//! A [`Plan`] is what a scene asks of its pictures, validated before anything is computed. The frames are passed over
//! once for their extents, so that one camera holds for the whole film whichever of its frames are wanted. Then
//! pictures are made, several at a time as memory allows, written as they are done, and handed in order to moving
//! pictures. The files are the same bytes for any number of threads, and whether or not frames are still being computed
//! meanwhile ([`Arrivals`]).

mod animation;
mod apng;
mod arrivals;
mod coordinates;
mod error;
mod gif;
mod in_order;
mod labels;
mod leftovers;
#[cfg(feature = "mp4")]
mod mp4;
mod pictures;
mod plan;
mod quantities;
mod reel;
mod sheet;
mod shots;
mod subject;

pub use arrivals::Arrivals;
pub use error::MovieError;
pub use leftovers::{Leftovers, clear_leftovers};
pub use pictures::{Event, Watch, make_look_sheet, make_pictures, make_pictures_of_arrivals, make_poster};
pub use plan::Plan;
