use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

use super::{
    CameraMotion, Extent, Output, RenderError,
    framing::{in_range, unit, upright},
};
use crate::scene::CameraSection;

/// A view of the surface.
///
/// View space has x to the right, y up and z toward the eye, which sits at the origin. Clip space has
/// `|x|, |y| <= w` in the picture and `0 <= z <= w` in depth, where z / w is largest at the near plane:
/// it is affine in the picture plane for perspective and orthographic views alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    pub(super) view_from_world: DAffine3,
    pub(super) lens: Lens,
    pub(super) aspect: f64,
    /// Distance from the eye below which nothing is seen.
    pub(super) near: f64,
    /// Distance beyond which an orthographic view sees nothing.
    pub(super) far: f64,
    /// Middle and radius of what was framed, in world space.
    pub(super) subject: (DVec3, f64),
}

/// How rays of sight leave the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lens {
    /// Tangent of half the vertical field of view.
    Perspective { tangent: f64 },
    /// Half the height of the picture in world units.
    Orthographic { half_height: f64 },
}

impl Lens {
    /// Half the height of what is seen at a distance from the eye.
    pub(super) fn half_height_at(self, distance: f64) -> f64 {
        match self {
            Lens::Perspective { tangent } => tangent * distance,
            Lens::Orthographic { half_height } => half_height,
        }
    }
}

impl Camera {
    /// A camera that sees all of `extent` from the direction the section asks for, or from a good one. It stands
    /// still; [`CameraMotion`] follows what the section says of motion.
    ///
    /// Frame a whole film by merging the extents of its frames: the camera then never moves.
    ///
    /// # Errors
    /// [`RenderError::Camera`] on impossible values, [`RenderError::NothingToFrame`] on an empty extent.
    pub fn framing(section: &CameraSection, extent: &Extent, output: &Output) -> Result<Self, RenderError> {
        let still = CameraSection { turntable: 0.0, keys: Vec::new(), ..section.clone() };
        Ok(CameraMotion::framing(&still, extent, output, [0.0; 2])?.at(0.0, 0.0))
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
        2.0 * self.lens.half_height_at(self.distance(depth)) / output.height() as f64
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
