//! The dense factorization of a panel that has taken all from finished ones.

use super::products::{Scratch, Source, Target, subtract_product};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Columns of a panel that are finished one by one, before later ones take from them together.
const FEW: usize = 8;
/// Columns of a strip of a panel of the trunk.
pub(super) const STRIP: usize = 32;
/// A part of the panels: real parts, and imaginary ones if there are any.
pub(super) struct Part<'a> {
    pub real: &'a mut [f64],
    pub imaginary: &'a mut [f64],
}

impl<'a> Part<'a> {
    /// What is before a place and what is from there on, leaving nothing.
    pub fn split(self, place: usize) -> (Part<'a>, Part<'a>) {
        let (real, real_after) = self.real.split_at_mut(place);
        let (imaginary, imaginary_after) = self.imaginary.split_at_mut(place.min(self.imaginary.len()));
        (Part { real, imaginary }, Part { real: real_after, imaginary: imaginary_after })
    }

    pub fn reborrow(&mut self) -> Part<'_> {
        Part { real: self.real, imaginary: self.imaginary }
    }

    /// Strips of columns, and the first column of each.
    pub fn strips(self, height: usize) -> Vec<(usize, Part<'a>)> {
        let mut imaginary = self.imaginary.chunks_mut(STRIP * height);
        let strips = self.real.chunks_mut(STRIP * height).enumerate();
        strips.map(|(k, real)| (k * STRIP, Part { real, imaginary: imaginary.next().unwrap_or_default() })).collect()
    }
}

/// What is used again and again on one thread.
#[derive(Default)]
pub(super) struct Products {
    pub rows: Vec<u32>,
    pub columns: Vec<u32>,
    pub scratch: Scratch,
}

/// The dense factorization of a panel that has taken everything; else it says the column whose pivot is not positive.
pub(super) struct Finish<'a> {
    pub part: Part<'a>,
    pub height: usize,
    pub products: &'a mut Products,
    /// Whether strips of columns take from finished ones side by side.
    pub in_strips: bool,
}

impl WithSimd for Finish<'_> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), usize> {
        let Finish { mut part, height, products, in_strips } = self;
        let width = part.real.len() / height;
        let Products { rows: numbers, scratch, .. } = products;
        numbers.clear();
        numbers.extend(0..height as u32);
        for begin in (0..width).step_by(FEW) {
            let few = FEW.min(width - begin);
            let (before, mut from) = part.reborrow().split(begin * height);
            if begin > 0 {
                // By halves: as many columns as are behind since the last larger power of two, to as many ahead.
                let reach = begin & begin.wrapping_neg();
                let (target, _) = from.reborrow().split(reach.min(width - begin) * height);
                let done = Done { real: before.real, imaginary: before.imaginary, begin, reach, height, numbers };
                if in_strips && target.real.len() > STRIP * height {
                    target
                        .strips(height)
                        .into_par_iter()
                        .with_max_len(1)
                        .for_each_init(Scratch::default, |scratch, (first, part)| {
                            Arch::new().dispatch(TakeDone { done, first, part, scratch })
                        });
                } else {
                    TakeDone { done, first: 0, part: target, scratch }.with_simd(simd);
                }
            }
            for k in 0..few {
                finish_column(from.real, from.imaginary, height, begin, k, few).ok_or(begin + k)?;
            }
        }
        Ok(())
    }
}

/// Columns of a panel that are finished.
#[derive(Clone, Copy)]
struct Done<'a> {
    real: &'a [f64],
    imaginary: &'a [f64],
    /// The first that follows.
    begin: usize,
    /// How many of them are taken from.
    reach: usize,
    height: usize,
    numbers: &'a [u32],
}

/// Takes finished columns of a panel from later ones, of which the first is `first` after the first that follows.
struct TakeDone<'a> {
    done: Done<'a>,
    first: usize,
    part: Part<'a>,
    scratch: &'a mut Scratch,
}

impl WithSimd for TakeDone<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let TakeDone { done, first, part, scratch } = self;
        let Done { real, imaginary, begin, reach, height, numbers } = done;
        let place = (begin - reach) * height + begin + first;
        let source = Source {
            real: &real[place..],
            imaginary: imaginary.get(place..).unwrap_or_default(),
            height,
            width: reach,
        };
        let (rows, columns) = (&numbers[begin + first..], &numbers[..part.real.len() / height]);
        let target = Target { real: part.real, imaginary: part.imaginary, height, columns, rows };
        subtract_product(simd, source, target, scratch);
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
