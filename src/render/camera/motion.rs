//! How the camera moves over a film.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::{
    extent::Extent,
    eye::Camera,
    framing::{fit_orthographic, fit_perspective, orientation},
    lens::Lens,
    view::{View, ViewKey},
};
use crate::{
    render::{Output, RenderError},
    timeline::Keyframes,
};

/// A camera that goes round the surface on a turntable and from key to key.
///
/// It is as far away as it takes to see all of the surface from all directions that it looks from, and stays as far
/// (but for what keys say), so that nothing is cut off and the size of the surface does not pump.
#[derive(Clone, Debug)]
pub struct CameraMotion {
    /// Looks at the middle at rest, from where its own rotation takes it.
    rest: Camera,
    /// Right, up and toward the eye at rest.
    axes: DMat3,
    /// What the eye turns round.
    up: DVec3,
    /// Radians over the whole film.
    turntable: f64,
    /// Distance of the eye along the axis of view at rest.
    distance: f64,
    keys: Option<Keyframes<ViewKey>>,
    /// What is in the middle of the picture unless a key says otherwise.
    middle: DVec3,
    /// How far the eye is beside it then, to the right and up.
    beside: DVec3,
}

/// Where the eye is at a key.
#[derive(Clone, Copy, Debug)]
struct Pose {
    /// Radians.
    orbit: f64,
    /// Radians.
    rise: f64,
    dolly: f64,
    target: DVec3,
    /// How far the eye is beside the target, to the right and up.
    beside: DVec3,
}

impl Pose {
    fn toward(self, other: Pose, part: f64) -> Pose {
        let between = |a: f64, b: f64| a + (b - a) * part;
        Pose {
            orbit: between(self.orbit, other.orbit),
            rise: between(self.rise, other.rise),
            dolly: between(self.dolly, other.dolly),
            target: self.target.lerp(other.target, part),
            beside: self.beside.lerp(other.beside, part),
        }
    }
}

/// Directions between which the view is taken to change nothing for the framing.
const STEP_DEGREES: f64 = 4.0;
/// Share of such a step that is taken for rounding.
const STEP_ROUNDING: f64 = 1e-9;
/// Directions that are looked at on the way from key to key.
const STEPS_PER_KEY: usize = 32;
const MOST_STEPS: usize = 1024;

impl CameraMotion {
    /// A camera that sees all of `extent` in a film from the first to the second time.
    ///
    /// # Errors
    /// [`RenderError::NothingToFrame`] on an empty extent.
    pub fn framing(view: &View, extent: &Extent, output: &Output, [start, end]: [f64; 2]) -> Result<Self, RenderError> {
        let (center, radius) = extent.ball().ok_or(RenderError::NothingToFrame)?;
        // A single point still gets a picture.
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let (field_of_view, fill) = (view.field_of_view(), view.fill());
        let (toward_eye, up) = orientation(view, extent);
        let right = up.cross(toward_eye).normalize();
        let axes = DMat3::from_cols(right, toward_eye.cross(right), toward_eye);
        let middle = view.target().unwrap_or(center);
        let mut motion = Self {
            rest: Camera {
                view_from_world: DAffine3::IDENTITY,
                lens: Lens::Orthographic { half_height: radius },
                aspect: output.aspect(),
                near: 0.0,
                far: f64::INFINITY,
                subject: (center, radius),
            },
            axes,
            up: up.normalize(),
            turntable: view.turntable(),
            distance: 0.0,
            keys: view.keys().cloned(),
            middle,
            beside: DVec3::ZERO,
        };

        let keys = view.keys().map_or(&[][..], Keyframes::values);
        let steps_of_turntable = (view.turntable().abs() / STEP_DEGREES.to_radians() - STEP_ROUNDING).ceil();
        let steps = STEPS_PER_KEY.saturating_mul(keys.len()).max(steps_of_turntable as usize).min(MOST_STEPS);
        let mut points = Vec::new();
        for step in 0..=steps {
            let part = if steps == 0 { 0.0 } else { step as f64 / steps as f64 };
            let view_from_world = motion.axes_at(part, start + (end - start) * part).1.transpose();
            points.extend(extent.outermost().iter().map(|&point| view_from_world * (point - middle)));
        }
        if view.target().is_some() {
            // The target is in the middle of the picture, so both sides have to fit what one has.
            points.extend(points.clone().iter().map(|point| DVec3::new(-point.x, -point.y, point.z)));
        }
        let targets = keys.iter().map(|key| key.target.unwrap_or(middle)).chain(keys.is_empty().then_some(middle));
        let farthest = targets.map(|target| target.distance(center)).fold(0.0, f64::max);
        let free = output.aspect() * (1.0 - output.reserved());
        let (mut eye, lens) = if field_of_view == 0.0 {
            fit_orthographic(&points, radius + farthest, free, fill)
        } else {
            fit_perspective(&points, radius, libm::tan(field_of_view / 2.0), free, fill)
        };
        // The middle of what is not reserved lies to the left of the middle of the picture.
        eye.x += output.reserved() * output.aspect() * lens.half_height_at(eye.z);
        (motion.rest.near, motion.rest.far) = match lens {
            Lens::Perspective { .. } => (1e-3 * radius, f64::INFINITY),
            Lens::Orthographic { .. } => (0.0, 2.0 * eye.z),
        };
        motion.rest.lens = lens;
        motion.distance = eye.z;
        motion.beside = DVec3::new(eye.x, eye.y, 0.0);
        Ok(motion)
    }

    /// Up in the world, as the film has it.
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The camera at a time of the film. `part` is the share of the film that has passed by then: 0 at its first frame, 1
    /// one frame after its last.
    pub fn at(&self, part: f64, time: f64) -> Camera {
        let (pose, axes) = self.axes_at(part, time);
        let (distance, lens) = match self.rest.lens {
            Lens::Perspective { .. } => (self.distance * pose.dolly, self.rest.lens),
            Lens::Orthographic { half_height } => {
                (self.distance, Lens::Orthographic { half_height: half_height * pose.dolly })
            }
        };
        let eye = pose.target + axes * (pose.beside + DVec3::Z * distance);
        let view_from_world = DAffine3::from_mat3(axes.transpose()) * DAffine3::from_translation(-eye);
        Camera { view_from_world, lens, ..self.rest.clone() }
    }

    fn pose(&self, key: &ViewKey) -> Pose {
        Pose {
            orbit: key.orbit,
            rise: key.rise,
            dolly: key.dolly,
            target: key.target.unwrap_or(self.middle),
            beside: if key.target.is_some() { DVec3::ZERO } else { self.beside },
        }
    }

    /// Pose, and right, up and toward the eye.
    fn axes_at(&self, part: f64, time: f64) -> (Pose, DMat3) {
        let pose = match &self.keys {
            Some(keys) => {
                let (before, after, between) = keys.around(time);
                self.pose(before).toward(self.pose(after), between)
            }
            None => Pose { orbit: 0.0, rise: 0.0, dolly: 1.0, target: self.middle, beside: self.beside },
        };
        let orbit = turn(self.up, self.turntable * part + pose.orbit);
        (pose, orbit * self.axes * turn(DVec3::X, -pose.rise))
    }
}

/// The rotation by an angle about a unit vector.
fn turn(axis: DVec3, angle: f64) -> DMat3 {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    DMat3::from_quat(DQuat::from_vec4((sine * axis).extend(cosine)))
}

impl Camera {
    /// A camera that sees all of `extent` as the view asks. It stands still; [`CameraMotion`] follows what the view says
    /// of motion.
    ///
    /// Frame a whole film by merging the extents of its frames: the camera then never moves.
    ///
    /// # Errors
    /// [`RenderError::NothingToFrame`] on an empty extent.
    pub fn framing(view: &View, extent: &Extent, output: &Output) -> Result<Self, RenderError> {
        Ok(CameraMotion::framing(&view.still(), extent, output, [0.0; 2])?.at(0.0, 0.0))
    }
}
