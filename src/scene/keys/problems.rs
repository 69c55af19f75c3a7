//! The problems of a scene file, listed as far as anybody reads them.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;

/// A mistake before it is known in which file and line it stands.
pub(in crate::scene) struct Problem {
    pub span: Range<usize>,
    pub reason: String,
    pub remedy: String,
}

/// Problems of one kind that are listed; more are counted.
pub(in crate::scene) const LISTED: usize = 20;

/// The problems found so far. A file that is no scene at all has as many as lines.
#[derive(Default)]
pub(in crate::scene) struct Problems(RefCell<Found>);

#[derive(Default)]
struct Found {
    listed: Vec<Problem>,
    /// How many there are of each kind.
    counts: HashMap<String, usize>,
}

impl Problems {
    /// Takes up a problem; `remedy` is asked for only if it will be read.
    pub fn push(&self, span: Range<usize>, reason: String, remedy: impl FnOnce() -> String) {
        let mut found = self.0.borrow_mut();
        let count = found.counts.entry(kind(&reason)).or_default();
        *count += 1;
        if *count <= LISTED {
            found.listed.push(Problem { span, reason, remedy: remedy() });
        }
    }

    /// The problems that are listed, in the order of the file, each with how many more there are of its kind after the
    /// last one of it.
    pub fn into_listed(self) -> Vec<(Problem, usize)> {
        let Found { mut listed, mut counts } = self.0.into_inner();
        listed.sort_by_key(|problem| problem.span.start);
        let mut with_more: Vec<(Problem, usize)> = listed
            .into_iter()
            .rev()
            .map(|problem| {
                let more = counts.remove(&kind(&problem.reason)).unwrap_or(0).saturating_sub(LISTED);
                (problem, more)
            })
            .collect();
        with_more.reverse();
        with_more
    }
}

/// What a reason says without names, values and numbers.
fn kind(reason: &str) -> String {
    let mut closing = None;
    let mut text = String::with_capacity(reason.len());
    for c in reason.chars() {
        match (closing, c) {
            (Some(end), c) if c == end => closing = None,
            (Some(_), _) => {}
            (None, '`' | '"') => closing = Some(c),
            (None, '[') => closing = Some(']'),
            (None, c) if c.is_ascii_digit() || matches!(c, '.' | '-') => {}
            (None, c) => text.push(c),
        }
    }
    text
}
