//! The numbers of a sparse Cholesky factor, a dense panel per supernode, and what is done with them.

use super::elimination::Elimination;
use super::factorize::factorize;
use super::supernodes::Supernodes;
use pulp::{Arch, Simd, WithSimd};

/// Per row four real numbers, or two complex ones: real and imaginary part of the first, then of the second.
pub(super) type Vectors = Vec<[f64; 4]>;

/// The panels of all supernodes, column by column: their real parts, and the imaginary ones if there are any.
#[derive(Debug)]
pub(super) struct Panels {
    planes: Vec<Vec<f64>>,
    elimination: Elimination,
}

impl Panels {
    pub fn zeros(supernodes: &Supernodes, planes: usize) -> Panels {
        Panels {
            planes: (0..planes).map(|_| vec![0.0; supernodes.len()]).collect(),
            elimination: Elimination::of(supernodes),
        }
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
        let mut planes = self.planes.iter_mut().map(Vec::as_mut_slice);
        let (real, imaginary) = (planes.next().unwrap_or_default(), planes.next().unwrap_or_default());
        factorize(supernodes, &self.elimination, real, imaginary)
    }

    /// x ↦ (L L*)⁻¹ x.
    pub fn solve(&self, supernodes: &Supernodes, x: &mut Vectors) {
        Arch::new().dispatch(Solve { panels: self, supernodes, x });
    }
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
