use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

use super::{Extent, Output, RenderError};
use crate::scene::CameraSection;

/// A view of the surface.
///
/// View space has x to the right, y up and z toward the eye, which sits at the origin. Clip space has
/// `|x|, |y| <= w` in the picture and `0 <= z <= w` in depth, where z / w is largest at the near plane:
/// it is affine in the picture plane for perspective and orthographic views alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    view_from_world: DAffine3,
    lens: Lens,
    aspect: f64,
    /// Distance from the eye below which nothing is seen.
    near: f64,
    /// Distance beyond which an orthographic view sees nothing.
    far: f64,
    /// Middle and radius of what was framed, in world space.
    subject: (DVec3, f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Lens {
    /// Tangent of half the vertical field of view.
    Perspective { tangent: f64 },
    /// Half the height of the picture in world units.
    Orthographic { half_height: f64 },
}

const FIELD_OF_VIEW_DEGREES: f64 = 30.0;
const FILL: f64 = 0.85;
/// A shape flatter than this (ratio of the smaller two standard deviations) is seen lying on a table.
const FLATNESS: f64 = 0.75;

impl Camera {
    /// A camera that sees all of `extent` from the direction the section asks for, or from a good one.
    ///
    /// Frame a whole film by merging the extents of its frames: the camera then never moves.
    ///
    /// # Errors
    /// [`RenderError::Camera`] on impossible values, [`RenderError::NothingToFrame`] on an empty extent.
    pub fn framing(section: &CameraSection, extent: &Extent, output: &Output) -> Result<Self, RenderError> {
        let (center, radius) = extent.ball().ok_or(RenderError::NothingToFrame)?;
        // A single point still gets a picture.
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let fov = in_range("field_of_view", section.field_of_view, FIELD_OF_VIEW_DEGREES, 0.0..=150.0, "0 to 150")?;
        let fill = in_range("fill", section.fill, FILL, 0.05..=1.0, "0.05 to 1")?;
        let (toward_eye, up) = orientation(section, extent)?;
        let view_axes = {
            let right = up.cross(toward_eye).normalize();
            DMat3::from_cols(right, toward_eye.cross(right), toward_eye)
        };
        let view_from_world = view_axes.transpose();
        let points: Vec<DVec3> = extent.outermost().iter().map(|&point| view_from_world * (point - center)).collect();

        let aspect = output.aspect();
        let (eye, lens) = if fov == 0.0 {
            fit_orthographic(&points, radius, aspect, fill)
        } else {
            fit_perspective(&points, radius, libm::tan(fov.to_radians() / 2.0), aspect, fill)
        };
        let view_from_world =
            DAffine3::from_mat3(view_from_world) * DAffine3::from_translation(-center - view_axes * eye);
        let (near, far) = match lens {
            Lens::Perspective { .. } => (1e-3 * radius, f64::INFINITY),
            Lens::Orthographic { .. } => (0.0, 2.0 * eye.z),
        };
        Ok(Self { view_from_world, lens, aspect, near, far, subject: (center, radius) })
    }

    /// A perspective camera at `eye`, looking at `target`, for surfaces about `radius` in size.
    ///
    /// # Errors
    /// [`RenderError::Camera`] if the direction or `up` has no length, or they are parallel, or the field of view
    /// (vertical, degrees) is not above 0 and at most 150.
    pub fn look_at(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        field_of_view: f64,
        radius: f64,
        output: &Output,
    ) -> Result<Self, RenderError> {
        let fov = in_range("field_of_view", Some(field_of_view), 0.0, 1e-3..=150.0, "0.001 to 150")?;
        let toward_eye = unit("direction", eye - target)?;
        let up = upright(unit("up", up)?, toward_eye)?;
        let right = up.cross(toward_eye).normalize();
        let view_axes = DMat3::from_cols(right, toward_eye.cross(right), toward_eye);
        Ok(Self {
            view_from_world: DAffine3::from_mat3(view_axes.transpose()) * DAffine3::from_translation(-eye),
            lens: Lens::Perspective { tangent: libm::tan(fov.to_radians() / 2.0) },
            aspect: output.aspect(),
            near: 1e-3 * radius,
            far: f64::INFINITY,
            subject: (target, radius),
        })
    }

    /// Rotation and translation from the scene's space to the eye's.
    pub fn view_from_world(&self) -> DAffine3 {
        self.view_from_world
    }

    /// Projection; see the type for its conventions.
    pub fn clip_from_view(&self) -> DMat4 {
        let rows = match self.lens {
            Lens::Perspective { tangent } => [
                DVec4::new(1.0 / (tangent * self.aspect), 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / tangent, 0.0, 0.0),
                DVec4::new(0.0, 0.0, 0.0, self.near),
                DVec4::new(0.0, 0.0, -1.0, 0.0),
            ],
            Lens::Orthographic { half_height } => [
                DVec4::new(1.0 / (half_height * self.aspect), 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / half_height, 0.0, 0.0),
                DVec4::new(0.0, 0.0, 1.0, self.far) / (self.far - self.near),
                DVec4::W,
            ],
        };
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
    }

    /// Middle and radius of what was framed, in world space.
    pub fn subject(&self) -> (DVec3, f64) {
        self.subject
    }

    /// Whether rays of sight meet in the eye.
    pub(super) fn is_perspective(&self) -> bool {
        matches!(self.lens, Lens::Perspective { .. })
    }

    /// Distance from the eye (perspective: along the axis) of a depth z / w in clip space.
    pub(super) fn distance(&self, depth: f64) -> f64 {
        match self.lens {
            Lens::Perspective { .. } => self.near / depth,
            Lens::Orthographic { .. } => self.far - depth * (self.far - self.near),
        }
    }

    /// Length in world space that one pixel spans at a depth z / w in clip space.
    pub(super) fn pixel_size(&self, depth: f64, output: &Output) -> f64 {
        let half_height = match self.lens {
            Lens::Perspective { tangent } => tangent * self.distance(depth),
            Lens::Orthographic { half_height } => half_height,
        };
        2.0 * half_height / output.height() as f64
    }

    /// How much `depth` grows, as a factor and a summand, per pixel of height toward the eye.
    pub(super) fn lift_per_pixel(&self, output: &Output) -> (f64, f64) {
        match self.lens {
            Lens::Perspective { tangent } => (2.0 * tangent / output.height() as f64, 0.0),
            Lens::Orthographic { .. } => (0.0, self.pixel_size(0.0, output) / (self.far - self.near)),
        }
    }

    /// Origin and direction (not normalized) in view space of the ray through a place in the picture,
    /// both coordinates from -1 to 1, y up.
    pub(super) fn view_ray(&self, x: f64, y: f64) -> (DVec3, DVec3) {
        match self.lens {
            Lens::Perspective { tangent } => (DVec3::ZERO, DVec3::new(x * tangent * self.aspect, y * tangent, -1.0)),
            Lens::Orthographic { half_height } => {
                (DVec3::new(x * half_height * self.aspect, y * half_height, 0.0), DVec3::NEG_Z)
            }
        }
    }
}

/// Direction toward the eye and up, unit and perpendicular enough.
fn orientation(section: &CameraSection, extent: &Extent) -> Result<(DVec3, DVec3), RenderError> {
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

fn in_range(
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

fn unit(key: &'static str, vector: DVec3) -> Result<DVec3, RenderError> {
    vector.try_normalize().ok_or_else(|| RenderError::Camera {
        key,
        value: format!("[{}, {}, {}]", vector.x, vector.y, vector.z),
        reason: "has no direction",
        remedy: "write a finite vector that is not zero, like [0, 0, 1]",
    })
}

fn upright(up: DVec3, toward_eye: DVec3) -> Result<DVec3, RenderError> {
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
fn fit_perspective(points: &[DVec3], radius: f64, tangent: f64, aspect: f64, fill: f64) -> (DVec3, Lens) {
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

fn fit_orthographic(points: &[DVec3], radius: f64, aspect: f64, fill: f64) -> (DVec3, Lens) {
    let low = points.iter().copied().fold(DVec3::MAX, DVec3::min);
    let high = points.iter().copied().fold(DVec3::MIN, DVec3::max);
    let half = (high - low) / 2.0;
    let half_height = half.y.max(half.x / aspect).max(1e-3 * radius) / fill;
    let middle = (low + high) / 2.0;
    (DVec3::new(middle.x, middle.y, 3.0 * radius), Lens::Orthographic { half_height })
}
