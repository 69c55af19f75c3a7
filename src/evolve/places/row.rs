//! Where the components of a surface stand beside each other.

use super::placement::{middle, next_in_row};
use crate::evolve::relax::Relaxation;
use glam::DVec3;

/// What decides where components stand.
pub(in crate::evolve) struct Row<'a> {
    /// Positions of the mesh, |V|, if it has any.
    pub mesh_positions: Option<&'a [DVec3]>,
    /// Those of the frame before, |V|.
    pub previous: Option<&'a [DVec3]>,
    pub is_looping: bool,
    /// Whether frames are steps of the relaxation.
    pub is_of_relaxation: bool,
}

impl Row<'_> {
    /// The positions of the whole surface, |V|. Of several components those that are laid upon nothing stand where the
    /// mesh has them, or else in a row.
    pub fn place(&self, components: &mut [Relaxation], vertices: usize) -> Vec<DVec3> {
        let mut whole = vec![DVec3::ZERO; vertices];
        let several = components.len() > 1;
        let mut row = 0.0;
        for relaxation in components {
            let own = &relaxation.state().component().vertices;
            let previous = self.previous.map(|previous| own.pick(previous));
            let (mut positions, is_laid) = relaxation.placed(previous, self.is_looping, self.is_of_relaxation);
            let own = &relaxation.state().component().vertices;
            if several && !is_laid {
                let shift = match self.mesh_positions {
                    Some(places) => middle(&own.pick(places)) - middle(&positions),
                    None => next_in_row(&positions, &mut row),
                };
                positions.iter_mut().for_each(|p| *p += shift);
            }
            own.put(&positions, &mut whole);
        }
        whole
    }
}
