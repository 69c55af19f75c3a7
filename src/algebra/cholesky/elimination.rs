//! In which order supernodes are eliminated: what each takes from which finished ones, and what can be done side by side.
//!
//! The elimination tree leads from each supernode to the one of the first row below it. Small subtrees, the *branches*, have nothing to
//! do with one another. What they grow from, the *trunk*, is eliminated one by one, each in strips of columns. Every number takes
//! from the same numbers in the same order, however many threads there are.

use super::supernodes::Supernodes;
use std::ops::Range;

/// What a supernode takes from a finished one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Update {
    /// The finished one.
    pub from: u32,
    /// Which of the rows below that one are columns of this one.
    pub rows: [u32; 2],
}

/// The order of elimination of supernodes.
#[derive(Debug)]
pub(super) struct Elimination {
    updates: Vec<Update>,
    /// Per supernode, and once more for the end: where its updates begin.
    begins: Vec<usize>,
    /// Supernodes of each branch.
    pub branches: Vec<Range<usize>>,
    /// The other ones.
    pub trunk: Vec<usize>,
}

/// A branch is at most such a part of all the work.
const BRANCHES: f64 = 24.0;
/// Products and sums of numbers below which nothing is done side by side.
const LITTLE_WORK: f64 = 2e6;
/// No further supernode in a list.
const NONE: u32 = u32::MAX;

impl Elimination {
    pub fn of(supernodes: &Supernodes) -> Elimination {
        let count = supernodes.count();
        let (mut updates, mut begins) = (Vec::new(), vec![0]);
        // The finished supernodes that have rows in an unfinished one: the first per unfinished one, then one after the other; and the
        // first of those rows.
        let (mut first_with_rows_in, mut next, mut pending) = (vec![NONE; count], vec![NONE; count], vec![0; count]);
        let mut work = vec![0.0; count];
        for s in 0..count {
            let columns = supernodes.columns(s);
            let mut d = std::mem::replace(&mut first_with_rows_in[s], NONE);
            while d != NONE {
                let finished = d as usize;
                let below = supernodes.below(finished);
                let from = pending[finished];
                let until = from + below[from..].partition_point(|&row| (row as usize) < columns.end);
                updates.push(Update { from: d, rows: [from as u32, until as u32] });
                work[s] += (supernodes.columns(finished).len() * (until - from) * (below.len() - from)) as f64;
                pending[finished] = until;
                let after = next[finished];
                if let Some(&row) = below.get(until) {
                    let later = supernodes.of_row[row as usize] as usize;
                    next[finished] = std::mem::replace(&mut first_with_rows_in[later], d);
                }
                d = after;
            }
            begins.push(updates.len());
            work[s] += 0.5 * (columns.len() * columns.len() * supernodes.height(s)) as f64;
            if let Some(&row) = supernodes.below(s).first() {
                let later = supernodes.of_row[row as usize] as usize;
                next[s] = std::mem::replace(&mut first_with_rows_in[later], s as u32);
            }
        }
        let (branches, trunk) = divided(supernodes, work);
        Elimination { updates, begins, branches, trunk }
    }

    /// What a supernode takes, one after the other.
    pub fn updates(&self, s: usize) -> &[Update] {
        &self.updates[self.begins[s]..self.begins[s + 1]]
    }
}

/// Branches and trunk, if each supernode is so much work.
fn divided(supernodes: &Supernodes, mut work: Vec<f64>) -> (Vec<Range<usize>>, Vec<usize>) {
    let count = supernodes.count();
    let all: f64 = work.iter().sum();
    let parents: Vec<Option<usize>> =
        (0..count).map(|s| supernodes.below(s).first().map(|row| supernodes.of_row[*row as usize] as usize)).collect();
    // Of the subtree of each: its work, its first supernode and how many it has.
    let (mut first, mut size) = ((0..count).collect::<Vec<_>>(), vec![1; count]);
    for s in 0..count {
        if let Some(parent) = parents[s] {
            work[parent] += work[s];
            first[parent] = first[parent].min(first[s]);
            size[parent] += size[s];
        }
    }
    let is_in_one_piece = (0..count).all(|s| s + 1 - first[s] == size[s]);
    if all < LITTLE_WORK || !is_in_one_piece {
        return (Vec::new(), (0..count).collect());
    }
    let is_small = |s: usize| work[s] * BRANCHES <= all;
    let (mut branches, mut trunk) = (Vec::new(), Vec::new());
    for s in 0..count {
        if !is_small(s) {
            trunk.push(s);
        } else if parents[s].is_none_or(|parent| !is_small(parent)) {
            branches.push(first[s]..s + 1);
        }
    }
    (branches, trunk)
}
