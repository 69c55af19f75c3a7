//! Where the surface lies in space: films must not spin or jump.

use super::{Pace, Simulation};
use crate::immersion::RigidMotion;
use crate::scene::StartFrom;
use glam::DVec3;

/// How far a film may turn toward its reference from frame to frame.
const LARGEST_TURN_DEGREES: f64 = 2.0;

impl Simulation {
    /// Takes away the rigid motion that the metric leaves to every component without pins.
    ///
    /// The first frame is laid upon what it starts from, or along its principal axes. Every other one is laid upon the
    /// one before; where the mesh's positions have the metric of the start, it turns a little toward them, so that small
    /// turns do not add up. Films that loop, and those of the relaxation from random frames, are laid upon their
    /// reference from beginning to end.
    pub(super) fn place(&mut self, positions: &mut [DVec3]) {
        let relaxing_from_nowhere = self.seed.is_some() && matches!(self.pace, Pace::Steps(_));
        let mirrored = matches!(self.start, StartFrom::Mirror);
        // A mirror image is laid upon the original, for that is where it is going.
        let shape = self.shape.as_deref().filter(|_| !mirrored);
        let reference = shape.or(self.original.as_deref());
        let previous = self.previous.as_ref().map(|previous| previous.positions.as_slice());
        let always = self.clock.is_looping() || relaxing_from_nowhere;

        let areas = self.metric.vertex_areas(&self.mesh);
        let mut motions = vec![None; positions.len()];
        for vertices in self.parts.poisson.floating() {
            let of_component = |values: &[DVec3]| vertices.iter().map(|v| values[v.index()]).collect::<Vec<_>>();
            let weights: Vec<f64> = vertices.iter().map(|v| areas[v.index()]).collect();
            let points = of_component(positions);
            let onto = |ground: &[DVec3]| RigidMotion::onto(&of_component(ground), &points, &weights);
            let motion = match (previous, reference) {
                (None, Some(reference)) => onto(reference),
                (Some(_), Some(reference)) if always => onto(reference),
                (Some(previous), _) => match self.original.as_deref() {
                    None => onto(previous),
                    Some(original) => {
                        let center = points.iter().sum::<DVec3>() / points.len() as f64;
                        onto(previous).toward(&onto(original), LARGEST_TURN_DEGREES.to_radians(), center)
                    }
                },
                // On the way axes would swing about.
                (None, None) if relaxing_from_nowhere => continue,
                (None, None) => RigidMotion::to_principal_axes(&points, &weights),
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
