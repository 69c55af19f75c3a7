//! `[[phase]]`: how the surface is relaxed.

/// `[[phase]]`: one stage of the relaxation. What is left out is as in the default value.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseSection {
    /// Which step is taken.
    pub method: MethodName,
    /// (length, bending, normal rotation, torsion) weights (Eq. 20).
    pub epsilon: [f64; 4],
    /// Time step in units of the mean face area.
    pub dt: f64,
    /// Left out, all steps have that length. Otherwise it is the first one's, and the others are chosen such that the
    /// mean turn of a frame per step stays this many degrees.
    pub turn: Option<f64>,
    /// How far the frame of a face of mean area is moved toward that of the integrated surface after each step,
    /// 0 to 1: `1 − exp(−Δt/(a A))` of Alg. 8.
    pub feedback: f64,
    /// How far frames are moved toward those of edge vectors without periods, 0 to 1.
    pub periods: f64,
    /// Stiffness of creases that are about to fold over; 0 lets them.
    pub crease: f64,
    /// Whether steps are combined with earlier ones once they shrink (Anderson acceleration).
    pub accelerate: bool,
    /// The stage ends when the mean turn of a frame per step is below this (degrees),
    pub tolerance: f64,
    /// and not before this many steps;
    pub min_steps: usize,
    /// it is said not to have converged after this many,
    pub max_steps: usize,
    /// or, as long as there are rims, this many more.
    pub untangle_steps: usize,
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
    pub fn over(&self, phase: &PhaseSection) -> PhaseSection {
        let Some(LikeDefault { given, .. }) = &self.like else { return self.clone() };
        let from = |key: &str| if given.contains(&key) { self } else { phase };
        PhaseSection {
            method: from("method").method,
            epsilon: from("epsilon").epsilon,
            dt: from("dt").dt,
            turn: from("turn").turn,
            feedback: from("feedback").feedback,
            periods: from("periods").periods,
            crease: from("crease").crease,
            accelerate: from("accelerate").accelerate,
            tolerance: from("tolerance").tolerance,
            min_steps: from("min_steps").min_steps,
            max_steps: from("max_steps").max_steps,
            untangle_steps: from("untangle_steps").untangle_steps,
            like: None,
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

impl std::fmt::Display for PhaseSection {
    /// As it is written in a scene.
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let method = match self.method {
            MethodName::Implicit => "implicit",
            MethodName::Gradient => "gradient",
            MethodName::Newton => "newton",
        };
        writeln!(f, "[[phase]]")?;
        writeln!(f, "method = {method:?}")?;
        writeln!(f, "epsilon = {:?}", self.epsilon)?;
        writeln!(f, "dt = {:?}", self.dt)?;
        if let Some(turn) = self.turn {
            writeln!(f, "turn = {turn:?}")?;
        }
        writeln!(f, "feedback = {:?}", self.feedback)?;
        writeln!(f, "periods = {:?}", self.periods)?;
        writeln!(f, "crease = {:?}", self.crease)?;
        writeln!(f, "accelerate = {}", self.accelerate)?;
        writeln!(f, "tolerance = {:?}", self.tolerance)?;
        writeln!(f, "min_steps = {}", self.min_steps)?;
        writeln!(f, "max_steps = {}", self.max_steps)?;
        writeln!(f, "untangle_steps = {}", self.untangle_steps)
    }
}

/// What `[bending]` says of the phases.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct RelaxationSection {
    /// The weight ε₁ of bending in the last phase and in every frame of a film that follows; in no phase is it less.
    /// Left out, it is what phases say.
    pub bending_stiffness: Option<f64>,
}

impl Default for PhaseSection {
    fn default() -> Self {
        Self {
            method: MethodName::Implicit,
            epsilon: [1.0, 1e-4, 1.0, 0.1],
            dt: 10.0,
            turn: None,
            feedback: 1.0,
            periods: 1.0,
            crease: 5.0,
            accelerate: true,
            tolerance: 0.002,
            min_steps: 3,
            max_steps: 400,
            untangle_steps: 0,
            like: None,
        }
    }
}

/// Steps by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MethodName {
    /// Alg. 5/8 with the basis of the norm frozen during a step.
    Implicit,
    /// Alg. 5/8 as printed.
    Gradient,
    /// Alg. 6.
    Newton,
}
