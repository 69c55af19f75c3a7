//! What keeps hinges from folding over.

use crate::tuning::BARRIER_ANGLE;
use std::f64::consts::PI;

/// The value of a function and its first two derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Jet {
    pub value: f64,
    pub first: f64,
    pub second: f64,
}

/// b(α) = −x² ln((π − |α|) / (π − α₀)) for x = |α| − α₀ > 0, else 0: twice differentiable, and infinite at 180°.
pub(super) fn barrier(angle: f64) -> Jet {
    let beyond = angle.abs() - BARRIER_ANGLE;
    if beyond <= 0.0 {
        return Jet::default();
    }
    let gap = PI - angle.abs();
    let log = libm::log(gap / (PI - BARRIER_ANGLE));
    let share = beyond / gap;
    Jet {
        value: -beyond * beyond * log,
        first: (beyond * share - 2.0 * beyond * log).copysign(angle),
        second: share * share + 4.0 * share - 2.0 * log,
    }
}
