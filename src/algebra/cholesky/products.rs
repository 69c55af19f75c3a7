//! Products of panels. Every number of a product is summed column by column, whichever block it falls into.

use pulp::{Scalar, Simd};

/// Rows of a finished panel, from the first that is needed on: `width` columns, `height` numbers apart.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub real: &'a [f64],
    /// Empty where numbers are real.
    pub imaginary: &'a [f64],
    pub height: usize,
    pub width: usize,
}

/// Where the product goes: its columns are the first rows of the source, and its rows all of them.
pub(super) struct Target<'a> {
    pub real: &'a mut [f64],
    /// Empty where numbers are real.
    pub imaginary: &'a mut [f64],
    pub height: usize,
    pub columns: &'a [u32],
    pub rows: &'a [u32],
}

/// Columns of the source, and of the target, that are worked on together, so that they stay in the caches.
const DEPTH: usize = 256;
const BREADTH: usize = 128;

/// Copies of what is read again and again.
#[derive(Default)]
pub(super) struct Scratch {
    /// A few rows of the source, column by column.
    rows: [Vec<f64>; 2],
    /// Its first rows, four or one at a time, column by column.
    first_rows: [Vec<f64>; 2],
}

/// Takes S S₁* from the target, S being the source and S₁ its first rows, as far as it is not above the diagonal.
#[inline(always)]
pub(super) fn subtract_product<S: Simd>(simd: S, source: Source, mut target: Target, scratch: &mut Scratch) {
    let (all, height) = (target.columns.len(), source.height);
    for depth in (0..source.width).step_by(DEPTH) {
        let deep = DEPTH.min(source.width - depth);
        let planes = [source.real, source.imaginary].map(|plane| plane.get(depth * height..).unwrap_or_default());
        for begin in (0..all).step_by(BREADTH) {
            let count = BREADTH.min(all - begin);
            let in_fours = count / 4 * 4;
            let groups =
                || (0..in_fours).step_by(4).map(|first| (first, 4)).chain((in_fours..count).map(|row| (row, 1)));
            for (plane, packed) in planes.into_iter().zip(&mut scratch.first_rows) {
                packed.clear();
                for (first, rows) in groups().filter(|_| !plane.is_empty()) {
                    pack(packed, plane, (begin + first, height), rows, deep);
                }
            }
            let mut row = begin;
            while row < target.rows.len() {
                let left = target.rows.len() - row;
                let step = [2 * S::F64_LANES, S::F64_LANES].into_iter().find(|step| *step <= left).unwrap_or(1);
                for (plane, packed) in planes.into_iter().zip(&mut scratch.rows) {
                    packed.clear();
                    if !plane.is_empty() {
                        pack(packed, plane, (row, height), step, deep);
                    }
                }
                let rows = scratch.rows.each_ref().map(Vec::as_slice);
                for (first, columns) in groups().take_while(|(first, _)| begin + first < row + step) {
                    let range = first * deep..(first + columns) * deep;
                    let firsts =
                        scratch.first_rows.each_ref().map(|plane| plane.get(range.clone()).unwrap_or_default());
                    let at = (row, begin + first);
                    match (step == 1, step == S::F64_LANES, columns) {
                        (true, _, 4) => block::<_, 1, 4>(Scalar, rows, firsts, &mut target, at),
                        (true, ..) => block::<_, 1, 1>(Scalar, rows, firsts, &mut target, at),
                        (_, true, 4) => block::<_, 1, 4>(simd, rows, firsts, &mut target, at),
                        (_, true, _) => block::<_, 1, 1>(simd, rows, firsts, &mut target, at),
                        (_, _, 4) => block::<_, 2, 4>(simd, rows, firsts, &mut target, at),
                        _ => block::<_, 2, 1>(simd, rows, firsts, &mut target, at),
                    }
                }
                row += step;
            }
        }
    }
}

/// Appends `count` rows of the first `deep` columns of a plane, column by column.
#[inline(always)]
fn pack(packed: &mut Vec<f64>, plane: &[f64], (row, height): (usize, usize), count: usize, deep: usize) {
    // A copy of few numbers takes less time than to ask for one.
    match count {
        16 => pack_few::<16>(packed, plane, row, height, deep),
        8 => pack_few::<8>(packed, plane, row, height, deep),
        4 => pack_few::<4>(packed, plane, row, height, deep),
        2 => pack_few::<2>(packed, plane, row, height, deep),
        1 => pack_few::<1>(packed, plane, row, height, deep),
        _ => (0..deep).for_each(|k| packed.extend_from_slice(&plane[k * height + row..][..count])),
    }
}

#[inline(always)]
fn pack_few<const N: usize>(packed: &mut Vec<f64>, plane: &[f64], row: usize, height: usize, deep: usize) {
    packed.reserve(N * deep);
    for column in plane[row..].chunks(height).take(deep) {
        column.first_chunk::<N>().into_iter().for_each(|few| packed.extend_from_slice(few));
    }
}

/// `R` registers of rows times `C` columns.
#[inline(always)]
fn block<S: Simd, const R: usize, const C: usize>(
    simd: S,
    rows: [&[f64]; 2],
    firsts: [&[f64]; 2],
    target: &mut Target,
    (row, column): (usize, usize),
) {
    let [a, b] = rows.map(|rows| S::as_simd_f64s(rows).0.as_chunks::<R>().0);
    let [re, im] = firsts.map(|plane| plane.as_chunks::<C>().0);
    let (rows, columns) = (&target.rows[row..row + R * S::F64_LANES], &target.columns[column..column + C]);
    if im.is_empty() {
        subtract::<S, R, C>(target.real, target.height, rows, columns, sums(simd, a, re));
    } else {
        let (first, second) = (sums(simd, a, re), sums(simd, b, im));
        let sum = |c: usize, r: usize| simd.add_f64s(first[c][r], second[c][r]);
        let both: [[_; R]; C] = std::array::from_fn(|c| std::array::from_fn(|r| sum(c, r)));
        subtract::<S, R, C>(target.real, target.height, rows, columns, both);
        let (first, second) = (sums(simd, b, re), sums(simd, a, im));
        let sum = |c: usize, r: usize| simd.sub_f64s(first[c][r], second[c][r]);
        let both: [[_; R]; C] = std::array::from_fn(|c| std::array::from_fn(|r| sum(c, r)));
        subtract::<S, R, C>(target.imaginary, target.height, rows, columns, both);
    }
}

/// Σ_k a_rk b_kc, per c and r.
#[inline(always)]
fn sums<S: Simd, const R: usize, const C: usize>(simd: S, a: &[[S::f64s; R]], b: &[[f64; C]]) -> [[S::f64s; R]; C] {
    let mut sums = [[simd.splat_f64s(0.0); R]; C];
    for (a, b) in a.iter().zip(b) {
        for c in 0..C {
            let b = simd.splat_f64s(b[c]);
            for r in 0..R {
                // Not fused: where a processor cannot, the bits would differ.
                sums[c][r] = simd.add_f64s(sums[c][r], simd.mul_f64s(a[r], b));
            }
        }
    }
    sums
}

#[inline(always)]
fn subtract<S: Simd, const R: usize, const C: usize>(
    target: &mut [f64],
    height: usize,
    rows: &[u32],
    columns: &[u32],
    sums: [[S::f64s; R]; C],
) {
    for (sums, &column) in sums.iter().zip(columns) {
        let column = &mut target[column as usize * height..][..height];
        let sums: &[f64] = pulp::bytemuck::cast_slice(sums);
        if let Some(column) = in_a_run(rows).and_then(|run| column.get_mut(run)) {
            column.iter_mut().zip(sums).for_each(|(x, sum)| *x -= sum);
            continue;
        }
        for (sum, &row) in sums.iter().zip(rows) {
            column[row as usize] -= sum;
        }
    }
}

/// Ascending rows as a range, if none is missing between them.
#[inline(always)]
fn in_a_run(rows: &[u32]) -> Option<std::ops::Range<usize>> {
    let (first, last) = (*rows.first()? as usize, *rows.last()? as usize);
    (last - first + 1 == rows.len()).then_some(first..last + 1)
}
