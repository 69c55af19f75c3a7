//! What can be wrong with keyframes and formulas.

/// Why a keyframed number, a formula or a parameter is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum TimelineError {
    #[error("there are {times} times for {values} values; give one value per time, and at least one")]
    Count { times: usize, values: usize },
    #[error("a keyframe is at time {time}; every time must be finite")]
    NotFinite { time: f64 },
    #[error("keyframes are out of order: {later} comes after {earlier}; sort the times, each greater than the last")]
    Order { earlier: f64, later: f64 },
    #[error("one keyframe cannot repeat; give at least two times")]
    NothingToRepeat,
    #[error("formula `{formula}`: {reason}; it may use {known}")]
    Formula { formula: String, reason: String, known: String },
    #[error("`{name}` cannot name a parameter, it already means something in formulas; choose another name")]
    Name { name: String },
}
