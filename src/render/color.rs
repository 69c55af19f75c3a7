//! sRGB to linear light and back, and the tone curve.

use std::sync::LazyLock;

use glam::Vec3;

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

/// sRGB value between 0 and 1 of linear light; what is outside 0 to 1 is clamped.
pub fn srgb_from_linear(value: f32) -> f32 {
    let place = value.clamp(0.0, 1.0).sqrt() * ENCODE_STEPS as f32;
    let step = (place as usize).min(ENCODE_STEPS - 1);
    let part = place - step as f32;
    ENCODE[step] * (1.0 - part) + ENCODE[step + 1] * part
}

/// Below this the tone curve changes nothing, so that colours which carry meaning keep it.
const SHOULDER: f32 = 0.8;

/// Identity up to the shoulder, then an exponential approach to 1.
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
