//! The numbers of a sparse Cholesky factor, a dense panel per supernode, and what is done with them.

use super::products::{Scratch, Source, Target, subtract_product};
use super::supernodes::Supernodes;
use pulp::{Arch, Simd, WithSimd};

/// Per row four real numbers, or two complex ones: real and imaginary part of the first, then of the second.
pub(super) type Vectors = Vec<[f64; 4]>;

/// Columns of a panel that are finished one by one, before later ones take from them together.
const FEW: usize = 8;

/// No further supernode in a list.
const NONE: u32 = u32::MAX;

/// The panels of all supernodes, column by column: their real parts, and the imaginary ones if there are any.
#[derive(Debug)]
pub(super) struct Panels {
    planes: Vec<Vec<f64>>,
}

impl Panels {
    pub fn zeros(supernodes: &Supernodes, planes: usize) -> Panels {
        Panels { planes: (0..planes).map(|_| vec![0.0; supernodes.len()]).collect() }
    }

    /// All numbers 0 again.
    pub fn clear(&mut self) {
        self.planes.iter_mut().for_each(|plane| plane.fill(0.0));
    }

    /// The real parts.
    pub fn real(&mut self) -> &mut [f64] {
        &mut self.planes[0]
    }

    pub fn add(&mut self, place: usize, parts: [f64; 2]) {
        self.planes.iter_mut().zip(parts).for_each(|(plane, part)| plane[place] += part);
    }

    /// From the lower triangle of a matrix to its factor; else the row whose pivot is not positive.
    pub fn factorize(&mut self, supernodes: &Supernodes) -> Result<(), usize> {
        Arch::new().dispatch(Factorize { panels: self, supernodes })
    }

    /// x ↦ (L L*)⁻¹ x.
    pub fn solve(&self, supernodes: &Supernodes, x: &mut Vectors) {
        Arch::new().dispatch(Solve { panels: self, supernodes, x });
    }
}

struct Factorize<'a> {
    panels: &'a mut Panels,
    supernodes: &'a Supernodes,
}

impl WithSimd for Factorize<'_> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), usize> {
        let Factorize { panels, supernodes } = self;
        let count = supernodes.count();
        // The finished supernodes that have rows in an unfinished one: the first per unfinished one, then one after
        // the other; and the first of those rows.
        let mut first_with_rows_in = vec![NONE; count];
        let mut next = vec![NONE; count];
        let mut pending = vec![0_usize; count];
        let mut local = vec![0_u32; supernodes.of_row.len()];
        let tallest = (0..count).map(|s| supernodes.height(s)).max().unwrap_or(0);
        let numbers: Vec<u32> = (0..tallest as u32).collect();
        let (mut rows, mut scratch) = (Vec::new(), Scratch::default());
        for s in 0..count {
            let (columns, height, panel) = (supernodes.columns(s), supernodes.height(s), supernodes.panel(s));
            for (number, &row) in supernodes.below(s).iter().enumerate() {
                local[row as usize] = (columns.len() + number) as u32;
            }
            for (number, row) in columns.clone().enumerate() {
                local[row] = number as u32;
            }
            let mut planes = panels.planes.iter_mut().map(|plane| plane.split_at_mut(panel.start));
            let (real, imaginary) = (planes.next(), planes.next());
            let (real_before, real) = real.unwrap_or_default();
            let (imaginary_before, imaginary) = imaginary.unwrap_or_default();
            let is_complex = !imaginary.is_empty();
            let real = &mut real[..panel.len()];
            let imaginary = if is_complex { &mut imaginary[..panel.len()] } else { imaginary };

            let mut d = std::mem::replace(&mut first_with_rows_in[s], NONE);
            while d != NONE {
                let finished = d as usize;
                d = next[finished];
                let below = supernodes.below(finished);
                let from = pending[finished];
                let until = from + below[from..].partition_point(|&row| (row as usize) < columns.end);
                rows.clear();
                rows.extend(below[from..].iter().map(|&row| local[row as usize]));
                let width = supernodes.columns(finished).len();
                let begin = supernodes.panel(finished).start + width + from;
                let source = Source {
                    real: &real_before[begin..],
                    imaginary: imaginary_before.get(begin..).unwrap_or_default(),
                    height: supernodes.height(finished),
                    width,
                };
                let target = Target { real, imaginary, height, columns: &rows[..until - from], rows: &rows };
                subtract_product(simd, source, target, &mut scratch);
                pending[finished] = until;
                if let Some(&row) = below.get(until) {
                    let later = supernodes.of_row[row as usize] as usize;
                    next[finished] = std::mem::replace(&mut first_with_rows_in[later], finished as u32);
                }
            }

            for begin in (0..columns.len()).step_by(FEW) {
                let few = FEW.min(columns.len() - begin);
                if begin > 0 {
                    // By halves: as many columns as are behind since the last larger power of two, to as many ahead.
                    let reach = begin & begin.wrapping_neg();
                    let (real_before, real) = real.split_at_mut(begin * height);
                    let (imaginary_before, imaginary) =
                        imaginary.split_at_mut(if is_complex { begin * height } else { 0 });
                    let first = (begin - reach) * height + begin;
                    let source = Source {
                        real: &real_before[first..],
                        imaginary: imaginary_before.get(first..).unwrap_or_default(),
                        height,
                        width: reach,
                    };
                    let ahead = reach.min(columns.len() - begin);
                    let (rows, columns) = (&numbers[begin..height], &numbers[..ahead]);
                    subtract_product(simd, source, Target { real, imaginary, height, columns, rows }, &mut scratch);
                }
                let real = &mut real[begin * height..];
                let imaginary = if is_complex { &mut imaginary[begin * height..] } else { &mut *imaginary };
                for k in 0..few {
                    finish_column(real, imaginary, height, begin, k, few).ok_or(columns.start + begin + k)?;
                }
            }
            if let Some(&row) = supernodes.below(s).first() {
                let later = supernodes.of_row[row as usize] as usize;
                next[s] = std::mem::replace(&mut first_with_rows_in[later], s as u32);
            }
        }
        Ok(())
    }
}

/// Divides column `k` by the root of its pivot, and takes its share from the columns after it, up to `few`. Column 0 has
/// its pivot in row `begin`.
#[inline(always)]
fn finish_column(
    real: &mut [f64],
    imaginary: &mut [f64],
    height: usize,
    begin: usize,
    k: usize,
    few: usize,
) -> Option<()> {
    let is_complex = !imaginary.is_empty();
    let (before, after) = real.split_at_mut((k + 1) * height);
    let re = &mut before[k * height + begin + k..];
    let pivot = re[0];
    if !(pivot > 0.0 && pivot < f64::INFINITY) {
        return None;
    }
    let root = pivot.sqrt();
    re[0] = root;
    re[1..].iter_mut().for_each(|x| *x /= root);
    let (im, after_im) = if is_complex {
        let (before, after) = imaginary.split_at_mut((k + 1) * height);
        let im = &mut before[k * height + begin + k..];
        im.iter_mut().for_each(|x| *x /= root);
        (im, after)
    } else {
        (&mut [][..], &mut [][..])
    };
    for j in 1..few - k {
        let range = (j - 1) * height + begin + k + j..j * height;
        let (re, from_re) = (re[j], &re[j..]);
        let column = &mut after[range.clone()];
        if is_complex {
            let (im, from_im) = (im[j], &im[j..]);
            let column_im = &mut after_im[range];
            for (((x, y), a), b) in column.iter_mut().zip(column_im).zip(from_re).zip(from_im) {
                *x -= a * re + b * im;
                *y -= b * re - a * im;
            }
        } else {
            column.iter_mut().zip(from_re).for_each(|(x, a)| *x -= a * re);
        }
    }
    Some(())
}

struct Solve<'a> {
    panels: &'a Panels,
    supernodes: &'a Supernodes,
    x: &'a mut Vectors,
}

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Solve { panels, supernodes, x } = self;
        let mut rest: Vectors = Vec::new();
        for s in 0..supernodes.count() {
            let (columns, height, panel) = (supernodes.columns(s), supernodes.height(s), supernodes.panel(s));
            let width = columns.len();
            gather(&mut rest, x, columns.clone(), supernodes.below(s));
            let real = &panels.planes[0][panel.clone()];
            for j in 0..width {
                rest[j] = rest[j].map(|x| x / real[j * height + j]);
                let (above, after) = rest.split_at_mut(j + 1);
                let x = above[j];
                spread(after, x, &real[j * height + j + 1..(j + 1) * height]);
                if let Some(plane) = panels.planes.get(1) {
                    spread(after, turned(x), &plane[panel.clone()][j * height + j + 1..(j + 1) * height]);
                }
            }
            x[columns].copy_from_slice(&rest[..width]);
            supernodes.below(s).iter().zip(&rest[width..]).for_each(|(&row, rest)| x[row as usize] = *rest);
        }
        for s in (0..supernodes.count()).rev() {
            let (columns, height, panel) = (supernodes.columns(s), supernodes.height(s), supernodes.panel(s));
            let width = columns.len();
            gather(&mut rest, x, columns.clone(), supernodes.below(s));
            let real = &panels.planes[0][panel.clone()];
            for j in (0..width).rev() {
                let (above, after) = rest.split_at_mut(j + 1);
                let mut x = less(above[j], collect(after, &real[j * height + j + 1..(j + 1) * height]));
                if let Some(plane) = panels.planes.get(1) {
                    let sum = collect(after, &plane[panel.clone()][j * height + j + 1..(j + 1) * height]);
                    // The conjugate of L is in question, so that what is turned is added.
                    x = less(x, turned(sum).map(|x| -x));
                }
                above[j] = x.map(|x| x / real[j * height + j]);
            }
            x[columns].copy_from_slice(&rest[..width]);
        }
    }
}

#[inline(always)]
fn gather(rest: &mut Vectors, x: &Vectors, columns: std::ops::Range<usize>, below: &[u32]) {
    rest.clear();
    rest.extend_from_slice(&x[columns]);
    rest.extend(below.iter().map(|&row| x[row as usize]));
}

/// i x.
#[inline(always)]
fn turned([a, b, c, d]: [f64; 4]) -> [f64; 4] {
    [-b, a, -d, c]
}

#[inline(always)]
fn less(x: [f64; 4], y: [f64; 4]) -> [f64; 4] {
    std::array::from_fn(|k| x[k] - y[k])
}

/// Takes `x` times the column from the rest.
#[inline(always)]
fn spread(rest: &mut [[f64; 4]], x: [f64; 4], column: &[f64]) {
    for (rest, l) in rest.iter_mut().zip(column) {
        for k in 0..4 {
            rest[k] -= l * x[k];
        }
    }
}

/// The sum of the rest, times the column.
#[inline(always)]
fn collect(rest: &[[f64; 4]], column: &[f64]) -> [f64; 4] {
    // Four sums side by side, because a sum waits for the one before.
    let mut sums = [[0.0; 4]; 4];
    let (rests, last) = rest.as_chunks::<4>();
    let (columns, last_column) = column.as_chunks::<4>();
    for (rest, l) in rests.iter().zip(columns) {
        for part in 0..4 {
            for k in 0..4 {
                sums[part][k] += l[part] * rest[part][k];
            }
        }
    }
    for (part, (rest, l)) in last.iter().zip(last_column).enumerate() {
        for k in 0..4 {
            sums[part][k] += l * rest[k];
        }
    }
    std::array::from_fn(|k| (sums[0][k] + sums[1][k]) + (sums[2][k] + sums[3][k]))
}
