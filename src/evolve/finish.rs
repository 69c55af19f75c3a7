//! What becomes of a frame when its frames have settled: vertices move until edges have their lengths.

use super::error::EvolveError;
use super::progress::Observer;
use super::relax::Relaxation;
use super::report::whole;
use super::state::State;
use crate::immersion::{bending_angles, is_convex, pinch_points, rimless_frames};
use crate::mesh::VertexId;
use crate::polish::{Ending, Polish, PolishReport, Polished, Watch};
use crate::tuning::{ACCURATE_POLISH, FIRM_POLISH, GENTLE_POLISH, STIFF_POLISH};
use glam::{DQuat, DVec3};

/// Positions of the whole surface after polish, and what there is to say of them.
pub(super) struct Finished {
    /// |V|.
    pub positions: Vec<DVec3>,
    /// Frames of these positions, |F|; `None` where those of the state are nearer to how they were found.
    pub face_frames: Option<Vec<DQuat>>,
    pub report: PolishReport,
}

/// How far polish may go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// As little as it takes.
    Near,
    /// As far as it pays.
    Far,
}

/// Polishes each component of a surface, and lays it where it was.
///
/// # Errors
/// [`EvolveError::Stopped`] if the observer says so.
pub(super) fn finish(
    components: &[Relaxation],
    positions: &[DVec3],
    reach: Reach,
    max_bending_growth: f64,
    observer: &mut dyn Observer,
) -> Result<Finished, EvolveError> {
    let mut whole_positions = positions.to_vec();
    let faces = components.iter().map(|part| part.state().mesh().face_count()).sum();
    let mut face_frames = vec![DQuat::IDENTITY; faces];
    let mut reports = Vec::with_capacity(components.len());
    for relaxation in components {
        let state = relaxation.state();
        let own = state.component().vertices.pick(positions);
        let mut is_stopped = false;
        let polished = polished(relaxation, &own, reach, max_bending_growth, &mut |step| {
            let flow = observer.after_polish_step(step);
            is_stopped |= flow.is_break();
            flow
        });
        if is_stopped {
            return Err(EvolveError::Stopped { steps: relaxation.cursor().steps });
        }
        state.component().vertices.put(&polished.positions, &mut whole_positions);
        let own_frames = match polished.report.ending {
            Ending::Unchanged => state.face_frames().to_vec(),
            _ => rimless_frames(state.mesh(), state.metric(), state.shell(), &polished.positions),
        };
        state.component().faces.put(&own_frames, &mut face_frames);
        reports.push(polished.report);
    }
    let face_frames = (reach == Reach::Far).then_some(face_frames);
    Ok(Finished { positions: whole_positions, face_frames, report: whole(&reports, components) })
}

/// The polished component. A surface that is pinched, has rims or another class than it should is left alone, and what would
/// change the class of a star or a generator is refused.
fn polished(
    relaxation: &Relaxation,
    positions: &[DVec3],
    reach: Reach,
    max_bending_growth: f64,
    watch: &mut Watch,
) -> Polished {
    let state = relaxation.state();
    let pinned: Vec<VertexId> = state.pins().iter().map(|(v, _)| *v).collect();
    let unchanged = || Polished {
        positions: positions.to_vec(),
        report: PolishReport::unchanged(state.mesh(), state.metric(), positions),
    };
    if !is_in_class(state, positions) {
        return unchanged();
    }
    let rest = match state.target_angles() {
        Some((angles, _)) => Some(angles.to_vec()),
        // A shape that was asked for is kept.
        None if relaxation.placement().starts_from_shape() && reach == Reach::Far => {
            Some(bending_angles(state.mesh(), positions))
        }
        None => None,
    };
    let shells: &[f64] = match (reach, &rest) {
        (Reach::Far, None) if state.betti() > 0 => &STIFF_POLISH,
        (Reach::Far, None) => &FIRM_POLISH,
        _ => &GENTLE_POLISH,
    };
    let membranes: &[f64] = match rest {
        None if is_convex(state.mesh(), state.metric()) && pinned.is_empty() => &GENTLE_POLISH,
        _ => &[],
    };
    let attempts = membranes.iter().map(|stiffness| (true, *stiffness));
    let attempts = attempts.chain(shells.iter().map(|stiffness| (false, *stiffness)));
    let mut best = unchanged();
    for (is_membrane, stiffness) in attempts {
        let polish = Polish { stiffness, is_membrane, max_bending_growth, ..Polish::default() };
        let next = polish.apply(state.mesh(), state.metric(), positions, rest.as_deref(), &pinned, watch);
        let steps = best.report.steps + next.report.steps;
        let is_better = next.report.l2_length_error < best.report.l2_length_error;
        if is_better && is_in_class(state, &next.positions) {
            best = next;
        }
        best.report.steps = steps;
        if best.report.l2_length_error <= ACCURATE_POLISH {
            break;
        }
    }
    best
}

/// Whether a surface has no pinch points and is in the class that it should be in.
fn is_in_class(state: &State, positions: &[DVec3]) -> bool {
    pinch_points(state.mesh(), positions).is_empty() && state.class_at(positions) == *state.class()
}
