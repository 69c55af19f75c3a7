//! Where the surface lies in space: films must not spin or jump.

use crate::evolve::program::Start;
use crate::evolve::state::State;
use crate::immersion::RigidMotion;
use crate::mesh::Mesh;
use crate::metric::{Metric, lengths_of_positions};
use crate::tuning::{GAP_BETWEEN_COMPONENTS, LARGEST_TURN_DEGREES};
use glam::DVec3;

/// What a component is laid upon, besides the frame before.
#[derive(Clone, Debug)]
pub(in crate::evolve) struct Placement {
    /// Positions of the mesh, |V|, where the metric at the start is theirs.
    original: Option<Vec<DVec3>>,
    /// Positions that frames start from, |V|.
    start: Option<Vec<DVec3>>,
    /// Whether those are the mirror image of where the film is going.
    is_mirrored: bool,
}

/// What a component is laid upon now.
struct Ground<'a> {
    /// The frame before.
    previous: Option<Vec<DVec3>>,
    /// What the film begins with, or is going to.
    reference: Option<&'a [DVec3]>,
    /// See [`Placement::original`].
    original: Option<&'a [DVec3]>,
    /// Whether every frame is laid upon the reference, not upon the one before.
    always: bool,
    /// Whether the film shows how random frames relax: on the way principal axes would swing about.
    from_nowhere: bool,
}

impl Placement {
    /// Of a component with this metric at the start; `positions` are those of the mesh, if it has any.
    pub fn new(mesh: &Mesh, metric: &Metric, start: &Start, positions: Option<Vec<DVec3>>) -> Placement {
        Placement {
            original: positions.filter(|positions| are_lengths_of(mesh, metric, positions)),
            start: start.positions().map(<[DVec3]>::to_vec),
            is_mirrored: matches!(start, Start::Shape { is_mirrored: true, .. }),
        }
    }

    /// Positions of the mesh, |V|, where the metric at the start is theirs.
    pub fn original(&self) -> Option<&[DVec3]> {
        self.original.as_deref()
    }

    /// Whether nothing says where the surface lies, so that it is laid along its principal axes.
    pub fn is_free(&self, state: &State) -> bool {
        self.original.is_none() && self.start.is_none() && state.pins().is_empty()
    }

    /// Whether frames start from positions.
    pub fn starts_from_shape(&self) -> bool {
        self.start.is_some()
    }

    /// Integrates the frames of a component to positions, |V|, with the rigid motion taken away that the metric leaves
    /// to it, and turns the frames along. Says whether it was laid upon anything.
    ///
    /// The first frame is laid upon what it starts from, or along its principal axes. Every other one is laid upon the
    /// one before; where the mesh's positions have the metric of the start, it turns a little toward them, so that small
    /// turns do not add up. Films that loop, and those of the relaxation from random frames, are laid upon their
    /// reference from beginning to end (`always`). Pins leave no rigid motion.
    pub fn place(
        &self,
        state: &mut State,
        previous: Option<Vec<DVec3>>,
        always: bool,
        from_nowhere: bool,
    ) -> (Vec<DVec3>, bool) {
        let mut positions = state.integrate();
        if !state.pins().is_empty() {
            return (positions, true);
        }
        // A mirror image is laid upon the original, for that is where it is going.
        let start = self.start.as_deref().filter(|_| !self.is_mirrored);
        let original = self.original();
        let ground = Ground { previous, reference: start.or(original), original, always, from_nowhere };
        let is_laid = ground.previous.is_some() || ground.reference.is_some();
        let weights = state.metric().vertex_areas(state.mesh());
        if let Some(motion) = ground.motion(&positions, &weights) {
            positions.iter_mut().for_each(|p| *p = motion.point(*p));
            let (_, frames) = state.shell_and_frames();
            frames.iter_mut().for_each(|frame| *frame = motion.frame(*frame));
        }
        (positions, is_laid)
    }
}

impl Ground<'_> {
    /// The motion that lays positions upon this; `None` leaves them.
    fn motion(&self, positions: &[DVec3], weights: &[f64]) -> Option<RigidMotion> {
        let onto = |ground: &[DVec3]| RigidMotion::onto(ground, positions, weights);
        match (self.previous.as_deref(), self.reference) {
            (None, Some(reference)) => Some(onto(reference)),
            (Some(_), Some(reference)) if self.always => Some(onto(reference)),
            (Some(previous), _) => Some(match self.original {
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

/// Whether the lengths of a metric are those of positions, up to rounding.
fn are_lengths_of(mesh: &Mesh, metric: &Metric, positions: &[DVec3]) -> bool {
    let lengths = lengths_of_positions(mesh, positions);
    metric.edge_lengths().iter().zip(lengths).all(|(a, b)| (a - b).abs() <= 1e-9 * a)
}

/// The mean of some points.
pub(in crate::evolve) fn middle(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len() as f64
}

/// What moves positions to the end of a row along x that ends at `row`, which grows by them.
pub(in crate::evolve) fn next_in_row(positions: &[DVec3], row: &mut f64) -> DVec3 {
    let (low, high) = positions.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.x), high.max(p.x)));
    let begin = if *row == 0.0 { low } else { *row };
    *row = begin + (1.0 + GAP_BETWEEN_COMPONENTS) * (high - low);
    DVec3::X * (begin - low)
}
