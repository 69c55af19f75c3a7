//! Which primitive a pixel sees.

use super::{
    fragments::Fragment,
    sample_tile::{NOTHING, SampleTile},
};

/// What is known of a finished pixel besides its light.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The primitive that most of its samples see, or the nearest one if one can see through.
    pub id: u32,
    /// The nearest depth of those samples.
    pub depth: f32,
}

impl Seen {
    pub const NOTHING: Seen = Seen { id: NOTHING, depth: 0.0 };
}

/// For every pixel of a tile the primitive that most samples see, the first of equals, and its nearest depth.
pub fn dominant_of<const S: usize>(samples: &SampleTile<S>) -> Vec<Seen> {
    let dominant = |pixel: usize| {
        let (ids, depths) = (samples.ids(pixel), samples.depths(pixel));
        let count = |id: u32| ids.iter().filter(|&&other| other == id).count();
        let seen = ids.iter().copied().filter(|&id| id != NOTHING);
        let Some(id) = seen.reduce(|best, id| if count(id) > count(best) { id } else { best }) else {
            return Seen::NOTHING;
        };
        let nearest = ids.iter().zip(depths).filter(|(other, _)| **other == id).map(|(_, depth)| *depth);
        Seen { id, depth: nearest.fold(0.0, f32::max) }
    };
    (0..(samples.outer.width() * samples.outer.height()) as usize).map(dominant).collect()
}

/// The nearest fragment, the first of equals, or what is opaque if that is nearer.
pub fn nearest<const S: usize>(fragments: &[Fragment<S>], opaque: Seen) -> Seen {
    fragments.iter().fold(opaque, |seen, fragment| {
        let depth = fragment.nearest();
        if depth > seen.depth { Seen { id: fragment.id, depth } } else { seen }
    })
}
