//! The schedule of a relaxation: ε, Δt and feedback by phases (Eq. 21).

use crate::advice::Advice;
use crate::frames::{Method, StepOptions, Stiffness};
use crate::tuning::{
    LARGEST_DT_FACTOR, LEAST_DT_FACTOR, LONGEST_DT, LOOSEST_SOLVE, SETTLED_TURN, SHORTEST_DT, SMOOTHING_SHARE,
    SOLVER_TOLERANCE,
};

/// One stage of a relaxation: steps of one kind until frames stand still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Which step is taken.
    pub method: Method,
    /// The weights (length, bending, normal rotation, torsion) of Eq. 20.
    pub stiffness: Stiffness,
    /// The length of a step, or of the first one if `turn_radians` is given.
    pub dt: TimeStep,
    /// If given, Δt changes from step to step such that frames turn by this much per step on average, in radians.
    pub turn_radians: Option<f64>,
    /// How far the frame of a face of mean area moves toward that of the integrated surface after each step, 0 to 1. It
    /// is the `1 − exp(−Δt/(a A))` of Algorithm 8.
    pub feedback: f64,
    /// How far frames move toward those of edge vectors without periods after each step, 0 to 1.
    pub periods: f64,
    /// Stiffness of creases that are about to fold over; 0 lets them.
    pub crease: f64,
    /// Whether steps are combined with earlier ones once they shrink (Anderson acceleration).
    pub accelerate: bool,
    /// Mean turn per step in radians below which the phase has converged.
    pub tolerance_radians: f64,
    /// The least number of steps.
    pub min_steps: usize,
    /// The number of steps after which the phase ends without having converged.
    pub max_steps: usize,
    /// How many more steps it may take as long as there are rims.
    pub untangle_steps: usize,
    /// Residual of the linear solve of a step relative to that of standing still. On the way to a later phase it is
    /// looser as long as frames turn by much.
    pub solver_tolerance: f64,
}

/// The length of a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// In units of the mean face area.
    FaceAreas(f64),
    /// As a share of the area of the whole surface.
    ShareOfSurface(f64),
}

impl TimeStep {
    /// In units of the mean face area, on a surface of so many faces.
    pub fn in_face_areas(self, faces: usize) -> f64 {
        match self {
            TimeStep::FaceAreas(areas) => areas,
            TimeStep::ShareOfSurface(share) => share * faces as f64,
        }
    }
}

impl Default for Phase {
    /// The last one of [`Schedule::default`]: bending is nearly free and steps are short. Under full feedback a surface
    /// comes to rest between one step of bending and one projection, so that what is left of the length error is in
    /// proportion to Δt.
    fn default() -> Phase {
        Phase {
            method: Method::Implicit,
            stiffness: [1.0, 1e-4, 1.0, 0.1],
            dt: TimeStep::FaceAreas(10.0),
            turn_radians: None,
            feedback: 1.0,
            periods: 1.0,
            crease: 5.0,
            accelerate: true,
            tolerance_radians: 0.002_f64.to_radians(),
            min_steps: 3,
            max_steps: 400,
            untangle_steps: 0,
            solver_tolerance: SOLVER_TOLERANCE,
        }
    }
}

/// Why a phase cannot be run.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("`{name}` of phase {phase} is {value}; {}", self.remedy())]
pub struct PhaseError {
    /// Which phase, counted from 1; 0 if there is none.
    pub phase: usize,
    /// Which number of it.
    pub name: &'static str,
    /// What it is.
    pub value: f64,
    /// What it may be.
    pub possible: &'static str,
}

impl Advice for PhaseError {
    fn remedy(&self) -> String {
        format!("give {}", self.possible)
    }
}

/// Phases one after another, known to be in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule {
    phases: Vec<Phase>,
}

impl Schedule {
    /// With these phases.
    ///
    /// # Errors
    /// [`PhaseError`] for a number that no step could be taken with, or if there is no phase.
    pub fn new(phases: Vec<Phase>) -> Result<Schedule, PhaseError> {
        if phases.is_empty() {
            return Err(PhaseError { phase: 0, name: "count", value: 0.0, possible: "at least one phase" });
        }
        for (k, phase) in phases.iter().enumerate() {
            if let Some((name, value, possible)) = phase.fault() {
                return Err(PhaseError { phase: k + 1, name, value, possible });
            }
        }
        Ok(Schedule { phases })
    }

    /// The default last phase alone, for frames that start from positions. They are near to where they belong, and the
    /// stiffness of earlier phases would iron out what the positions say.
    pub fn of_last_phase() -> Schedule {
        Schedule { phases: vec![Phase::default()] }
    }

    /// The phases, in order; at least one.
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// With the least weight of bending ε₁ in the last phase, and in no other one less than that.
    pub fn with_bending_stiffness(mut self, stiffness: f64) -> Schedule {
        if let Some((last, earlier)) = self.phases.split_last_mut() {
            last.stiffness[1] = stiffness;
            earlier.iter_mut().for_each(|phase| phase.stiffness[1] = phase.stiffness[1].max(stiffness));
        }
        self
    }
}

impl Default for Schedule {
    /// The phases that work from random frames on spheres, tori of every class, disks and bunnies alike.
    ///
    /// As in Eq. 21 bending is stiff first and nearly free at last. What differs from the paper:
    ///
    /// - All strains cost the same at first, which makes a step of any length one solve with one factorization
    ///   ([`crate::frames::ConnectionLaplacian`]). Steps are in proportion to the area of the whole surface.
    /// - Feedback comes in gradually, since a surface with periods collapses under full feedback while its frames are
    ///   still random; periods are taken out on their own from the start.
    /// - ε₁ ends at 10⁻⁴. Creases are held open from where bending no longer does it (earlier they would only keep
    ///   tangles from resolving), and the last three phases are accelerated.
    ///
    /// The second phase is the one that resolves rims, and gets the time it needs for that.
    fn default() -> Schedule {
        let shaping =
            Phase { dt: TimeStep::FaceAreas(100.0), crease: 0.0, accelerate: false, periods: 0.5, ..Phase::default() };
        let bending = Phase {
            dt: TimeStep::FaceAreas(30.0),
            tolerance_radians: 0.1_f64.to_radians(),
            max_steps: 100,
            ..Phase::default()
        };
        let phases = vec![
            Phase {
                stiffness: [1.0; 4],
                dt: TimeStep::ShareOfSurface(SMOOTHING_SHARE),
                feedback: 0.1,
                tolerance_radians: 2.0_f64.to_radians(),
                max_steps: 30,
                ..shaping
            },
            Phase {
                stiffness: [1.0, 0.1, 1.0, 0.1],
                feedback: 0.5,
                tolerance_radians: 1.0_f64.to_radians(),
                max_steps: 20,
                untangle_steps: 350,
                ..shaping
            },
            Phase { stiffness: [1.0, 1e-2, 1.0, 0.1], ..bending },
            Phase { stiffness: [1.0, 1e-3, 1.0, 0.1], ..bending },
            Phase::default(),
        ];
        Schedule { phases }
    }
}

impl Phase {
    /// The first number that no step could be taken with: its name, its value, and what it may be.
    fn fault(&self) -> Option<(&'static str, f64, &'static str)> {
        let (positive, share) = ("a finite number above 0", "a number from 0 to 1");
        let is_positive = |value: f64| value.is_finite() && value > 0.0;
        let is_share = |value: f64| (0.0..=1.0).contains(&value);
        let dt = self.dt.in_face_areas(1);
        let weight = self.stiffness.into_iter().find(|weight| !(weight.is_finite() && *weight >= 0.0));
        let turn = self.turn_radians.unwrap_or(1.0);
        let faults = [
            ("epsilon", weight.unwrap_or(0.0), weight.is_none(), "finite weights of at least 0"),
            ("epsilon", 0.0, self.stiffness != [0.0; 4], "at least one weight above 0"),
            ("dt", dt, is_positive(dt), positive),
            ("turn", turn.to_degrees(), is_positive(turn), positive),
            ("feedback", self.feedback, is_share(self.feedback), share),
            ("periods", self.periods, is_share(self.periods), share),
            ("crease", self.crease, self.crease.is_finite() && self.crease >= 0.0, "a finite number of at least 0"),
            ("tolerance", self.tolerance_radians.to_degrees(), is_positive(self.tolerance_radians), positive),
            ("solver_tolerance", self.solver_tolerance, is_positive(self.solver_tolerance), positive),
            ("max_steps", self.max_steps as f64, self.max_steps >= self.min_steps.max(1), "at least 1 and `min_steps`"),
        ];
        faults.into_iter().find(|(_, _, is_possible, _)| !is_possible).map(|(name, value, _, what)| (name, value, what))
    }

    /// Δt of the next step in mean face areas, after one of this length that turned frames by so much.
    pub(super) fn next_dt(&self, dt: f64, turn: f64) -> f64 {
        match self.turn_radians {
            None => dt,
            Some(target) => {
                let factor = (target / turn).clamp(LEAST_DT_FACTOR, LARGEST_DT_FACTOR);
                (dt * factor).clamp(SHORTEST_DT, LONGEST_DT)
            }
        }
    }

    /// What a step of this length, in mean face areas, is taken with.
    pub(crate) fn step_options(&self, dt: f64) -> StepOptions {
        StepOptions {
            method: self.method,
            stiffness: self.stiffness,
            crease: self.crease,
            dt,
            solver_tolerance: self.solver_tolerance,
        }
    }

    /// The same on the way to a later phase, where a rough solution of the linear system leads as far as an exact one
    /// as long as frames turn by much, as they did in the last step.
    pub(super) fn rough_step_options(&self, dt: f64, turn: f64) -> StepOptions {
        let options = self.step_options(dt);
        match self.method {
            Method::Implicit => {
                let looser = (turn / SETTLED_TURN).clamp(1.0, LOOSEST_SOLVE);
                StepOptions { solver_tolerance: options.solver_tolerance * looser, ..options }
            }
            Method::Gradient | Method::Newton => options,
        }
    }

    /// Whether the phase may end after a step of this length: one whose steps get longer as long as frames turn little
    /// has to go on until they get no longer.
    pub(super) fn may_settle(&self, dt: f64) -> bool {
        self.turn_radians.is_none() || dt >= LONGEST_DT
    }
}
