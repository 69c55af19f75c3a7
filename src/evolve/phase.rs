//! The schedule of a relaxation: ε, Δt and feedback by stages (Eq. 21).

use crate::frames::{Method, StepOptions};
use crate::scene::{AtKey, MethodName, PhaseSection, Scene, StartFrom};

/// One stage: steps of one kind until frames stand still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// What each step is taken with.
    pub step: StepOptions,
    /// If Δt changes from step to step: the mean turn per step in radians that it aims at.
    pub turn_radians: Option<f64>,
    /// How far the frame of a face of mean area moves toward that of the integrated surface, 0 to 1 (Alg. 8).
    pub feedback: f64,
    /// How far frames move toward those of edge vectors without periods, 0 to 1.
    pub periods: f64,
    /// Whether steps are combined with earlier ones (Anderson acceleration).
    pub accelerate: bool,
    /// Mean turn per step in radians below which the stage has converged.
    pub tolerance_radians: f64,
    /// Least number of steps.
    pub min_steps: usize,
    /// After this many the stage has not converged,
    pub max_steps: usize,
    /// or, as long as there are rims, after this many more.
    pub untangle_steps: usize,
}

impl Phase {
    /// From a scene's `[[phase]]`.
    pub fn from_scene(section: &PhaseSection) -> Phase {
        Phase {
            step: StepOptions {
                method: match section.method {
                    MethodName::Implicit => Method::Implicit,
                    MethodName::Gradient => Method::Gradient,
                    MethodName::Newton => Method::Newton,
                },
                stiffness: section.epsilon,
                crease: section.crease,
                dt: section.dt,
                solver_tolerance: SOLVER_TOLERANCE,
            },
            turn_radians: section.turn.map(f64::to_radians),
            feedback: section.feedback,
            periods: section.periods,
            accelerate: section.accelerate,
            tolerance_radians: section.tolerance.to_radians(),
            min_steps: section.min_steps,
            max_steps: section.max_steps,
            untangle_steps: section.untangle_steps,
        }
    }
}

impl Phase {
    /// Δt of the next step, after one of this length that turned frames by so much.
    pub(super) fn next_dt(&self, dt: f64, turn: f64) -> f64 {
        match self.turn_radians {
            None => dt,
            Some(target) => (dt * (target / turn).clamp(SLOWER, FASTER)).clamp(SHORTEST_STEP, LONGEST_STEP),
        }
    }

    /// What a step of this length is taken with. On the `way` to a later stage a rough solution of the linear system
    /// leads as far as an exact one, as long as frames turn by much, as they did in the last step.
    pub(super) fn options(&self, dt: f64, way: bool, turn: f64) -> StepOptions {
        let rough = way && self.step.method == Method::Implicit;
        let looser = if rough { (turn / SETTLED_TURN).clamp(1.0, LOOSEST) } else { 1.0 };
        StepOptions { dt, solver_tolerance: self.step.solver_tolerance * looser, ..self.step }
    }

    /// Whether the stage may end after a step of this length: one whose steps get longer as long as frames turn little
    /// has to go on until they get no longer.
    pub(super) fn may_settle(&self, dt: f64) -> bool {
        self.turn_radians.is_none() || dt >= LONGEST_STEP
    }
}

/// How much Δt may change from one step to the next.
const SLOWER: f64 = 0.5;
const FASTER: f64 = 1.5;
/// Δt in mean face areas when it is chosen by the turn. Longer steps gain nothing.
const SHORTEST_STEP: f64 = 0.1;
const LONGEST_STEP: f64 = 1e3;

/// Why a scene has no phases.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum PhaseError {
    #[error(
        "there is no default phase {index}: {}; write `index` from 1 to {count}",
        if *count == 1 { "frames that start from a shape have but one".to_owned() } else { format!("there are {count}") }
    )]
    NoSuchPhase { index: usize, count: usize },
    #[error("default phase {index} is changed twice; write both changes into one [[phase]]")]
    Twice { index: usize },
    #[error("all default phases are changed twice; write both changes into one [[phase]], or give one an `index`")]
    AllTwice,
    #[error(
        "this [[phase]] is a new one, and others change default phases by `index`, so its place is not known; give it an \
         `index`, or give none"
    )]
    Mixed,
    #[error("`min_steps` of default phase {index} is then {least}, more than its `max_steps`, {most}; change both")]
    Steps { index: usize, least: usize, most: usize },
    #[error(
        "`bending_stiffness` and `epsilon` of the last [[phase]] both say how stiff bending is in the end; remove one of \
         them"
    )]
    TwoStiffnesses,
}

/// The stages of a scene on a surface with so many faces, with every key. Without any of its own they are the default
/// ones, which its `[[phase]]` may change. Frames that start from positions are near to where they belong; they need only
/// the last stage, and the stiffness of the earlier ones would iron out what the positions say.
///
/// # Errors
/// [`PhaseError`] with the key of the scene that is at fault.
pub fn phase_sections(scene: &Scene, faces: usize) -> Result<Vec<PhaseSection>, AtKey<PhaseError>> {
    let defaults = match scene.start.from {
        StartFrom::Random(_) | StartFrom::Spectral => default_sections(faces),
        StartFrom::Mesh | StartFrom::Mirror | StartFrom::File(_) => vec![PhaseSection::default()],
    };
    let mut phases = if scene.phases.is_empty() { defaults } else { changed(&scene.phases, defaults)? };
    if let (Some(stiffness), Some((last, earlier))) = (scene.relaxation.bending_stiffness, phases.split_last_mut()) {
        let is_of_last = |(k, section): (usize, &PhaseSection)| match &section.like {
            None => k + 1 == scene.phases.len(),
            Some(like) => like.index.is_none_or(|index| index == earlier.len() + 1),
        };
        let says_epsilon = |k: usize| scene.source.locate(&format!("phase[{k}].epsilon")).is_some();
        let is_said_twice = (0..).zip(&scene.phases).any(|(k, section)| is_of_last((k, section)) && says_epsilon(k));
        if is_said_twice && last.epsilon[1] != stiffness {
            return Err(AtKey { key: "bending.bending_stiffness".into(), error: PhaseError::TwoStiffnesses });
        }
        last.epsilon[1] = stiffness;
        earlier.iter_mut().for_each(|phase| phase.epsilon[1] = phase.epsilon[1].max(stiffness));
    }
    Ok(phases)
}

/// What the sections of a scene make of the default phases.
fn changed(sections: &[PhaseSection], defaults: Vec<PhaseSection>) -> Result<Vec<PhaseSection>, AtKey<PhaseError>> {
    let at = |k: usize, key: &str, error| Err(AtKey { key: format!("phase[{k}]{key}"), error });
    let index = |section: &PhaseSection| section.like.as_ref().and_then(|like| like.index);
    let count = defaults.len();
    let mut all_like = sections.iter().enumerate().filter(|(_, s)| s.like.is_some() && index(s).is_none());
    if let Some((k, _)) = all_like.nth(1) {
        return at(k, ".like", PhaseError::AllTwice);
    }
    let has_index = sections.iter().any(|section| index(section).is_some());
    let mut phases = if has_index { defaults.clone() } else { Vec::new() };
    let mut seen = vec![false; count];
    // What is said of all holds first, and what is said of one in place of it.
    let ordered = |k: &usize| (index(&sections[*k]).is_some(), *k);
    let mut order: Vec<usize> = (0..sections.len()).collect();
    order.sort_by_key(|k| if has_index { ordered(k) } else { (false, *k) });
    for k in order {
        let section = &sections[k];
        match (&section.like, index(section)) {
            (None, _) if has_index => return at(k, "", PhaseError::Mixed),
            (None, _) => phases.push(section.clone()),
            (Some(_), None) if has_index => phases.iter_mut().for_each(|phase| *phase = section.over(phase)),
            (Some(_), None) => phases.extend(defaults.iter().map(|phase| section.over(phase))),
            (Some(_), Some(index)) => match phases.get_mut(index - 1) {
                None => return at(k, ".index", PhaseError::NoSuchPhase { index, count }),
                Some(_) if std::mem::replace(&mut seen[index - 1], true) => {
                    return at(k, ".index", PhaseError::Twice { index });
                }
                Some(phase) => *phase = section.over(phase),
            },
        }
    }
    match phases.iter().position(|phase| phase.min_steps > phase.max_steps) {
        None => Ok(phases),
        Some(p) => {
            let (least, most) = (phases[p].min_steps, phases[p].max_steps);
            let k = sections.iter().position(|section| index(section) == Some(p + 1)).unwrap_or(0);
            at(k, "", PhaseError::Steps { index: p + 1, least, most })
        }
    }
}

/// As [`phase_sections`], ready to be gone through.
///
/// # Errors
/// Those of [`phase_sections`].
pub fn phases_from_scene(scene: &Scene, faces: usize) -> Result<Vec<Phase>, AtKey<PhaseError>> {
    Ok(phase_sections(scene, faces)?.iter().map(Phase::from_scene).collect())
}

/// The stages that work from random frames on spheres, tori of every class, disks and bunnies alike.
///
/// As in Eq. 21 bending is stiff first and nearly free at last. What differs from the paper:
///
/// - All strains cost the same at first, which makes a step of any length one solve with one factorization
///   ([`crate::frames::ConnectionLaplacian`]). Steps are in proportion to the area of the whole surface.
/// - Feedback comes in gradually, since a surface with periods collapses under full feedback while its frames are
///   still random; periods are taken out on their own from the start.
/// - ε₁ ends at 10⁻⁴. Creases are held open from where bending no longer does it (earlier they would only keep tangles
///   from resolving), and the last three stages are accelerated.
///
/// The second stage is the one that resolves rims, and gets the time it needs for that. The last ones take shorter
/// steps: under full feedback a surface comes to rest between one step of bending and one projection, so what is left
/// of the length error is in proportion to Δt.
pub fn default_phases(faces: usize) -> Vec<Phase> {
    default_sections(faces).iter().map(Phase::from_scene).collect()
}

fn default_sections(faces: usize) -> Vec<PhaseSection> {
    let shaping = PhaseSection { dt: 100.0, crease: 0.0, accelerate: false, ..PhaseSection::default() };
    let bending = PhaseSection { dt: 30.0, tolerance: 0.1, max_steps: 100, ..PhaseSection::default() };
    vec![
        PhaseSection {
            epsilon: [1.0, 1.0, 1.0, 1.0],
            dt: SMOOTHING_SHARE * faces as f64,
            feedback: 0.1,
            periods: 0.5,
            tolerance: 2.0,
            max_steps: 30,
            ..shaping.clone()
        },
        PhaseSection {
            epsilon: [1.0, 0.1, 1.0, 0.1],
            feedback: 0.5,
            periods: 0.5,
            tolerance: 1.0,
            max_steps: 20,
            untangle_steps: 350,
            ..shaping
        },
        PhaseSection { epsilon: [1.0, 1e-2, 1.0, 0.1], ..bending.clone() },
        PhaseSection { epsilon: [1.0, 1e-3, 1.0, 0.1], ..bending },
        PhaseSection::default(),
    ]
}

/// Δt of the first stage as a share of the area of the surface.
const SMOOTHING_SHARE: f64 = 1.0 / 28.0;

/// Residual of a linear solve relative to that of standing still, where frames have nearly settled. Tighter solves did
/// not save outer steps.
const SOLVER_TOLERANCE: f64 = 1e-2;
/// Mean turn per step in radians (0.1°) from which on solves on the way become looser in proportion, and how much at most.
const SETTLED_TURN: f64 = 0.1 / 180.0 * std::f64::consts::PI;
const LOOSEST: f64 = 10.0;
