//! Which triangle or tube each sample of a pixel sees.

mod bins;
mod draw;
mod filter;
mod fragments;
mod gaps;
mod lanes;
mod region;
mod sample_tile;
mod samples;
mod seen;
mod tube;

pub use bins::{Bins, Tiles};
pub use draw::{Target, draw};
pub use filter::{Filter, LightTile};
pub use fragments::{Gatherer, composited};
pub use gaps::Gaps;
pub use region::Region;
pub use sample_tile::{FIRST_TUBE, MARGIN, NOTHING, SampleTile, TILE};
pub use samples::SamplePattern;
pub use seen::{Seen, dominant_of, nearest};
pub use tube::{ScreenTube, Stroke};
