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
