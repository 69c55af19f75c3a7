//! The schedule of a relaxation: ε, Δt and feedback by stages (Eq. 21).

use crate::frames::{Method, StepOptions};
use crate::scene::{MethodName, PhaseSection, StartFrom};

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

/// The stages of a scene, or the default ones of a surface with so many faces. Frames that start from positions are near
/// to where they belong; they need only the last stage, and the stiffness of the earlier ones would iron out what the
/// positions say.
pub fn phases_from_scene(sections: &[PhaseSection], start: &StartFrom, faces: usize) -> Vec<Phase> {
    match start {
        _ if !sections.is_empty() => sections.iter().map(Phase::from_scene).collect(),
        StartFrom::Random(_) | StartFrom::Spectral => default_phases(faces),
        StartFrom::Mesh | StartFrom::Mirror | StartFrom::File(_) => vec![Phase::from_scene(&PhaseSection::default())],
    }
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
    let shaping = PhaseSection { dt: 100.0, crease: 0.0, accelerate: false, ..PhaseSection::default() };
    let bending = PhaseSection { dt: 30.0, tolerance: 0.1, max_steps: 100, ..PhaseSection::default() };
    [
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
    .iter()
    .map(Phase::from_scene)
    .collect()
}

/// Δt of the first stage as a share of the area of the surface.
const SMOOTHING_SHARE: f64 = 1.0 / 28.0;

/// Residual of a linear solve relative to that of standing still, where frames have nearly settled. Tighter solves did
/// not save outer steps.
const SOLVER_TOLERANCE: f64 = 1e-2;
/// Mean turn per step in radians (0.1°) from which on solves on the way become looser in proportion, and how much at most.
const SETTLED_TURN: f64 = 0.1 / 180.0 * std::f64::consts::PI;
const LOOSEST: f64 = 10.0;
