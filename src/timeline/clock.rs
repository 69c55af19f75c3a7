//! From frame numbers to times.

use crate::scene::ClockSection;

/// When the frames of a film are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    frames: usize,
    start: f64,
    end: f64,
    looping: bool,
}

impl Clock {
    /// From the `[clock]` of a scene.
    pub fn from_scene(section: &ClockSection) -> Clock {
        let ClockSection { frames, start, end, looping, .. } = *section;
        Clock { frames, start, end, looping }
    }

    /// The time of a frame, counted from 1. The last one is at the end, but for a film that loops: there the first one
    /// comes next, and is at the end.
    pub fn time(&self, frame: usize) -> f64 {
        let intervals = if self.looping { self.frames } else { self.frames - 1 };
        if intervals == 0 || frame == 1 {
            return self.start;
        }
        let part = (frame - 1) as f64 / intervals as f64;
        if part == 1.0 { self.end } else { self.start + (self.end - self.start) * part }
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
