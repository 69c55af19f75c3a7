//! sRGB to linear light and back, and the tone curve.

use std::sync::LazyLock;

use glam::Vec3;
use wide::f32x4;

/// Linear light of an sRGB byte triple.
pub fn linear_from_srgb(rgb: [u8; 3]) -> Vec3 {
    Vec3::from(rgb.map(|byte| {
        let value = f32::from(byte) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { libm::powf((value + 0.055) / 1.055, 2.4) }
    }))
}

/// The sRGB curve over the square root of the linear value, where it is nearly straight.
static ENCODE: LazyLock<Vec<f32>> = LazyLock::new(|| {
    (0..=ENCODE_STEPS)
        .map(|step| {
            let root = step as f32 / ENCODE_STEPS as f32;
            let value = root * root;
            if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * libm::powf(value, 1.0 / 2.4) - 0.055 }
        })
        .collect()
});
const ENCODE_STEPS: usize = 1024;

/// sRGB values between 0 and 1 of linear light, all parts at once; what is outside 0 to 1 is clamped.
fn srgb(color: Vec3) -> f32x4 {
    let (zero, one) = (f32x4::splat(0.0), f32x4::splat(1.0));
    let place = f32x4::new([color.x, color.y, color.z, 0.0]).fast_max(zero).fast_min(one).sqrt()
        * f32x4::splat(ENCODE_STEPS as f32);
    let step = place.fast_trunc_int();
    let [r, g, b, _] = step.to_array().map(|step| (step as usize).min(ENCODE_STEPS - 1));
    let [low, high] = [0, 1].map(|next| f32x4::new([ENCODE[r + next], ENCODE[g + next], ENCODE[b + next], 0.0]));
    let part = place - f32x4::new([r as f32, g as f32, b as f32, 0.0]);
    low * (one - part) + high * part
}

/// sRGB bytes of linear light. `noise` is added before rounding, in steps of a byte.
pub fn srgb_bytes(color: Vec3, noise: f32) -> [u8; 3] {
    let value = srgb(color) * f32x4::splat(255.0) + f32x4::splat(noise + 0.5);
    let [r, g, b, _] = value.fast_max(f32x4::splat(0.0)).fast_min(f32x4::splat(255.0)).fast_trunc_int().to_array();
    [r as u8, g as u8, b as u8]
}

/// sRGB with 16 bits of linear light.
pub fn srgb_words(color: Vec3) -> [u16; 3] {
    let value = srgb(color) * f32x4::splat(65535.0) + f32x4::splat(0.5);
    let [r, g, b, _] = value.fast_trunc_int().to_array();
    [r as u16, g as u16, b as u16]
}

/// Below this the tone curve changes nothing, so that colours which carry meaning keep it.
const SHOULDER: f32 = 0.8;

/// Identity up to the shoulder, then an exponential approach to 1.
#[inline]
pub fn tone_mapped(color: Vec3) -> Vec3 {
    if color.max_element() <= SHOULDER {
        return color;
    }
    let curve = |value: f32| {
        if value <= SHOULDER {
            value
        } else {
            let room = 1.0 - SHOULDER;
            SHOULDER + room * (1.0 - libm::expf(-(value - SHOULDER) / room))
        }
    };
    Vec3::new(curve(color.x), curve(color.y), curve(color.z))
}
