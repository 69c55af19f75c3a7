//! From frame numbers to times.

use super::error::TimelineError;

/// When the frames of a film are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    frames: usize,
    start: f64,
    end: f64,
    looping: bool,
}

impl Clock {
    /// Frame numbers have six digits in file names.
    pub const MOST_FRAMES: usize = 999_999;

    /// So many frames, evenly from the time of the first one to that of the last one or, in a film that loops, to that of
    /// the first one when it comes again.
    ///
    /// # Errors
    /// [`TimelineError::Frames`] unless there are 1 to [`Clock::MOST_FRAMES`], [`TimelineError::Backwards`] if the times
    /// are not finite or the end is not after the start.
    pub fn new(frames: usize, [start, end]: [f64; 2], looping: bool) -> Result<Clock, TimelineError> {
        if !(1..=Clock::MOST_FRAMES).contains(&frames) {
            return Err(TimelineError::Frames { frames, most: Clock::MOST_FRAMES });
        }
        if !(start.is_finite() && end.is_finite() && start < end) {
            return Err(TimelineError::Backwards { start, end });
        }
        Ok(Clock { frames, start, end, looping })
    }

    /// One frame, at time 0.
    pub const STILL: Clock = Clock { frames: 1, start: 0.0, end: 1.0, looping: false };

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// The time of a frame, counted from 1. The last one is at the end, but for a film that loops: there the first one
    /// comes next, and is at the end.
    pub fn time(&self, frame: usize) -> f64 {
        let intervals = if self.looping { self.frames } else { self.frames - 1 };
        if intervals == 0 || frame <= 1 {
            return self.start;
        }
        let passed = frame - 1;
        // Multiplied first, so that a film which goes on longer at the same pace has the same times as before.
        if passed == intervals {
            self.end
        } else {
            self.start + (self.end - self.start) * passed as f64 / intervals as f64
        }
    }

    /// The time of the first frame.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// The time of the last frame or, in a film that loops, of the first one when it comes again.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Whether the first frame comes after the last one again.
    pub fn is_looping(&self) -> bool {
        self.looping
    }

    /// All times, in order.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        (1..=self.frames).map(|frame| self.time(frame))
    }
}
