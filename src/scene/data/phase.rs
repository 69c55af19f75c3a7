//! `[[phase]]`: how the surface is relaxed.

use crate::evolve::Phase;

/// `[[phase]]`: one stage of the relaxation.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseSection {
    /// What it says; what is left out is as in the default value.
    pub phase: Phase,
    /// Whether it changes default phases; left out, it is a phase of its own.
    pub like: Option<LikeDefault>,
}

/// `like = "default"` or `index = 2` in a `[[phase]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LikeDefault {
    /// The default phase that is changed, counted from 1; left out, all of them.
    pub index: Option<usize>,
    /// The keys that say how. All others of the section mean nothing.
    pub given: Vec<&'static str>,
}

impl PhaseSection {
    /// A phase with the keys that this section gives.
    pub fn over(&self, phase: &Phase) -> Phase {
        let Some(LikeDefault { given, .. }) = &self.like else { return self.phase };
        let from = |key: &str| if given.contains(&key) { &self.phase } else { phase };
        Phase {
            method: from("method").method,
            stiffness: from("epsilon").stiffness,
            dt: from("dt").dt,
            turn_radians: from("turn").turn_radians,
            feedback: from("feedback").feedback,
            periods: from("periods").periods,
            crease: from("crease").crease,
            accelerate: from("accelerate").accelerate,
            tolerance_radians: from("tolerance").tolerance_radians,
            min_steps: from("min_steps").min_steps,
            max_steps: from("max_steps").max_steps,
            untangle_steps: from("untangle_steps").untangle_steps,
            solver_tolerance: phase.solver_tolerance,
        }
    }

    /// The keys that are passed on by [`PhaseSection::over`].
    pub const KEYS: [&str; 12] = [
        "method",
        "epsilon",
        "dt",
        "turn",
        "feedback",
        "periods",
        "crease",
        "accelerate",
        "tolerance",
        "min_steps",
        "max_steps",
        "untangle_steps",
    ];
}

/// What `[bending]` says of the phases.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct RelaxationSection {
    /// The weight ε₁ of bending in the last phase and in every frame of a film that follows; in no phase is it less.
    /// Left out, it is what phases say.
    pub bending_stiffness: Option<f64>,
}
