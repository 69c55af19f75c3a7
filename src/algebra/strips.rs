//! An order of the rows of a sparse matrix that two or more threads can eliminate side by side.

use std::ops::{Range, RangeInclusive};

/// Which rows are coupled, cut into strips of which each touches only the one before and the one after it.
///
/// Rows are taken by their distance in the graph from one far end (reverse Cuthill–McKee), and strips are runs of
/// whole distances. All even strips come before all odd ones in the order of elimination; strips of one kind do not
/// touch each other, so each is eliminated on its own. The order depends on the graph alone, not on the number of threads.
#[derive(Clone, Debug)]
pub struct BlockPattern {
    /// Even strips, then odd strips.
    pub(super) strips: Vec<Strip>,
    /// How many strips are even.
    pub(super) even: usize,
    /// Per row: strip, and place in the strip.
    pub(super) places: Vec<(u32, u32)>,
}

/// Rows that are eliminated one after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Strip {
    /// The rows, in order.
    pub rows: Vec<u32>,
    /// Where the couplings of a row with earlier rows of the strip start; one more than rows.
    pub starts: Vec<u32>,
    /// Per coupling: the place of the earlier row, and its pair.
    pub columns: Vec<u32>,
    pub pairs: Vec<Pair>,
    /// Of an odd strip: its couplings with even ones, in order of its rows.
    pub seams: Vec<Seam>,
    /// Of an even strip: the same couplings seen from there, as (place here, odd strip, place there, number there).
    pub mirrored: Vec<(u32, u32, u32, u32)>,
}

/// A coupled pair, and whether its first row is the later one of the two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub index: u32,
    pub first_is_later: bool,
}

/// A coupling of a row of an odd strip with one of an even strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seam {
    pub row: u32,
    pub strip: u32,
    pub column: u32,
    pub pair: Pair,
}

impl Strip {
    pub fn couplings(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
}

impl BlockPattern {
    /// From the coupled pairs of rows.
    pub fn new(rows: usize, pairs: impl Iterator<Item = (usize, usize)>) -> BlockPattern {
        let pairs: Vec<(usize, usize)> = pairs.collect();
        let neighbours = Neighbours::new(rows, &pairs);
        let runs = strips_of_levels(&levels(&neighbours), strip_count(rows));
        let even = runs.len().div_ceil(2);
        let mut strips = vec![Strip::default(); runs.len()];
        let mut places = vec![(0, 0); rows];
        for (k, run) in runs.into_iter().enumerate() {
            let index = if k % 2 == 0 { k / 2 } else { even + k / 2 };
            for (place, row) in run.iter().enumerate() {
                places[*row as usize] = (index as u32, place as u32);
            }
            strips[index].rows = run;
        }
        for index in 0..strips.len() {
            let (mut starts, mut columns, mut inner, mut seams) = (vec![0], Vec::new(), Vec::new(), Vec::new());
            for (row, here) in strips[index].rows.iter().enumerate() {
                for &(there, pair) in neighbours.of(*here as usize) {
                    let (strip, column) = places[there as usize];
                    let pair = Pair { index: pair, first_is_later: pairs[pair as usize].0 == *here as usize };
                    if strip as usize == index && column < row as u32 {
                        columns.push(column);
                        inner.push(pair);
                    } else if strip as usize != index && index >= even {
                        seams.push(Seam { row: row as u32, strip, column, pair });
                    }
                }
                starts.push(columns.len() as u32);
            }
            for (number, seam) in seams.iter().enumerate() {
                strips[seam.strip as usize].mirrored.push((seam.column, index as u32, seam.row, number as u32));
            }
            let rows = std::mem::take(&mut strips[index].rows);
            let mirrored = std::mem::take(&mut strips[index].mirrored);
            strips[index] = Strip { rows, starts, columns, pairs: inner, seams, mirrored };
        }
        BlockPattern { strips, even, places }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.places.len()
    }
}

/// Fewer rows than this are not worth a second task.
const MIN_ROWS: usize = 4096;
/// Rows of a strip in graphs of moderate size.
const ROWS_PER_STRIP: usize = 2048;
/// As many tasks go side by side as there are strips of one kind. Each boundary between strips costs a little accuracy
/// of an incomplete factorization.
const STRIPS: RangeInclusive<usize> = 4..=16;

fn strip_count(rows: usize) -> usize {
    if rows < MIN_ROWS { 1 } else { (rows / ROWS_PER_STRIP / 4 * 4).clamp(*STRIPS.start(), *STRIPS.end()) }
}

/// The coupled rows of each row, with the pair that couples them.
struct Neighbours {
    starts: Vec<u32>,
    entries: Vec<(u32, u32)>,
}

impl Neighbours {
    fn new(rows: usize, pairs: &[(usize, usize)]) -> Neighbours {
        let mut starts = vec![0; rows + 1];
        for &(a, b) in pairs {
            starts[a + 1] += 1;
            starts[b + 1] += 1;
        }
        for k in 0..rows {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut entries = vec![(0, 0); 2 * pairs.len()];
        for (index, &(a, b)) in pairs.iter().enumerate() {
            for (here, there) in [(a, b), (b, a)] {
                entries[next[here] as usize] = (there as u32, index as u32);
                next[here] += 1;
            }
        }
        Neighbours { starts, entries }
    }

    fn of(&self, row: usize) -> &[(u32, u32)] {
        &self.entries[self.starts[row] as usize..self.starts[row + 1] as usize]
    }

    /// Appends all rows that can be reached from a row, level by level.
    fn spread(&self, from: u32, seen: &mut [bool], levels: &mut Vec<Vec<u32>>) {
        let mut level = vec![from];
        seen[from as usize] = true;
        while !level.is_empty() {
            let mut next = Vec::new();
            for row in &level {
                for &(there, _) in self.of(*row as usize) {
                    if !std::mem::replace(&mut seen[there as usize], true) {
                        next.push(there);
                    }
                }
            }
            levels.push(std::mem::replace(&mut level, next));
        }
    }
}

/// All rows by their distance from one of a component's far ends, the farthest first, component by component.
fn levels(neighbours: &Neighbours) -> Vec<Vec<u32>> {
    let rows = neighbours.starts.len() - 1;
    let (mut seen, mut there) = (vec![false; rows], vec![false; rows]);
    let mut all = Vec::new();
    for row in 0..rows as u32 {
        if !there[row as usize] {
            let mut first = Vec::new();
            neighbours.spread(row, &mut there, &mut first);
            let end = first.last().and_then(|level| level.first()).copied().unwrap_or(row);
            neighbours.spread(end, &mut seen, &mut all);
        }
    }
    all.reverse();
    all.iter_mut().for_each(|level| level.reverse());
    all
}

/// Runs of whole levels with about the same number of rows.
fn strips_of_levels(levels: &[Vec<u32>], count: usize) -> Vec<Vec<u32>> {
    let rows: usize = levels.iter().map(Vec::len).sum();
    let (mut strips, mut current, mut taken) = (Vec::new(), None, 0);
    for level in levels {
        // A level belongs to the strip in which its middle is.
        let strip = ((taken + level.len() / 2) * count / rows).min(count - 1);
        taken += level.len();
        if current != Some(strip) {
            strips.push(Vec::new());
            current = Some(strip);
        }
        if let Some(last) = strips.last_mut() {
            last.extend(level);
        }
    }
    strips
}
