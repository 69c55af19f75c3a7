//! From which side a surface is seen, and from how far.

use glam::DVec3;

use super::{extent::Extent, lens::Lens, view::View};

/// A shape flatter than this (ratio of the smaller two standard deviations) is seen lying on a table.
const FLATNESS: f64 = 0.75;

/// Direction toward the eye and up, unit and perpendicular enough.
pub fn orientation(view: &View, extent: &Extent) -> (DVec3, DVec3) {
    let [(long, _), (middle, middle_variance), (short, short_variance)] = extent.principal_axes();
    let lies_flat = short_variance < FLATNESS * FLATNESS * middle_variance;
    let (usual_direction, usual_up) = if lies_flat {
        (short * 0.62 - middle * 0.70 + long * 0.25, short)
    } else {
        (short * 0.80 + long * 0.45 + middle * 0.38, middle)
    };
    let toward_eye = match (view.direction(), view.up()) {
        (Some(direction), _) => direction,
        (None, None) => usual_direction.normalize(),
        // With up given, the broad side is seen from a little above.
        (None, Some(up)) => {
            let broad = if short.dot(up).abs() < 0.8 { short } else { middle };
            let level = (broad - up * broad.dot(up)).normalize();
            (level * 0.85 + up.cross(level) * 0.35 + up * 0.40).normalize()
        }
    };
    let usual_up = || [usual_up, middle, long].into_iter().find(|axis| axis.dot(toward_eye).abs() < 0.95);
    (toward_eye, view.up().or_else(usual_up).unwrap_or(long))
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

/// The same for an eye without perspective.
pub fn fit_orthographic(points: &[DVec3], radius: f64, aspect: f64, fill: f64) -> (DVec3, Lens) {
    let low = points.iter().copied().fold(DVec3::MAX, DVec3::min);
    let high = points.iter().copied().fold(DVec3::MIN, DVec3::max);
    let half = (high - low) / 2.0;
    let half_height = half.y.max(half.x / aspect).max(1e-3 * radius) / fill;
    let middle = (low + high) / 2.0;
    (DVec3::new(middle.x, middle.y, 3.0 * radius), Lens::Orthographic { half_height })
}
