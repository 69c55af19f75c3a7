//! `[clock]`, and numbers that change with time.

use crate::evolve::{Fold, Polishing};
use crate::timeline::{Ease, Extrapolation};
use crate::tuning::MAX_BENDING_GROWTH;

/// A number that may change with time.
#[derive(Clone, Debug, PartialEq)]
pub enum NumberSection {
    /// `amount = 0.5`
    Constant(f64),
    /// `amount = "0.5 * t"`: a formula in `t` and the `[parameters]`.
    Formula(String),
    /// `amount = { times = [0, 1], values = [0, 0.5], ease = "smooth" }`
    Keyframes {
        /// Increasing.
        times: Vec<f64>,
        /// One per time.
        values: Vec<f64>,
        /// Between the keyframes.
        ease: Ease,
        /// Outside of them.
        extrapolation: Extrapolation,
    },
}

/// `[polish]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolishSection {
    /// Which frames are polished; left out, that of a static scene, and all where each class has one.
    pub enabled: Option<Polishing>,
    /// By which share the mean bending angle may grow.
    pub max_bending_growth: f64,
}

impl Default for PolishSection {
    fn default() -> Self {
        Self { enabled: None, max_bending_growth: MAX_BENDING_GROWTH }
    }
}

/// `[clock]`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockSection {
    /// Number of frames; 1 is a static scene.
    pub frames: usize,
    /// Whether it was left out of a scene of all classes: there is a frame for each, and the mesh says how many.
    pub a_frame_for_each_class: bool,
    /// Time of the first frame.
    pub start: f64,
    /// Time of the last frame or, in a film that loops, of the one after it.
    pub end: f64,
    /// Whether the first frame comes after the last one again.
    pub looping: bool,
    /// Whether the film begins in its middle, on a halfway model, and shows both ways down.
    pub both_ways: bool,
    /// Whether something may fold on the way from one frame to the next.
    pub fold: Fold,
    /// A film of the relaxation itself: so many steps from frame to frame. Left out, every frame of a film whose
    /// scene changes with time is relaxed until it has settled, and in any other film it is 2.
    pub steps_per_frame: Option<usize>,
    /// A frame has settled when the mean turn of its face frames per step is below this many degrees, or after `max_steps`.
    pub tolerance: f64,
    /// The number of steps after which a frame counts as settled, whether frames stand still or not.
    pub max_steps: usize,
    /// A frame is done as soon as its L2 length error is at most this and it has no rims. Left out, it is relaxed until
    /// it has settled.
    pub accuracy: Option<f64>,
    /// No edge changes its length by more than this share at once; where a frame brings more, it is reached in
    /// several parts.
    pub max_strain: f64,
}

impl Default for ClockSection {
    fn default() -> Self {
        Self {
            frames: 1,
            a_frame_for_each_class: false,
            start: 0.0,
            end: 1.0,
            looping: false,
            both_ways: false,
            fold: Fold::Allow,
            steps_per_frame: None,
            tolerance: 0.005,
            max_steps: 100,
            accuracy: None,
            max_strain: 0.05,
        }
    }
}
