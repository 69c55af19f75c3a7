//! Where the surface lies in space: films must not spin or jump.

use super::{Pace, Simulation};
use crate::immersion::RigidMotion;
use glam::DVec3;

/// What a frame is laid upon.
#[derive(Clone, Copy)]
enum Ground<'a> {
    Positions(&'a [DVec3]),
    PrincipalAxes,
}

impl Simulation {
    /// Takes away the rigid motion that the metric leaves to every component without pins. The first frame is laid
    /// upon the positions it started from, or along its principal axes; every other one upon the one before. Only
    /// films that loop, and those of the relaxation from random frames, are laid upon the first positions as far as
    /// they are known: small turns would add up.
    pub(super) fn place(&mut self, positions: &mut [DVec3]) {
        let looping = self.clock.is_looping();
        let relaxing_from_nowhere = self.seed.is_some() && matches!(self.pace, Pace::Steps(_));
        let first = self.previous.is_none();
        let ground = match (&self.previous, self.shape.as_ref().or(self.original.as_ref())) {
            (_, Some(reference)) if first || looping || relaxing_from_nowhere => Ground::Positions(reference),
            (Some(previous), _) => Ground::Positions(&previous.positions),
            // On the way axes would swing about.
            (None, _) if relaxing_from_nowhere => return,
            (None, _) => Ground::PrincipalAxes,
        };
        let areas = self.metric.vertex_areas(&self.mesh);
        let mut motions = vec![None; positions.len()];
        for vertices in self.parts.poisson.floating() {
            let of_component = |values: &[DVec3]| vertices.iter().map(|v| values[v.index()]).collect::<Vec<_>>();
            let weights: Vec<f64> = vertices.iter().map(|v| areas[v.index()]).collect();
            let points = of_component(positions);
            let motion = match ground {
                Ground::Positions(ground) => RigidMotion::onto(&of_component(ground), &points, &weights),
                Ground::PrincipalAxes => RigidMotion::to_principal_axes(&points, &weights),
            };
            vertices.iter().for_each(|v| motions[v.index()] = Some(motion));
        }
        for (position, motion) in positions.iter_mut().zip(&motions) {
            *position = motion.map_or(*position, |motion| motion.point(*position));
        }
        for (f, frame) in self.mesh.faces().zip(&mut self.frames) {
            let motion = motions[self.mesh.corners(f)[0].index()];
            *frame = motion.map_or(*frame, |motion| motion.frame(*frame));
        }
    }
}
