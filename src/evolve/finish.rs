//! What becomes of a frame when its frames have settled: vertices move until edges have their lengths.

use super::error::EvolveError;
use super::pace::Pace;
use super::program::Polishing;
use super::progress::Observer;
use super::relax::Relaxation;
use super::state::State;
use crate::immersion::{RigidMotion, bending_angles, is_convex, pinch_points, rimless_frames};
use crate::mesh::VertexId;
use crate::polish::{Ending, Polish, PolishReport, Polished, Watch};
use crate::tuning::{
    ACCURATE_POLISH, FIRM_POLISH, GENTLE_POLISH, GOOD_FIT, LEAST_BARRIER, MEMBRANE_HOLD, NEAR_ENOUGH, NEAR_POLISH,
    REHEATING, ROUND_STIFFNESS, ROUNDS, STIFF_NEAR_POLISH, STIFF_POLISH,
};
use glam::{DQuat, DVec3};

/// Positions of the whole surface after polish, and what there is to say of them.
pub(super) struct Finished {
    /// |V|.
    pub positions: Vec<DVec3>,
    /// Frames of these positions, |F|; `None` where those of the state are nearer to how they were found.
    pub face_frames: Option<Vec<DQuat>>,
    /// Per component; none where nothing was polished.
    pub reports: Vec<PolishReport>,
}

impl Finished {
    /// Positions as frames integrate to.
    pub fn unpolished(positions: Vec<DVec3>) -> Finished {
        Finished { positions, face_frames: None, reports: Vec::new() }
    }
}

/// Which frame, from 1, of how many, and how the film passes from one to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Which {
    pub frame: usize,
    pub of: usize,
    pub pace: Pace,
}

impl Polishing {
    /// How far polish may go with a frame; `None` if it is not to be polished, or is not relaxed yet.
    pub(super) fn reach(self, Which { frame, of, pace }: Which, components: &[Relaxation]) -> Option<Reach> {
        if components.iter().any(Relaxation::is_on_the_way) {
            return None;
        }
        let nothing_follows = of == 1 || matches!(pace, Pace::EachClass);
        match self {
            Polishing::Off => None,
            Polishing::Last | Polishing::Every if nothing_follows => Some(Reach::Alone),
            Polishing::Last => (frame == of).then_some(Reach::Far),
            Polishing::Every => Some(Reach::Near),
        }
    }
}

/// How far polish may go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// As little as it takes.
    Near,
    /// As far as it pays.
    Far,
    /// As far as it pays, and it may lie otherwise than before, since no frame is beside it.
    Alone,
}

/// Polishes each component of a surface, and lays it where it was.
///
/// # Errors
/// [`EvolveError::Stopped`] if the observer says so.
pub(super) fn finish(
    components: &[Relaxation],
    mut positions: Vec<DVec3>,
    reach: Reach,
    max_bending_growth: f64,
    observer: &mut dyn Observer,
) -> Result<Finished, EvolveError> {
    let faces = components.iter().map(|part| part.state().mesh().face_count()).sum();
    let mut face_frames = vec![DQuat::IDENTITY; faces];
    let mut reports = Vec::with_capacity(components.len());
    for relaxation in components {
        let state = relaxation.state();
        let own = state.component().vertices.pick(&positions);
        let mut is_stopped = false;
        let mut polished = polished(relaxation, &own, reach, max_bending_growth, &mut |step| {
            let flow = observer.after_polish_step(step);
            is_stopped |= flow.is_break();
            flow
        });
        if is_stopped {
            return Err(EvolveError::Stopped { steps: relaxation.cursor().steps });
        }
        if reach == Reach::Alone && components.len() == 1 && relaxation.placement().is_free(state) {
            let motion =
                RigidMotion::to_principal_axes(&polished.positions, &state.metric().vertex_areas(state.mesh()));
            polished.positions.iter_mut().for_each(|p| *p = motion.point(*p));
        }
        state.component().vertices.put(&polished.positions, &mut positions);
        if reach != Reach::Near {
            let own_frames = match polished.report.ending {
                Ending::Unchanged => state.face_frames().to_vec(),
                _ => rimless_frames(state.mesh(), state.metric(), state.shell(), &polished.positions),
            };
            state.component().faces.put(&own_frames, &mut face_frames);
        }
        reports.push(polished.report);
    }
    let face_frames = (reach != Reach::Near).then_some(face_frames);
    Ok(Finished { positions, face_frames, reports })
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
        None if relaxation.placement().starts_from_shape() && reach != Reach::Near => {
            Some(bending_angles(state.mesh(), positions))
        }
        None => None,
    };
    let mut best = unchanged();
    let before = best.report;
    for Attempt { polish, goes_on, enough } in attempts(relaxation, reach, rest.is_some(), before.l2_length_error) {
        if best.report.l2_length_error <= enough {
            break;
        }
        let (from, bending) = match goes_on {
            true => (best.positions.as_slice(), best.report.mean_bending),
            false => (positions, before.mean_bending),
        };
        let most_bending = (1.0 + max_bending_growth) * before.mean_bending;
        let growth = if bending > 0.0 { most_bending / bending - 1.0 } else { max_bending_growth };
        let polish = Polish { max_bending_growth: growth, ..polish };
        let next = polish.apply(state.mesh(), state.metric(), from, rest.as_deref(), &pinned, watch);
        let steps = best.report.steps + next.report.steps;
        let is_better = next.report.l2_length_error < best.report.l2_length_error;
        if is_better && is_in_class(state, &next.positions) {
            let PolishReport { l2_length_error, mean_bending, ending, .. } = next.report;
            best.positions = next.positions;
            best.report = PolishReport { l2_length_error, mean_bending, ending, ..before };
        }
        best.report.steps = steps;
    }
    best
}

/// A way that polish may take.
struct Attempt {
    polish: Polish,
    /// Whether it begins with the best surface so far, not with the one that is to be polished.
    goes_on: bool,
    /// L2 length error at which it is not taken any more.
    enough: f64,
}

/// The ways that polish tries on a component with such an error, one after another.
fn attempts(relaxation: &Relaxation, reach: Reach, has_rest: bool, error: f64) -> Vec<Attempt> {
    let state = relaxation.state();
    let usual = Polish::default();
    let of = |polish| Attempt { polish, goes_on: false, enough: ACCURATE_POLISH };
    let mut all = Vec::new();
    if !has_rest && state.pins().is_empty() && is_convex(state.mesh(), state.metric()) {
        all.push(of(Polish { stiffness: MEMBRANE_HOLD, is_membrane: true, ..usual }));
    }
    match reach {
        Reach::Near => {
            let (hold, fade, max_steps) = NEAR_POLISH;
            all.push(of(Polish { stiffness: hold, is_membrane: true, fade, max_steps, ..usual }));
            let (stiffness, fade, max_steps) = STIFF_NEAR_POLISH;
            let enough = NEAR_ENOUGH * error;
            all.push(Attempt { enough, ..of(Polish { stiffness, fade, max_steps, ..usual }) });
        }
        Reach::Far | Reach::Alone if has_rest => all.push(of(Polish { stiffness: GENTLE_POLISH, ..usual })),
        Reach::Far | Reach::Alone if state.betti() == 0 => all.push(of(Polish { stiffness: FIRM_POLISH, ..usual })),
        Reach::Far | Reach::Alone => {
            all.extend(STIFF_POLISH.map(|(stiffness, fade)| of(Polish { stiffness, fade, ..usual })));
            let kept_open = Polish { least_barrier: LEAST_BARRIER, ..usual };
            all.push(Attempt { goes_on: true, ..of(Polish { stiffness: REHEATING, ..kept_open }) });
            all.iter_mut().skip(2).for_each(|attempt| attempt.enough = GOOD_FIT);
            all.push(Attempt {
                goes_on: true,
                ..of(Polish { stiffness: ROUND_STIFFNESS, rounds: ROUNDS, ..kept_open })
            });
        }
    }
    all
}

/// Whether a surface has no pinch points and is in the class that it should be in.
fn is_in_class(state: &State, positions: &[DVec3]) -> bool {
    pinch_points(state.mesh(), positions).is_empty() && state.class_at(positions) == *state.class()
}
