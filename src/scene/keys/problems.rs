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
pub(in crate::scene) struct Problems {
    found: RefCell<Found>,
    /// Where each text begins, and its rank; in order.
    ranks: Vec<(usize, usize)>,
    /// Values that have to go, because a text of higher rank says something else.
    replaced: RefCell<Vec<Range<usize>>>,
}

#[derive(Default)]
struct Found {
    listed: Vec<Problem>,
    /// How many there are of each kind.
    counts: HashMap<String, usize>,
}

impl Problems {
    /// Of texts that begin at these places and have these ranks.
    pub fn of(ranks: Vec<(usize, usize)>) -> Problems {
        Problems { ranks, ..Problems::default() }
    }

    /// The rank of the text in which a place is.
    pub fn rank(&self, place: usize) -> usize {
        self.ranks.iter().rev().find(|(start, _)| *start <= place).map_or(0, |(_, rank)| *rank)
    }

    /// Has a value go that a text of higher rank excludes.
    pub fn replace(&self, value: Range<usize>) {
        self.replaced.borrow_mut().push(value);
    }

    /// The places of the values that have to go before the texts can be read as one.
    pub fn replaced(&self) -> Vec<Range<usize>> {
        self.replaced.borrow().clone()
    }

    /// Takes up a problem; `remedy` is asked for only if it will be read.
    pub fn push(&self, span: Range<usize>, reason: String, remedy: impl FnOnce() -> String) {
        let mut found = self.found.borrow_mut();
        let count = found.counts.entry(kind(&reason)).or_default();
        *count += 1;
        if *count <= LISTED {
            found.listed.push(Problem { span, reason, remedy: remedy() });
        }
    }

    /// The problems that are listed, in the order of the file, each with how many more there are of its kind after the
    /// last one of it.
    pub fn into_listed(self) -> Vec<(Problem, usize)> {
        let Found { mut listed, mut counts } = self.found.into_inner();
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
