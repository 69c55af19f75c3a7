//! What can be wrong with keyframes, formulas and clocks.

use crate::advice::Advice;

/// Why a keyframed number, a formula or a parameter is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // the fields are what the messages say they are
pub enum TimelineError {
    #[error("there are {times} times for {values} values; {}", self.remedy())]
    Count { times: usize, values: usize },
    #[error("a keyframe is at time {time}; {}", self.remedy())]
    NotFinite { time: f64 },
    #[error("keyframes are out of order: {later} comes after {earlier}; {}", self.remedy())]
    Order { earlier: f64, later: f64 },
    #[error("one keyframe cannot repeat; {}", self.remedy())]
    NothingToRepeat,
    #[error("formula `{formula}`: {reason}; {}", self.remedy())]
    Formula { formula: String, reason: String, known: String },
    #[error("the formula has {characters} characters, {most} are the limit; {}", self.remedy())]
    TooLong { characters: usize, most: usize },
    #[error("there are more than {most} parameters; {}", self.remedy())]
    TooManyParameters { most: usize },
    #[error("`{name}` cannot name a parameter, it already means something in formulas; {}", self.remedy())]
    Name { name: String },
    #[error("a film cannot have {frames} frames; {}", self.remedy())]
    Frames { frames: usize, most: usize },
    #[error("the clock ends at {end}, not after its start at {start}; {}", self.remedy())]
    Backwards { start: f64, end: f64 },
}

impl Advice for TimelineError {
    fn remedy(&self) -> String {
        match self {
            TimelineError::Count { .. } => "give one value per time, and at least one".into(),
            TimelineError::NotFinite { .. } => "every time must be finite".into(),
            TimelineError::Order { .. } => "sort the times, each greater than the last".into(),
            TimelineError::NothingToRepeat => "give at least two times".into(),
            TimelineError::Formula { known, .. } => format!("it may use {known}"),
            TimelineError::TooLong { .. } => "name parts of it under [parameters], and use the names in it".into(),
            TimelineError::TooManyParameters { .. } => "write numbers that are used once where they are used".into(),
            TimelineError::Name { .. } => "choose another name".into(),
            TimelineError::Frames { most, .. } => format!("give 1 to {most}"),
            TimelineError::Backwards { .. } => "make the end greater than the start".into(),
        }
    }
}
