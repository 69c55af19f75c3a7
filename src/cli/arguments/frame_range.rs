//! Which frames: `1-20,30-40:2`.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Frames as farms write them: single frames and spans, the latter with an optional step, separated by
/// commas. Frames are counted from 1.
///
/// ```
/// let range: immerse::cli::FrameRange = "1-3,10-20:4".parse().unwrap();
/// assert_eq!(range.frames(20).unwrap(), [1, 2, 3, 10, 14, 18]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameRange(Vec<Span>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Span {
    frames: RangeInclusive<usize>,
    step: usize,
}

/// What is wrong with a frame range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameRangeError {
    /// A part is no number.
    #[error("`{0}` is no frame or range of frames; write for example 7, 1-20 or 1-240:4, separated by commas")]
    NotARange(String),
    /// Frames are counted from 1.
    #[error("`{0}` names frame 0; frames are counted from 1")]
    Zero(String),
    /// The end comes first.
    #[error("`{0}` ends before it begins; write the smaller frame first")]
    Backward(String),
    /// The step would not advance.
    #[error("`{0}` has step 0; write 1 for every frame, 2 for every second")]
    ZeroStep(String),
    /// The film is shorter.
    #[error("frame {frame} is asked for, but the film has {frame_count}; name frames from 1 to {frame_count}")]
    Beyond {
        /// The frame.
        frame: usize,
        /// Frames of the film.
        frame_count: usize,
    },
}

impl FromStr for FrameRange {
    type Err = FrameRangeError;

    fn from_str(text: &str) -> Result<Self, FrameRangeError> {
        text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().map(FrameRange)
    }
}

impl FromStr for Span {
    type Err = FrameRangeError;

    fn from_str(text: &str) -> Result<Self, FrameRangeError> {
        let not_a_range = || FrameRangeError::NotARange(text.to_owned());
        let number = |digits: &str| number(digits).ok_or_else(not_a_range);
        let (span, step) = match text.split_once(':') {
            Some((span, step)) if span.contains('-') => (span, number(step)?),
            Some(_) => return Err(not_a_range()),
            None => (text, 1),
        };
        let (first, last) = span.split_once('-').unwrap_or((span, span));
        let (first, last) = (number(first)?, number(last)?);
        if first == 0 {
            return Err(FrameRangeError::Zero(text.to_owned()));
        }
        if last < first {
            return Err(FrameRangeError::Backward(text.to_owned()));
        }
        if step == 0 {
            return Err(FrameRangeError::ZeroStep(text.to_owned()));
        }
        Ok(Span { frames: first..=last, step })
    }
}

/// A number of digits alone: `parse` would also take a sign.
pub(super) fn number(digits: &str) -> Option<usize> {
    digits.bytes().all(|b| b.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}

impl FrameRange {
    /// The frames in order, each once.
    ///
    /// # Errors
    /// [`FrameRangeError::Beyond`] if one is not among the frames 1 to `frame_count` of the film.
    pub fn frames(&self, frame_count: usize) -> Result<Vec<usize>, FrameRangeError> {
        // Before anything is listed, since a range may name more frames than fit into memory.
        let last = |span: &Span| span.frames.end() - (span.frames.end() - span.frames.start()) % span.step;
        if let Some(frame) = self.0.iter().map(last).find(|&frame| frame > frame_count) {
            return Err(FrameRangeError::Beyond { frame, frame_count });
        }
        let mut frames: Vec<usize> = self.0.iter().flat_map(|span| span.frames.clone().step_by(span.step)).collect();
        frames.sort_unstable();
        frames.dedup();
        Ok(frames)
    }
}

impl fmt::Display for FrameRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, Span { frames, step }) in self.0.iter().enumerate() {
            if i > 0 {
                write!(f, ",")?;
            }
            write!(f, "{}", frames.start())?;
            if frames.end() > frames.start() {
                write!(f, "-{}", frames.end())?;
                if *step > 1 {
                    write!(f, ":{step}")?;
                }
            }
        }
        Ok(())
    }
}
