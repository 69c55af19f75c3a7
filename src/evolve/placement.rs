//! Where the surface lies in space: films must not spin or jump.

use super::relaxation::Relaxation;
use super::{Pace, Simulation};
use crate::immersion::RigidMotion;
use crate::scene::StartFrom;
use glam::DVec3;

/// How far a film may turn toward its reference from frame to frame.
const LARGEST_TURN_DEGREES: f64 = 2.0;
/// Room between components that nothing says the places of, as a share of their extents.
const GAP: f64 = 0.25;

/// What a component is laid upon.
struct Ground<'a> {
    /// The frame before.
    previous: Option<Vec<DVec3>>,
    /// What the film begins with, or is going to.
    reference: Option<&'a [DVec3]>,
    /// Whether every frame is laid upon the reference, not upon the one before.
    always: bool,
    /// Whether the film shows how random frames relax: on the way principal axes would swing about.
    from_nowhere: bool,
}

impl Simulation {
    /// The positions of the whole surface, with the rigid motion taken away that the metric leaves to every component
    /// without pins.
    ///
    /// The first frame is laid upon what it starts from, or along its principal axes. Every other one is laid upon the
    /// one before; where the mesh's positions have the metric of the start, it turns a little toward them, so that small
    /// turns do not add up. Films that loop, and those of the relaxation from random frames, are laid upon their
    /// reference from beginning to end.
    ///
    /// Of several components those that are laid upon nothing stand where the mesh has them, or else in a row.
    pub(super) fn placed(&mut self) -> Vec<DVec3> {
        let mut whole = vec![DVec3::ZERO; self.mesh.vertex_count()];
        let several = self.components.len() > 1;
        let mut row = 0.0;
        for relaxation in &mut self.components {
            let mut positions = relaxation.integrate();
            let vertices = &relaxation.component.vertices;
            let previous = self.previous.as_ref().map(|previous| vertices.pick(&previous.positions));
            let from_nowhere = relaxation.seed.is_some() && matches!(self.pace, Pace::Steps(_));
            let always = self.clock.is_looping() || from_nowhere;
            let is_laid = relaxation.place(&mut positions, previous, always, from_nowhere);
            if several && !is_laid {
                let vertices = &relaxation.component.vertices;
                let shift = match &self.mesh_positions {
                    Some(places) => middle(&vertices.pick(places)) - middle(&positions),
                    None => next_in_row(&positions, &mut row),
                };
                positions.iter_mut().for_each(|p| *p += shift);
            }
            relaxation.component.vertices.put(&positions, &mut whole);
        }
        whole
    }
}

impl Relaxation {
    /// Moves positions and frames to where the component lies; says whether it was laid upon anything.
    fn place(
        &mut self,
        positions: &mut [DVec3],
        previous: Option<Vec<DVec3>>,
        always: bool,
        from_nowhere: bool,
    ) -> bool {
        if !self.places.is_empty() {
            return true;
        }
        // A mirror image is laid upon the original, for that is where it is going.
        let shape = self.shape.as_deref().filter(|_| !matches!(self.start, StartFrom::Mirror));
        let ground = Ground { previous, reference: shape.or(self.original.as_deref()), always, from_nowhere };
        let is_laid = ground.previous.is_some() || ground.reference.is_some();
        let weights = self.metric.vertex_areas(&self.component.mesh);
        if let Some(motion) = ground.motion(positions, &weights, self.original.as_deref()) {
            positions.iter_mut().for_each(|p| *p = motion.point(*p));
            self.face_frames.iter_mut().for_each(|frame| *frame = motion.frame(*frame));
        }
        is_laid
    }
}

impl Ground<'_> {
    /// The motion that lays positions upon this; `None` leaves them.
    fn motion(&self, positions: &[DVec3], weights: &[f64], original: Option<&[DVec3]>) -> Option<RigidMotion> {
        let onto = |ground: &[DVec3]| RigidMotion::onto(ground, positions, weights);
        match (self.previous.as_deref(), self.reference) {
            (None, Some(reference)) => Some(onto(reference)),
            (Some(_), Some(reference)) if self.always => Some(onto(reference)),
            (Some(previous), _) => Some(match original {
                None => onto(previous),
                Some(original) => {
                    let center = middle(positions);
                    onto(previous).toward(&onto(original), LARGEST_TURN_DEGREES.to_radians(), center)
                }
            }),
            (None, None) if self.from_nowhere => None,
            (None, None) => Some(RigidMotion::to_principal_axes(positions, weights)),
        }
    }
}

fn middle(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len() as f64
}

/// What moves positions to the end of a row along x that ends at `row`, which grows by them.
fn next_in_row(positions: &[DVec3], row: &mut f64) -> DVec3 {
    let (low, high) = positions.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.x), high.max(p.x)));
    let begin = if *row == 0.0 { low } else { *row };
    *row = begin + (1.0 + GAP) * (high - low);
    DVec3::X * (begin - low)
}
