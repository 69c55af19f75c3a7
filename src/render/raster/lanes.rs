//! Arithmetic on the samples of a pixel, four at a time: there are one, or a multiple of four.

use wide::{f32x4, i32x4};

/// The samples from the fourfold of `quad` on; a single one is repeated.
#[inline(always)]
fn load<T: Copy, const S: usize>(samples: &[T; S], quad: usize) -> [T; 4] {
    if S < 4 {
        return [samples[0]; 4];
    }
    let first = 4 * quad;
    [samples[first], samples[first + 1], samples[first + 2], samples[first + 3]]
}

#[inline(always)]
fn store<T: Copy, const S: usize>(samples: &mut [T; S], quad: usize, values: [T; 4]) {
    if S < 4 {
        samples[0] = values[0];
    } else {
        samples[4 * quad..4 * quad + 4].copy_from_slice(&values);
    }
}

/// Negative where any of three edge functions is.
#[inline(always)]
pub fn outside<const S: usize>(values: [i32; 3], to_samples: &[[i32; S]; 3]) -> [i32; S] {
    let mut outside = [0; S];
    for quad in 0..S.div_ceil(4) {
        let [a, b, c] = [
            i32x4::new(load(&to_samples[0], quad)) + i32x4::splat(values[0]),
            i32x4::new(load(&to_samples[1], quad)) + i32x4::splat(values[1]),
            i32x4::new(load(&to_samples[2], quad)) + i32x4::splat(values[2]),
        ];
        store(&mut outside, quad, (a | b | c).to_array());
    }
    outside
}

/// The sums of a value and those of samples, not below and not above the ends of a range.
#[inline(always)]
pub fn clamped_sums<const S: usize>(value: f32, to_samples: &[f32; S], range: [f32; 2]) -> [f32; S] {
    let mut sums = [0.0; S];
    for quad in 0..S.div_ceil(4) {
        let sum = f32x4::new(load(to_samples, quad)) + f32x4::splat(value);
        store(&mut sums, quad, sum.fast_max(f32x4::splat(range[0])).fast_min(f32x4::splat(range[1])).to_array());
    }
    sums
}

/// Where a sample is not outside and the new depth is greater, takes it and the id.
#[inline(always)]
pub fn take_nearer<const S: usize>(
    depths: &mut [f32; S],
    ids: &mut [u32; S],
    outside: &[i32; S],
    new_depth: &[f32; S],
    new_id: u32,
) {
    // Numbers that are not negative are in the order of their bits.
    let bits = |[a, b, c, d]: [f32; 4]| {
        i32x4::new([a.to_bits() as i32, b.to_bits() as i32, c.to_bits() as i32, d.to_bits() as i32])
    };
    let as_ids = |[a, b, c, d]: [u32; 4]| i32x4::new([a as i32, b as i32, c as i32, d as i32]);
    for quad in 0..S.div_ceil(4) {
        let (old, new) = (bits(load(depths, quad)), bits(load(new_depth, quad)));
        let inside = i32x4::new(load(outside, quad)).simd_gt(i32x4::splat(-1));
        let nearer = new.simd_gt(old) & inside;
        let [a, b, c, d] = ((new & nearer) | (old & !nearer)).to_array();
        let float = |bits: i32| f32::from_bits(bits as u32);
        store(depths, quad, [float(a), float(b), float(c), float(d)]);
        let [a, b, c, d] = ((i32x4::splat(new_id as i32) & nearer) | (as_ids(load(ids, quad)) & !nearer)).to_array();
        store(ids, quad, [a as u32, b as u32, c as u32, d as u32]);
    }
}

/// The least of the samples of some pixels.
#[inline(always)]
pub fn least<const S: usize>(pixels: &[[f32; S]], so_far: f32) -> f32 {
    let mut least = f32x4::splat(so_far);
    for samples in pixels {
        for quad in 0..S.div_ceil(4) {
            least = least.fast_min(f32x4::new(load(samples, quad)));
        }
    }
    least.to_array().into_iter().fold(so_far, f32::min)
}
