//! An eye at a place, and what it sees.

use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

use super::{
    lens::Lens,
    view::{angle_of_view, check_upright, unit},
};
use crate::render::{Output, RenderError, ViewElement};

/// A view of the surface.
///
/// View space has x to the right, y up and z toward the eye, which sits at the origin. Clip space has
/// `|x|, |y| <= w` in the picture and `0 <= z <= w` in depth, where z / w is largest at the near plane:
/// it is affine in the picture plane for perspective and orthographic views alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    pub(in crate::render) view_from_world: DAffine3,
    pub(in crate::render) lens: Lens,
    pub(in crate::render) aspect: f64,
    /// Distance from the eye below which nothing is seen.
    pub(in crate::render) near: f64,
    /// Distance beyond which an orthographic view sees nothing.
    pub(in crate::render) far: f64,
    /// Middle and radius of what was framed, in world space.
    pub(in crate::render) subject: (DVec3, f64),
}

/// The narrowest field of view with perspective, in degrees.
const NARROWEST_DEGREES: f64 = 1e-3;

impl Camera {
    /// A perspective camera at `eye`, looking at `target`, for surfaces about `radius` in size.
    ///
    /// # Errors
    /// [`RenderError::NoDirection`] if the direction or `up` has no length, [`RenderError::UpAlongView`] if they are
    /// parallel, [`RenderError::ViewRange`] if the field of view (vertical, radians) is narrower than a thousandth of a
    /// degree or wider than [`View::WIDEST_DEGREES`](super::View::WIDEST_DEGREES).
    pub fn look_at(
        eye: DVec3,
        target: DVec3,
        up: DVec3,
        field_of_view: f64,
        radius: f64,
        output: &Output,
    ) -> Result<Self, RenderError> {
        let field_of_view = angle_of_view(field_of_view, NARROWEST_DEGREES)?;
        let toward_eye = unit(ViewElement::Direction, eye - target)?;
        let up = unit(ViewElement::Up, up)?;
        check_upright(up, toward_eye)?;
        let right = up.cross(toward_eye).normalize();
        let view_axes = DMat3::from_cols(right, toward_eye.cross(right), toward_eye);
        Ok(Self {
            view_from_world: DAffine3::from_mat3(view_axes.transpose()) * DAffine3::from_translation(-eye),
            lens: Lens::Perspective { tangent: libm::tan(field_of_view / 2.0) },
            aspect: output.aspect(),
            near: 1e-3 * radius,
            far: f64::INFINITY,
            subject: (target, radius),
        })
    }

    /// Rotation and translation from the space of the world to that of the eye.
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

    /// Vertical field of view in radians; 0 for an orthographic view.
    pub fn field_of_view(&self) -> f64 {
        match self.lens {
            Lens::Perspective { tangent } => 2.0 * libm::atan(tangent),
            Lens::Orthographic { .. } => 0.0,
        }
    }

    /// Where a point has to be for this camera to show it where `next` shows it now.
    pub fn as_seen_by(&self, next: &Camera) -> DAffine3 {
        let scale = match (self.lens, next.lens) {
            (Lens::Orthographic { half_height: here }, Lens::Orthographic { half_height: there }) => here / there,
            _ => 1.0,
        };
        let zoom = DAffine3::from_scale(DVec3::new(scale, scale, 1.0));
        self.view_from_world.inverse() * zoom * next.view_from_world
    }

    /// Whether rays of sight meet in the eye.
    pub(in crate::render) fn is_perspective(&self) -> bool {
        matches!(self.lens, Lens::Perspective { .. })
    }

    /// Distance from the eye (perspective: along the axis) of a depth z / w in clip space.
    pub(in crate::render) fn distance(&self, depth: f64) -> f64 {
        match self.lens {
            Lens::Perspective { .. } => self.near / depth,
            Lens::Orthographic { .. } => self.far - depth * (self.far - self.near),
        }
    }

    /// Length in world space that one pixel spans at a depth z / w in clip space.
    pub(in crate::render) fn pixel_size(&self, depth: f64, output: &Output) -> f64 {
        2.0 * self.lens.half_height_at(self.distance(depth)) / output.height() as f64
    }

    /// How much `depth` grows, as a factor and a summand, per pixel of height toward the eye.
    pub(in crate::render) fn lift_per_pixel(&self, output: &Output) -> (f64, f64) {
        match self.lens {
            Lens::Perspective { tangent } => (2.0 * tangent / output.height() as f64, 0.0),
            Lens::Orthographic { .. } => (0.0, self.pixel_size(0.0, output) / (self.far - self.near)),
        }
    }

    /// Origin and direction (not normalized) in view space of the ray through a place in the picture,
    /// both coordinates from -1 to 1, y up.
    pub(in crate::render) fn view_ray(&self, x: f64, y: f64) -> (DVec3, DVec3) {
        match self.lens {
            Lens::Perspective { tangent } => (DVec3::ZERO, DVec3::new(x * tangent * self.aspect, y * tangent, -1.0)),
            Lens::Orthographic { half_height } => {
                (DVec3::new(x * half_height * self.aspect, y * half_height, 0.0), DVec3::NEG_Z)
            }
        }
    }
}
