//! `[polish]`

use crate::evolve::Polishing;
use crate::scene::data::PolishSection;
use crate::scene::keys::Table;

pub(super) fn polish(table: &mut Table) -> PolishSection {
    let default = PolishSection::default();
    PolishSection {
        enabled: table.key("enabled", ENABLED).optional(Polishing::Every),
        max_bending_growth: table
            .key("max_bending_growth", "By which share polish may make the mean bending angle grow; where it would take more, lengths stay as they can be.")
            .at_least(0.0)
            .or(default.max_bending_growth),
    }
}

const ENABLED: &str = "Whether vertices are moved, when frames have settled, until edges have their lengths: in every frame, in none, or in the last one \
     only. Left out, a static scene is polished, and every class of class = \"all\", unless there are more than 200000 faces or `accuracy` says \
     what is enough; films are not.";
