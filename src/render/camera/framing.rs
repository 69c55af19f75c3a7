//! From which side a surface is seen, and from how far.

use glam::DVec3;

use super::{Extent, RenderError, camera::Lens};
use crate::scene::CameraSection;

/// A shape flatter than this (ratio of the smaller two standard deviations) is seen lying on a table.
const FLATNESS: f64 = 0.75;

/// Direction toward the eye and up, unit and perpendicular enough.
pub fn orientation(section: &CameraSection, extent: &Extent) -> Result<(DVec3, DVec3), RenderError> {
    let [(long, _), (middle, middle_variance), (short, short_variance)] = extent.principal_axes();
    let lies_flat = short_variance < FLATNESS * FLATNESS * middle_variance;
    let (usual_direction, usual_up) = if lies_flat {
        (short * 0.62 - middle * 0.70 + long * 0.25, short)
    } else {
        (short * 0.80 + long * 0.45 + middle * 0.38, middle)
    };
    let up = section.up.map(|up| unit("up", DVec3::from_array(up))).transpose()?;
    let toward_eye = match (section.direction, up) {
        (Some(direction), _) => unit("direction", DVec3::from_array(direction))?,
        (None, None) => usual_direction.normalize(),
        // With up given, the broad side is seen from a little above.
        (None, Some(up)) => {
            let broad = if short.dot(up).abs() < 0.8 { short } else { middle };
            let level = (broad - up * broad.dot(up)).normalize();
            (level * 0.85 + up.cross(level) * 0.35 + up * 0.40).normalize()
        }
    };
    let up = match up {
        Some(up) => upright(up, toward_eye)?,
        None => [usual_up, middle, long].into_iter().find(|axis| axis.dot(toward_eye).abs() < 0.95).unwrap_or(long),
    };
    Ok((toward_eye, up))
}

pub fn in_range(
    key: &'static str,
    value: Option<f64>,
    usual: f64,
    range: std::ops::RangeInclusive<f64>,
    words: &'static str,
) -> Result<f64, RenderError> {
    let value = value.unwrap_or(usual);
    if range.contains(&value) {
        return Ok(value);
    }
    Err(RenderError::Camera { key, value: value.to_string(), reason: "is out of range", remedy: words })
}

pub fn unit(key: &'static str, vector: DVec3) -> Result<DVec3, RenderError> {
    vector.try_normalize().ok_or_else(|| RenderError::Camera {
        key,
        value: format!("[{}, {}, {}]", vector.x, vector.y, vector.z),
        reason: "has no direction",
        remedy: "write a finite vector that is not zero, like [0, 0, 1]",
    })
}

pub fn upright(up: DVec3, toward_eye: DVec3) -> Result<DVec3, RenderError> {
    if up.cross(toward_eye).length() > 1e-6 {
        return Ok(up);
    }
    Err(RenderError::Camera {
        key: "up",
        value: format!("[{}, {}, {}]", up.x, up.y, up.z),
        reason: "is parallel to the direction of view",
        remedy: "turn one of them, or leave `up` out",
    })
}

/// The nearest eye, relative to the middle, from which every point lies in the filled part of the picture.
pub fn fit_perspective(points: &[DVec3], radius: f64, tangent: f64, aspect: f64, fill: f64) -> (DVec3, Lens) {
    // |x - eye.x| <= t (eye.z - z) for all points: two half-planes per axis.
    let fit = |along: fn(&DVec3) -> f64, t: f64| {
        let high = points.iter().map(|point| along(point) + t * point.z).fold(f64::MIN, f64::max);
        let low = points.iter().map(|point| -along(point) + t * point.z).fold(f64::MIN, f64::max);
        ((high - low) / 2.0, (high + low) / (2.0 * t))
    };
    let (x, distance_for_width) = fit(|point| point.x, tangent * aspect * fill);
    let (y, distance_for_height) = fit(|point| point.y, tangent * fill);
    let foremost = points.iter().map(|point| point.z).fold(f64::MIN, f64::max);
    let distance = distance_for_width.max(distance_for_height).max(foremost + 1e-2 * radius);
    (DVec3::new(x, y, distance), Lens::Perspective { tangent })
}

pub fn fit_orthographic(points: &[DVec3], radius: f64, aspect: f64, fill: f64) -> (DVec3, Lens) {
    let low = points.iter().copied().fold(DVec3::MAX, DVec3::min);
    let high = points.iter().copied().fold(DVec3::MIN, DVec3::max);
    let half = (high - low) / 2.0;
    let half_height = half.y.max(half.x / aspect).max(1e-3 * radius) / fill;
    let middle = (low + high) / 2.0;
    (DVec3::new(middle.x, middle.y, 3.0 * radius), Lens::Orthographic { half_height })
}
