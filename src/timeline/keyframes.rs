//! Values at given times, and between them.

use super::error::TimelineError;
use std::ops::{Add, Mul, Sub};

/// How a keyframed value passes from one keyframe to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// At constant speed.
    #[default]
    Linear,
    /// Slowly at both ends.
    Smooth,
    /// Slowly at first.
    In,
    /// Slowly at last.
    Out,
}

/// What a keyframed value does before the first and after the last keyframe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Extrapolation {
    /// It stands still.
    #[default]
    Hold,
    /// It goes on at the speed it would have between the two nearest keyframes without easing.
    Linear,
    /// It starts over.
    Repeat,
}

/// Values at increasing times.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframes<T> {
    times: Vec<f64>,
    values: Vec<T>,
    ease: Ease,
    extrapolation: Extrapolation,
}

impl<T> Keyframes<T> {
    /// The same value at all times.
    pub fn constant(value: T) -> Keyframes<T> {
        let (ease, extrapolation) = (Ease::default(), Extrapolation::default());
        Keyframes { times: vec![0.0], values: vec![value], ease, extrapolation }
    }

    /// One value per time.
    ///
    /// # Errors
    /// [`TimelineError::Count`], [`TimelineError::NotFinite`], [`TimelineError::Order`],
    /// [`TimelineError::NothingToRepeat`].
    pub fn new(
        times: Vec<f64>,
        values: Vec<T>,
        ease: Ease,
        extrapolation: Extrapolation,
    ) -> Result<Keyframes<T>, TimelineError> {
        if times.is_empty() || times.len() != values.len() {
            return Err(TimelineError::Count { times: times.len(), values: values.len() });
        }
        if let Some(&time) = times.iter().find(|time| !time.is_finite()) {
            return Err(TimelineError::NotFinite { time });
        }
        if let Some([earlier, later]) = times.array_windows().find(|[earlier, later]| later <= earlier) {
            return Err(TimelineError::Order { earlier: *earlier, later: *later });
        }
        if extrapolation == Extrapolation::Repeat && times.len() < 2 {
            return Err(TimelineError::NothingToRepeat);
        }
        Ok(Keyframes { times, values, ease, extrapolation })
    }

    /// The two values around a time, and how far it is from the first to the second: 0 to 1, or beyond where the
    /// keyframes are extrapolated.
    pub fn around(&self, time: f64) -> (&T, &T, f64) {
        let (first, last) = (self.times[0], self.times[self.times.len() - 1]);
        let time = match self.extrapolation {
            Extrapolation::Hold => time.clamp(first, last),
            Extrapolation::Linear => time,
            // Exact where there is nothing to repeat.
            Extrapolation::Repeat if (first..last).contains(&time) => time,
            Extrapolation::Repeat => first + (time - first).rem_euclid(last - first),
        };
        if self.times.len() == 1 {
            return (&self.values[0], &self.values[0], 0.0);
        }
        let after = self.times.partition_point(|t| *t <= time).clamp(1, self.times.len() - 1);
        let part = (time - self.times[after - 1]) / (self.times[after] - self.times[after - 1]);
        let part = if (0.0..=1.0).contains(&part) { eased(self.ease, part) } else { part };
        (&self.values[after - 1], &self.values[after], part)
    }

    /// The same times with other values.
    pub fn map<U>(self, value: impl FnMut(T) -> U) -> Keyframes<U> {
        let Keyframes { times, values, ease, extrapolation } = self;
        Keyframes { times, values: values.into_iter().map(value).collect(), ease, extrapolation }
    }

    /// The values, in order of time.
    pub fn values(&self) -> &[T] {
        &self.values
    }
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>> Keyframes<T> {
    /// The value at a time; exact at the keyframes.
    pub fn at(&self, time: f64) -> T {
        let (&before, &after, part) = self.around(time);
        if part == 1.0 { after } else { before + (after - before) * part }
    }
}

/// How far a value is on its way, 0 to 1, when this part of the time has passed.
pub fn eased(ease: Ease, part: f64) -> f64 {
    match ease {
        Ease::Linear => part,
        Ease::Smooth => part * part * (3.0 - 2.0 * part),
        Ease::In => part * part,
        Ease::Out => part * (2.0 - part),
    }
}
