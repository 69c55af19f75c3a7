//! Where components lie in space.

mod placement;
mod row;

pub(super) use placement::Placement;
pub(super) use row::Row;
