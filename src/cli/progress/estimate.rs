//! How long something will still take.

use std::time::{Duration, Instant};

/// Parts that are made one after the other, and how long they took.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// When the last one was done, or they began.
    since: Option<Instant>,
    spent: Duration,
    counted: u32,
}

impl Pace {
    /// The first part begins now.
    pub fn begin(&mut self) {
        *self = Pace { since: Some(Instant::now()), ..Pace::default() };
    }

    /// A part is done; one that is like no other says nothing of how long those will take.
    pub fn done(&mut self, is_like_others: bool) {
        let now = Instant::now();
        if let Some(since) = self.since.replace(now).filter(|_| is_like_others) {
            self.spent += now - since;
            self.counted += 1;
        }
    }

    /// How long so many parts will take from now on, once one is known.
    pub fn left(&self, parts: usize) -> Option<Duration> {
        let each = self.spent.checked_div(self.counted)?;
        let all = each.saturating_mul(u32::try_from(parts).ok()?);
        Some(all.saturating_sub(self.since?.elapsed()))
    }
}

/// In words, as `about 2 min left`.
pub(super) fn in_words(left: Duration) -> String {
    let seconds = left.as_secs();
    match seconds {
        0..10 => "a few seconds left".to_owned(),
        10..90 => format!("about {} s left", (seconds + 5) / 10 * 10),
        90..5400 => format!("about {} min left", (seconds + 30) / 60),
        _ => format!("about {} h {:02} min left", seconds / 3600, seconds % 3600 / 60),
    }
}
